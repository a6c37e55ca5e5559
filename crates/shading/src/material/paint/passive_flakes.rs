//! Flakes that do not sparkle but vary the colour.

use glam::Vec3;

use crate::material::fbm::{Fbm, spectrum};
use crate::parameter::{ParameterError, SHARES, SIZES, within};
use crate::pixel::Footprint;

/// Flakes that do not sparkle: a factor for the specular colour.
///
/// ```text
/// factor = max(0, 1 + strength · Σ aᵢ N(fᵢ p/size)/Σ aᵢ),   aᵢ = 2.7ⁱ,   fᵢ = 2.4ⁱ
/// ```
///
/// Finer octaves are stronger, so that flakes are seen from nearby rather than from afar; of four octaves the last has 86 % of
/// the variance. Octaves that a pixel cannot resolve fade to 0, their mean, and the mean factor is 1 at every distance.
///
/// Nilsson 2008, §4.3.5.
///
/// ```
/// use asperity_shading::material::PassiveFlakes;
/// use asperity_shading::{Footprint, glam::Vec3};
///
/// let flakes = PassiveFlakes::new(0.004, 0.3, 4)?;
/// let p = Vec3::new(0.3, 0.1, 0.2);
/// assert!((0.7..=1.3).contains(&flakes.factor(p, Footprint::from_width(1e-5))));
/// assert_eq!(flakes.factor(p, Footprint::from_width(1.0)), 1.0);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassiveFlakes {
    noise: Fbm,
    strength: f32,
}

impl PassiveFlakes {
    /// Flakes whose coarsest octave has this size, in units of the positions, with `detail` octaves.
    ///
    /// # Errors
    /// [`ParameterError::Outside`] unless `passive_flake_size` is within `[10⁻⁶, 10⁶]`, `passive_flake_strength` within
    /// `[0, 1]`, and `passive_flake_detail` from 1 to 8.
    pub fn new(size: f32, strength: f32, detail: u32) -> Result<Self, ParameterError> {
        Self::with_seed(size, strength, detail, 0)
    }

    /// Flakes of a seed, one field of many.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn with_seed(size: f32, strength: f32, detail: u32, seed: u32) -> Result<Self, ParameterError> {
        let spectrum = spectrum("passive_flake_detail", [2.4, 2.7], detail)?;
        let size = within("passive_flake_size", size, SIZES)?;
        let strength = within("passive_flake_strength", strength, SHARES)?;
        Ok(Self { noise: Fbm::new(spectrum, size, seed), strength })
    }

    /// Factor of the specular colour, in [0, 2]; 1 where a coordinate is not finite.
    #[must_use]
    pub fn factor(&self, position: Vec3, footprint: Footprint) -> f32 {
        (1.0 + self.strength * self.noise.sample(position, footprint).value).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_octave_has_most_of_the_variance() {
        let spectrum = spectrum("detail", [2.4, 2.7], 4).unwrap();
        assert!((1.0 - spectrum.share(3.0) - 0.863).abs() < 1e-3, "{}", spectrum.share(3.0));
    }

    #[test]
    fn every_point_has_a_factor() {
        let flakes = PassiveFlakes::new(0.01, 1.0, 8).unwrap();
        for x in [f32::NAN, f32::INFINITY, -1e30, 0.3, 1e30] {
            let factor = flakes.factor(Vec3::splat(x), Footprint::from_width(1e-9));
            assert!((0.0..=2.0).contains(&factor), "{x}: {factor}");
        }
        assert!(PassiveFlakes::new(0.01, 1.0, 0).is_err() && PassiveFlakes::new(0.01, 1.0, 9).is_err());
        assert!(PassiveFlakes::new(0.01, 2.0, 4).is_err() && PassiveFlakes::new(0.0, 1.0, 4).is_err());
    }
}
