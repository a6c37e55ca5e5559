//! Areas of a carpet that look darker because their threads lean another way.

use glam::Vec3;

use crate::error::ShadingError;
use crate::material::fbm::{SizedFbm, half_mean};
use crate::parameter::{as_share, as_size};
use crate::pixel::Footprint;

/// Dark areas: a factor of the diffuse and the specular color.
///
/// ```text
/// factor = 1 − strength · max(N(p/size), 0)
/// ```
///
/// Half of the surface keeps its color. Where the pixel is too wide for the areas, the factor uses
/// the mean `max(N, 0)` = E|N|/2.
///
/// - **Range:** [1 − strength, 1].
///
/// Nilsson 2008, §4.2.4, which prints the color times `max(N, 0)`: half of the surface would be
/// black.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DarkAreas {
    noise: SizedFbm,
    strength: f32,
}

impl DarkAreas {
    /// Creates areas of this size and strength.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless `dark_area_size` is within `[10⁻⁶, 10⁶]` and
    /// `dark_area_strength` within `[0, 1]`.
    pub(crate) fn new(size: f32, strength: f32, seed: u32) -> Result<Self, ShadingError> {
        let noise = SizedFbm::single(as_size("dark_area_size", size)?, seed);
        Ok(Self { noise, strength: as_share("dark_area_strength", strength)? })
    }

    /// The noise.
    pub(crate) const fn noise(&self) -> &SizedFbm {
        &self.noise
    }

    /// Factor of the colors at a point; the factor for N = 0 if a coordinate is not finite.
    pub(crate) fn factor(&self, position: Vec3, footprint: Footprint) -> f32 {
        let removed = self.noise.removed(footprint);
        let near = if removed < 1.0 { self.noise.value(position).max(0.0) } else { 0.0 };
        1.0 - self.strength * (near + removed * (half_mean() - near))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn dark_areas_leave_half_of_the_surface_unchanged() {
        let areas = DarkAreas::new(1.0, 1.0, 2).unwrap();
        let near = Footprint::from_width(0.0);
        let (mut same, mut sum) = (0, 0.0);
        for i in 0..4000_u16 {
            let p =
                Vec3::new(f32::from(i % 20) * 3.71, f32::from(i / 20 % 20) * 3.13, f32::from(i / 400) * 2.93);
            let factor = areas.factor(p, near);
            assert!((0.0..=1.0).contains(&factor));
            same += u16::from(factor == 1.0);
            sum += factor;
        }
        // Four standard errors of ½ and of max(N, 0), of standard deviation 0.24, over 4000 points.
        assert!(same.abs_diff(2000) < 127, "{same}");
        let far = areas.factor(Vec3::ZERO, Footprint::from_width(9.0));
        assert_abs_diff_eq!(sum / 4000.0, far, epsilon = 0.015);
    }

    #[test]
    fn factor_has_its_pinned_value() {
        let areas = DarkAreas::new(0.15, 0.5, 1).unwrap();
        let factor = areas.factor(Vec3::new(0.37, -1.21, 2.83), Footprint::from_width(1e-3));
        assert_abs_diff_eq!(factor, 0.695_326, epsilon = 1e-4 * 0.695);
    }
}
