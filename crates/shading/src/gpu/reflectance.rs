//! Coats.

use asperity_core::gpu_struct;

use crate::reflectance::Coat;

gpu_struct! {
    /// A coat of any kind, in the frame of the surface.
    pub struct CoatUniform as "Coat" {
        /// Unit normal.
        normal: [f32; 3],
        /// Variance along each axis of the unresolved Gaussian slopes.
        slope_variance: f32,
        /// Steepest unresolved slope of a sine; zero without a sine.
        swing: [f32; 3],
        /// Beckmann's alpha of the reflection, 0 for a smooth coat.
        roughness: f32,
        /// Tint of a pane, reflectance of a metal, transmittance of a veil, otherwise 1.
        color: [f32; 3],
        /// Relative IOR of a varnish, a pane or a body.
        index: f32,
        /// 0 for a varnish, then pane, body, metal, veil.
        kind: u32,
        .. padding: [u32; 3]
    }
}

impl Coat {
    /// Returns the coat as a uniform of a shader.
    ///
    /// ```
    /// use asperity_shading::{Dielectric, reflectance::Coat};
    ///
    /// let varnish = Coat::clearcoat(Dielectric::new(1.5)?).rough(0.1).gpu();
    /// assert_eq!((varnish.normal[2], varnish.roughness, varnish.index), (1.0, 0.1, 1.5));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> CoatUniform {
        let ([normal, swing, color], kind) = self.parts();
        CoatUniform {
            normal: normal.truncate().into(),
            slope_variance: normal.w,
            swing: swing.truncate().into(),
            roughness: swing.w,
            color: color.truncate().into(),
            index: color.w,
            kind,
            padding: [0; 3],
        }
    }
}
