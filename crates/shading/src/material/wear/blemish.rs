//! Small variations of color and normal.

use glam::Vec3;

use crate::bump::project_to_tangent_plane;
use crate::error::ShadingError;
use crate::material::fbm::{SLOPE_VARIANCE, SizedFbm, half_mean};
use crate::parameter::as_size;
use crate::pixel::Footprint;

/// Blemishes: small raised spots that are brighter or darker, all from one octave of noise.
///
/// ```text
/// specular = vary(specular, −N(p/size), color strength),   n′ = normalize(n − k ∇N)
/// ```
///
/// Valleys are brighter than bumps, as in the thesis: a mistake that was kept because it looks like
/// a thin skin.
///
/// The means of N > 0 and of N < 0 are equal, but the ranges above and below a color are not. A
/// pixel too wide for blemishes gets the mean, c + v (1 − 2c) E|N|/2.
///
/// Nilsson 2008, §4.5.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blemishes {
    noise: SizedFbm,
}

impl Blemishes {
    /// Creates blemishes of this size, in units of the positions.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless `small_blemish_size` is within `[10⁻⁶, 10⁶]`.
    pub fn new(size: f32, seed: u32) -> Result<Self, ShadingError> {
        Ok(Self { noise: SizedFbm::single(as_size("small_blemish_size", size)?, seed) })
    }

    /// The noise of blemishes.
    pub(crate) const fn noise(&self) -> &SizedFbm {
        &self.noise
    }

    /// Varies a channel of a color by noise within [0, 1].
    ///
    /// ```text
    /// c + N v (c where N < 0, else 1 − c)
    /// ```
    ///
    /// - **Domain:** `color` and `variation` in [0, 1], noise in [−1, 1].
    ///
    /// Nilsson 2008, §4.5.2, which prints N/v for N v; this leaves [0, 1] for every v below 1.
    ///
    /// ```
    /// use asperity_shading::material::Blemishes;
    ///
    /// assert!((Blemishes::vary(0.6, 1.0, 0.2) - 0.68).abs() < 1e-6);
    /// ```
    #[must_use]
    pub fn vary(color: f32, noise: f32, variation: f32) -> f32 {
        let room = if noise < 0.0 { color } else { 1.0 - color };
        color + noise * variation * room
    }

    /// A color with blemishes of this strength; the color itself where a coordinate is not finite.
    #[must_use]
    pub fn color(&self, color: Vec3, strength: f32, position: Vec3, footprint: Footprint) -> Vec3 {
        let removed = self.noise.removed(footprint);
        let noise = if removed < 1.0 { -self.noise.value(position) } else { 0.0 };
        let mean = half_mean() * strength;
        let each = |c: f32| {
            let near = Self::vary(c, noise, strength);
            near + removed * (c + mean * (1.0 - 2.0 * c) - near)
        };
        Vec3::from(color.to_array().map(each))
    }

    /// The surface gradient of the bumps; zero where a coordinate is not finite.
    #[must_use]
    pub fn gradient(&self, strength: f32, position: Vec3, n: Vec3, footprint: Footprint) -> Vec3 {
        project_to_tangent_plane(n, self.noise.sample(position, footprint).gradient) * strength
    }

    /// The height of the bumps, `strength · size · N(p/size)`; 0 where a coordinate is not finite.
    #[must_use]
    pub fn height(&self, strength: f32, position: Vec3, footprint: Footprint) -> f32 {
        strength * self.noise.seen(position, footprint) / self.noise.frequencies()[0]
    }

    /// The slope variance along each axis that a pixel does not resolve.
    #[must_use]
    pub fn removed_slope(&self, strength: f32, footprint: Footprint) -> f32 {
        strength * strength * self.noise.removed_slope(footprint, SLOPE_VARIANCE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn varied_colors_stay_in_range() {
        for i in 0..=20_u8 {
            for j in 0..=10_u8 {
                let (noise, color) = (f32::from(i) / 10.0 - 1.0, f32::from(j) / 10.0);
                for variation in [0.0, 0.3, 1.0] {
                    let c = Blemishes::vary(color, noise, variation);
                    assert!((-1e-6..=1.000_001).contains(&c), "{color}, {noise}, {variation}: {c}");
                }
            }
        }
    }

    #[test]
    fn wide_footprints_see_the_mean_color() {
        let blemishes = Blemishes::new(1.0, 4).unwrap();
        let color = Vec3::new(0.1, 0.5, 0.8);
        let seen = |p, width| blemishes.color(color, 0.7, p, Footprint::from_width(width));
        let mut sum = Vec3::ZERO;
        for i in 0..4000_u16 {
            let p =
                Vec3::new(f32::from(i % 20) * 3.71, f32::from(i / 20 % 20) * 3.13, f32::from(i / 400) * 2.93);
            sum += seen(p, 0.0);
        }
        // Standard deviations are up to 0.17: four standard errors.
        assert_abs_diff_eq!(sum / 4000.0, seen(Vec3::ZERO, 9.0), epsilon = 0.011);
    }
}
