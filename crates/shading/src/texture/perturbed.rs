//! Texture coordinates displaced by noise.

use asperity_noise::{Field, Noise, Perlin};
use glam::{Vec2, Vec3};

use crate::math::sqrt;
use crate::pixel::Footprint;

/// Displaces the texture coordinates of a surface by noise.
///
/// ```text
/// s′ = s + strength_x n(scale P),   t′ = t + strength_y n(scale P + (1.5, 6.7, 3.4))
/// ```
///
/// Two channels of one noise, separated by an offset; Cohen, *Procedural Bump Mapping and Noise*,
/// listing `perturb`. Here the second channel has its own seed in addition to the offset, because
/// channels on one lattice are not independent.
///
/// ```
/// use asperity_shading::texture::PerturbedTexture;
/// use asperity_shading::glam::{Vec2, Vec3};
///
/// let running = PerturbedTexture::default();
/// let moved = running.coordinates(Vec3::new(1.0, 2.0, 3.0), Vec2::new(0.5, 0.5));
/// assert!((moved - Vec2::splat(0.5)).abs().cmple(Vec2::new(0.1, 0.05)).all());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerturbedTexture<N = Perlin> {
    /// The noise, with values in about `[−1, 1]`.
    pub noise: N,
    /// Cells of the noise per unit of the positions.
    pub scale: f32,
    /// Maximum displacement of either coordinate.
    pub strength: Vec2,
    /// Random seed.
    pub seed: u32,
}

/// The perturbation of the lecture: 0.2 cells per unit, by 0.1 and 0.05.
impl Default for PerturbedTexture {
    fn default() -> Self {
        Self { noise: Perlin::default(), scale: 0.2, strength: Vec2::new(0.1, 0.05), seed: 0 }
    }
}

/// A position in a texture, and the spread of the unresolved displacement around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerturbedLookUp {
    /// The texture coordinates.
    pub uv: Vec2,
    /// The standard deviation of either coordinate.
    pub spread: Vec2,
}

impl<N: Noise + Field<Vec3> + Clone> PerturbedTexture<N> {
    /// Perturbed texture coordinates for the surface point `p` with coordinates `uv`.
    ///
    /// Returns `uv` itself where `p` is not finite.
    #[must_use]
    pub fn coordinates(&self, p: Vec3, uv: Vec2) -> Vec2 {
        let q = p * self.scale;
        let second =
            self.noise.clone().with_seed(self.seed.wrapping_add(1)).value(q + Vec3::new(1.5, 6.7, 3.4));
        uv + self.strength * Vec2::new(self.noise.clone().with_seed(self.seed).value(q), second)
    }

    /// Perturbed texture coordinates as seen by a pixel, with the standard deviations of their
    /// spread.
    ///
    /// Unresolved noise fades to 0, and its displacement becomes a blur. A box of width `√(width² +
    /// 12 spread²)` covers both.
    ///
    /// ```
    /// use asperity_shading::texture::PerturbedTexture;
    /// use asperity_shading::{Footprint, glam::{Vec2, Vec3}};
    ///
    /// let running = PerturbedTexture::default();
    /// let (p, uv) = (Vec3::new(1.0, 2.0, 3.0), Vec2::new(0.5, 0.5));
    /// let near = running.filtered(p, uv, Footprint::from_width(0.1));
    /// assert_eq!((near.uv, near.spread), (running.coordinates(p, uv), Vec2::ZERO));
    /// let far = running.filtered(p, uv, Footprint::from_width(10.0));
    /// assert!(far.uv == uv && far.spread.x > far.spread.y && far.spread.y > 0.0);
    /// ```
    #[must_use]
    pub fn filtered(&self, p: Vec3, uv: Vec2, footprint: Footprint) -> PerturbedLookUp {
        let kept = footprint.kept(self.scale);
        if kept >= 1.0 {
            return PerturbedLookUp { uv: self.coordinates(p, uv), spread: Vec2::ZERO };
        }
        let deviation = self.noise.statistics(3).standard_deviation * sqrt(1.0 - kept * kept);
        let moved = if kept > 0.0 { uv + kept * (self.coordinates(p, uv) - uv) } else { uv };
        PerturbedLookUp { uv: moved, spread: self.strength.abs() * deviation }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invalid_points_are_not_displaced() {
        let uv = Vec2::new(0.25, 0.75);
        for bad in [Vec3::NAN, Vec3::INFINITY, Vec3::new(0.0, f32::NAN, 0.0)] {
            assert_eq!(PerturbedTexture::default().coordinates(bad, uv), uv);
        }
    }

    #[test]
    fn both_directions_are_independent() {
        let running = PerturbedTexture { strength: Vec2::ONE, scale: 1.0, ..PerturbedTexture::default() };
        let (mut xy, mut xx, mut yy) = (0.0_f64, 0.0_f64, 0.0_f64);
        for i in 0..20_000 {
            let i = i as f32;
            let p =
                Vec3::new((0.618_034 * i).fract(), (0.754_878 * i).fract(), (0.569_84 * i).fract()) * 50.0;
            let moved = running.coordinates(p, Vec2::ZERO);
            let moved = moved.to_array().map(f64::from);
            xy += moved[0] * moved[1];
            xx += moved[0] * moved[0];
            yy += moved[1] * moved[1];
        }
        // Correlation of independent channels over about 10⁴ cells.
        assert!(xx > 0.0 && yy > 0.0 && (xy / (xx * yy).sqrt()).abs() < 0.05, "{}", xy / (xx * yy).sqrt());
    }
}
