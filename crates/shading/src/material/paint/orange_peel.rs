//! Orange peel: the bumps of dried paint.

use glam::Vec3;

use crate::bump::{bumped_normal, project_to_tangent_plane};
use crate::error::ShadingError;
use crate::material::fbm::{SLOPE_VARIANCE, SizedFbm};
use crate::parameter::{as_share, as_size};
use crate::pixel::Footprint;

/// Orange peel: one octave of noise that tilts the normal of a clearcoat.
///
/// ```text
/// n′ = normalize(n − k (∇N − n (n·∇N))),   ∇N = (∇N)(p/size)
/// ```
///
/// The height is `k · size · N(p/size)`, whose slope does not depend on the size; k = 0.1 tilts by
/// about 10°. It is a single octave, so reflections are distorted and not blurred. Tilts that a
/// pixel cannot resolve fade out, and [`removed_slope`](Self::removed_slope) returns the
/// corresponding roughness of the coat.
///
/// Nilsson 2008, §4.3.2, whose formula is the first of these without the removal of the component
/// along n.
///
/// ```
/// use asperity_shading::material::OrangePeel;
/// use asperity_shading::{Footprint, glam::Vec3};
///
/// let peel = OrangePeel::new(0.002, 0.02, 1)?;
/// let n = peel.normal(Vec3::new(0.3, 0.1, 0.2), Vec3::Z, Footprint::from_width(1e-4));
/// assert!(n.z > 0.9 && n != Vec3::Z);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrangePeel {
    noise: SizedFbm,
    strength: f32,
}

impl OrangePeel {
    /// Creates bumps of this size, in units of the positions, and strength k.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless `orange_peel_size` is within `[10⁻⁶, 10⁶]` and
    /// `orange_peel_strength` within `[0, 1]`.
    pub fn new(size: f32, strength: f32, seed: u32) -> Result<Self, ShadingError> {
        let noise = SizedFbm::single(as_size("orange_peel_size", size)?, seed);
        Ok(Self { noise, strength: as_share("orange_peel_strength", strength)? })
    }

    /// The noise.
    pub(crate) const fn noise(&self) -> &SizedFbm {
        &self.noise
    }

    /// The surface gradient of the height, for the unit normal `n`.
    #[must_use]
    pub fn gradient(&self, position: Vec3, n: Vec3, footprint: Footprint) -> Vec3 {
        project_to_tangent_plane(n, self.noise.sample(position, footprint).gradient) * self.strength
    }

    /// The normal of the coat; `n` itself where a coordinate is not finite.
    #[must_use]
    pub fn normal(&self, position: Vec3, n: Vec3, footprint: Footprint) -> Vec3 {
        bumped_normal(n, self.gradient(position, n, footprint))
    }

    /// The slope variance along each axis that a pixel does not resolve.
    ///
    /// Beckmann's α² increases by twice this value.
    #[must_use]
    pub fn removed_slope(&self, footprint: Footprint) -> f32 {
        self.strength * self.strength * self.noise.removed_slope(footprint, SLOPE_VARIANCE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn slopes_have_the_stated_variance_near_and_far() {
        let peel = OrangePeel::new(0.5, 0.1, 4).unwrap();
        let n = Vec3::new(0.36, 0.48, 0.8);
        let total = peel.removed_slope(Footprint::from_width(1e3));
        for width in [0.0, 0.2] {
            let footprint = Footprint::from_width(width);
            let mut sum = 0.0;
            for i in 0..4000_u16 {
                let p = Vec3::new(f32::from(i % 20), f32::from(i / 20 % 20), f32::from(i / 400)) * 1.37;
                sum += peel.gradient(p, n, footprint).length_squared() / 2.0;
            }
            let variance = sum / 4000.0 + peel.removed_slope(footprint);
            // Four standard errors; the squares have about their mean as standard deviation.
            assert_abs_diff_eq!(variance / total, 1.0, epsilon = 0.063, "{width}");
        }
        assert_eq!(peel.removed_slope(Footprint::from_width(0.0)), 0.0);
    }
}
