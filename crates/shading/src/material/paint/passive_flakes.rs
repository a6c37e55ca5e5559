//! Flakes that do not sparkle but vary the color.

use glam::Vec3;

use crate::error::ShadingError;
use crate::material::fbm::{SizedFbm, spectrum};
use crate::parameter::{as_share, as_size};
use crate::pixel::Footprint;

/// Flakes that do not sparkle: a factor of the specular color.
///
/// ```text
/// factor = max(0, 1 + strength · Σ aᵢ N(fᵢ p/size)/Σ aᵢ),   aᵢ = 2.7ⁱ,   fᵢ = 2.4ⁱ
/// ```
///
/// Finer octaves are stronger, so flakes are visible up close rather than from afar; the last of
/// four octaves has 86 % of the variance. Octaves that a pixel cannot resolve fade to 0, their
/// mean, and the mean factor is 1 at every distance.
///
/// Nilsson 2008, §4.3.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PassiveFlakes {
    noise: SizedFbm,
    strength: f32,
}

impl PassiveFlakes {
    /// Creates flakes with `detail` octaves, the coarsest of this size, in units of the positions.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless `passive_flake_size` is within `[10⁻⁶, 10⁶]`,
    /// `passive_flake_strength` within `[0, 1]`, and `passive_flake_detail` from 1 to 8.
    pub(crate) fn new(size: f32, strength: f32, detail: u32, seed: u32) -> Result<Self, ShadingError> {
        let spectrum = spectrum("passive_flake_detail", [2.4, 2.7], detail)?;
        let size = as_size("passive_flake_size", size)?;
        let strength = as_share("passive_flake_strength", strength)?;
        Ok(Self { noise: SizedFbm::new(spectrum, size, seed), strength })
    }

    /// The noise.
    pub(crate) const fn noise(&self) -> &SizedFbm {
        &self.noise
    }

    /// Factor of the specular color, in [0, 2]; 1 where a coordinate is not finite.
    pub(crate) fn factor(&self, position: Vec3, footprint: Footprint) -> f32 {
        (1.0 + self.strength * self.noise.seen(position, footprint)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::fbm::mean_on_plane;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn last_octave_has_most_of_the_variance() {
        let spectrum = spectrum("detail", [2.4, 2.7], 4).unwrap();
        assert_abs_diff_eq!(1.0 - spectrum.resolved_variance(3.0), 0.863, epsilon = 1e-3);
    }

    #[test]
    fn factor_has_its_pinned_value() {
        let flakes = PassiveFlakes::new(0.01, 0.4, 3, 0).unwrap();
        let p = Vec3::new(0.37, -1.21, 2.83);
        assert_abs_diff_eq!(flakes.factor(p, Footprint::from_width(1e-3)), 1.008_006_8, epsilon = 1e-4);
        assert_eq!(flakes.factor(p, Footprint::from_width(1.0)), 1.0);
    }

    #[test]
    fn passive_flakes_keep_their_mean() {
        let flakes = PassiveFlakes::new(0.02, 1.0, 4, 0).unwrap();
        for width in [0.0, 0.0005, 0.002, 0.005] {
            let [mean, error] = mean_on_plane(4, 40_000, |p| flakes.factor(p, Footprint::from_width(width)));
            assert_abs_diff_eq!(mean, 1.0, epsilon = 5.0 * error + 1e-3, "{width}");
        }
    }
}
