//! Coats and the standard material.

use asperity_core::gpu_struct;

use crate::reflectance::{Coat, StandardMaterial};

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

gpu_struct! {
    /// The parameters of the standard material, named as in glTF 2.0 and its extensions.
    pub struct StandardMaterialUniform as "StandardMaterial" {
        /// Base color.
        base_color: [f32; 3],
        /// From 0, a dielectric, to 1, a metal.
        metallic: f32,
        /// Radiance of the surface.
        emissive: [f32; 3],
        /// Square root of alpha.
        roughness: f32,
        /// Color of the reflection of dielectrics.
        specular_color: [f32; 3],
        /// Strength of that reflection.
        specular: f32,
        /// Color of the sheen.
        sheen_color: [f32; 3],
        /// Roughness of the sheen.
        sheen_roughness: f32,
        /// Index of refraction.
        ior: f32,
        /// Fraction under a clearcoat.
        clearcoat: f32,
        /// Roughness of the clearcoat.
        clearcoat_roughness: f32,
        /// Fraction of light that is transmitted.
        transmission: f32,
        /// Thickness of the body, 0 for a thin wall.
        thickness: f32,
        /// Strength of the anisotropy.
        anisotropy: f32,
        /// Rotation of its direction from the tangent in radians.
        anisotropy_rotation: f32,
        .. padding: [u32; 1]
    }
}

impl StandardMaterial {
    /// Returns the parameters as a uniform of a shader.
    ///
    /// ```
    /// use asperity_shading::{StandardMaterial, StandardMaterialParameters};
    ///
    /// let material = StandardMaterial::new(StandardMaterialParameters { roughness: 0.3, ..Default::default() })?;
    /// assert_eq!((material.gpu().roughness, material.gpu().ior), (0.3, 1.5));
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> StandardMaterialUniform {
        let p = self.parameters();
        StandardMaterialUniform {
            base_color: p.base_color.into(),
            metallic: p.metallic,
            emissive: p.emissive.into(),
            roughness: p.roughness,
            specular_color: p.specular_color.into(),
            specular: p.specular,
            sheen_color: p.sheen_color.into(),
            sheen_roughness: p.sheen_roughness,
            ior: p.ior,
            clearcoat: p.clearcoat,
            clearcoat_roughness: p.clearcoat_roughness,
            transmission: p.transmission,
            thickness: p.thickness,
            anisotropy: p.anisotropy,
            anisotropy_rotation: p.anisotropy_rotation,
            padding: [0; 1],
        }
    }
}
