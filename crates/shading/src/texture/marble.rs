//! Blue marble: a color spline over a sum of noise.

use asperity_noise::{Field, Noise, Perlin, filtered_fraction};
use glam::Vec3;

use crate::error::ShadingError;
use crate::math::sqrt;
use crate::parameter::positive;
use crate::pixel::Footprint;

/// Marble: the sum of a few octaves of noise selects a color from a spline.
///
/// ```text
/// m(p) = Σ n(s fᵢ p)/fᵢ,   fᵢ = 2.17ⁱ,   i = 0 … 3,   s the texture's scale
/// color(m) = Catmull–Rom spline through thirteen colors at clamp(2m + 0.75, 0, 1)
/// ```
///
/// The first and the last color are control points only, as in the spline of RenderMan, so ten
/// pieces remain. If a pixel does not resolve the upper octaves, [`color`](Self::color) is the
/// mean of the spline over them, and not the color of the mean. Marble therefore keeps its color
/// from afar.
///
/// Cohen, *Procedural Bump Mapping and Noise*, listing `blue_marble`.
///
/// ```
/// use asperity_shading::{Footprint, Marble, glam::Vec3};
///
/// let marble = Marble::default();
/// let near = marble.color(Vec3::new(0.3, 0.1, 0.8), Footprint::from_width(0.0));
/// assert_eq!(near, Marble::<asperity_shading::noise::Perlin>::spline(2.0 * marble.sum(Vec3::new(0.3, 0.1, 0.8)) + 0.75));
/// // From afar every point has the same pale blue.
/// let far = |p| marble.color(p, Footprint::from_width(1e3));
/// assert_eq!(far(Vec3::ZERO), far(Vec3::ONE));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marble<N = Perlin> {
    noise: N,
    scale: f32,
    seed: u32,
}

const OCTAVES: usize = 4;
const LACUNARITY: f32 = 2.17;

const PALE: Vec3 = Vec3::new(0.25, 0.25, 0.35);
const MEDIUM: Vec3 = Vec3::new(0.10, 0.10, 0.30);
const DARK: Vec3 = Vec3::new(0.05, 0.05, 0.26);
const DARKER: Vec3 = Vec3::new(0.03, 0.03, 0.20);
const COLORS: [Vec3; 13] =
    [PALE, PALE, MEDIUM, MEDIUM, MEDIUM, PALE, PALE, DARK, DARK, DARKER, DARKER, PALE, DARKER];

/// The marble of the lecture: Perlin noise, scale 2.5. Polynomials of the spline.
const PIECES: usize = COLORS.len() - 3;

/// The integral of the spline before each piece, in pieces.
const BEFORE: [Vec3; PIECES] = {
    let (mut sums, mut k) = ([Vec3::ZERO; PIECES], 1);
    while k < PIECES {
        let [a, b, c, d] = [COLORS[k - 1], COLORS[k], COLORS[k + 1], COLORS[k + 2]];
        let Vec3 { x, y, z } = sums[k - 1];
        sums[k] = Vec3::new(
            x + mean_of_piece([a.x, b.x, c.x, d.x]),
            y + mean_of_piece([a.y, b.y, c.y, d.y]),
            z + mean_of_piece([a.z, b.z, c.z, d.z]),
        );
        k += 1;
    }
    sums
};

/// The integral of the Catmull–Rom polynomial between the middle two of four values.
const fn mean_of_piece([a, b, c, d]: [f32; 4]) -> f32 {
    (13.0 * (b + c) - (a + d)) / 24.0
}

impl Default for Marble {
    fn default() -> Self {
        Self { noise: Perlin::default(), scale: 2.5, seed: 0 }
    }
}

impl<N: Noise + Field<Vec3> + Clone> Marble<N> {
    /// Creates marble from a noise with values in about `[−1, 1]`, `scale` cells of its first
    /// octave per unit.
    ///
    /// # Errors
    /// [`ShadingError`] unless the scale is finite and positive.
    pub fn new(noise: N, scale: f32, seed: u32) -> Result<Self, ShadingError> {
        Ok(Self { noise, scale: positive("scale", scale)?, seed })
    }

    /// Cells of the first octave per unit of length, and the seed.
    pub(crate) const fn parts(&self) -> (f32, u32) {
        (self.scale, self.seed)
    }

    /// The sum of noise `m(p)`; 0 for coordinates that are not finite.
    #[must_use]
    pub fn sum(&self, p: Vec3) -> f32 {
        self.resolved(p, 0.0).sum
    }

    /// The linear RGB color at a point, as seen by a pixel of this footprint.
    ///
    /// Octave i keeps the fraction `1 − kᵢ` of [`filtered_fraction`] for half the footprint; for
    /// the whole footprint, octaves would vanish that are still visible in the mean over a pixel.
    /// The removed part has the measured distribution of sums of the noise at its variance. The
    /// kept part still varies within the pixel, by its gradient. The color is the mean of the
    /// spline over both.
    #[must_use]
    pub fn color(&self, p: Vec3, footprint: Footprint) -> Vec3 {
        let width = footprint.width();
        if width == 0.0 {
            return Self::spline(2.0 * self.sum(p) + 0.75);
        }
        let Resolved { sum, removed, within } = self.resolved(p, width);
        if removed == 0.0 {
            // The variance of an interval is a twelfth of its square.
            let half = sqrt(3.0 * within);
            return End::of(sum - half).mean_until(&End::of(sum + half));
        }
        let deviation = sqrt(removed + within);
        let cdf = self.noise.statistics(3).cdf;
        let at = |k: usize| End::of(sum + deviation * (8.0 * k as f32 / PARTS as f32 - 4.0));
        let (mut mean, mut below, mut low) = (Vec3::ZERO, 0.0, at(0));
        for k in 1..=PARTS {
            let above = if k == PARTS { 1.0 } else { cdf.get(k * cdf.len() / PARTS).copied().unwrap_or(1.0) };
            let high = at(k);
            mean += (above - below) * low.mean_until(&high);
            (below, low) = (above, high);
        }
        mean
    }

    /// The spline over `x`, clamped to `[0, 1]`; NaN is read as 0.
    #[must_use]
    pub fn spline(x: f32) -> Vec3 {
        let (_, t, [b, linear, square, cube]) = Self::piece(x);
        b + t * (linear + t * (square + t * cube))
    }

    /// `∫₀ˣ spline`.
    fn antiderivative(x: f32) -> Vec3 {
        if x < 0.0 {
            return Self::spline(0.0) * x;
        }
        let (index, t, [b, linear, square, cube]) = Self::piece(x);
        let within = t * (b + t * (linear / 2.0 + t * (square / 3.0 + t * cube / 4.0)));
        let before = BEFORE.get(index).copied().unwrap_or_default();
        (before + within) / PIECES as f32 + Self::spline(1.0) * (x - 1.0).max(0.0)
    }

    /// The piece of `x`, the position in it, and the polynomial.
    fn piece(x: f32) -> (usize, f32, [Vec3; 4]) {
        let x = if x > 0.0 { x.min(1.0) * PIECES as f32 } else { 0.0 };
        let piece = (x as usize).min(PIECES - 1);
        let [a, b, c, d] =
            COLORS.get(piece..).and_then(|knots| knots.first_chunk()).copied().unwrap_or([DARKER; 4]);
        let square = a - 2.5 * b + 2.0 * c - 0.5 * d;
        (piece, x - piece as f32, [b, 0.5 * (c - a), square, 1.5 * (b - c) + 0.5 * (d - a)])
    }

    fn resolved(&self, p: Vec3, width: f32) -> Resolved {
        let one = self.noise.statistics(3).standard_deviation;
        let mut resolved = Resolved { sum: 0.0, removed: 0.0, within: 0.0 };
        let mut frequency = 1.0;
        for i in 0..OCTAVES {
            let removed = filtered_fraction(SOFTER * width, self.scale * frequency);
            let kept = 1.0 - removed;
            let whole = (one / frequency) * (one / frequency);
            if kept > 0.0 {
                let seed = self.seed.wrapping_add(i as u32);
                let sample = self.noise.clone().with_seed(seed).sample(p * (self.scale * frequency));
                resolved.sum += kept / frequency * sample.value;
                // A surface contains two of three directions of space. A line varies without bound,
                // noise by its variance.
                let rate = kept * self.scale * width;
                let line = sample.gradient.dot(sample.gradient) * rate * rate / 18.0;
                if line > 0.0 {
                    resolved.within += line * whole / (line + whole);
                }
            }
            resolved.removed += (1.0 - kept * kept) * whole;
            frequency *= LACUNARITY;
        }
        resolved
    }
}

/// An end of an interval of sums.
struct End {
    /// Its position on the spline.
    x: f32,
    /// The integral of the spline up to it.
    area: Vec3,
}

impl End {
    fn of(sum: f32) -> Self {
        let x = 2.0 * sum + 0.75;
        Self { x, area: Marble::<Perlin>::antiderivative(x) }
    }

    /// The mean color over the sums from here to another end.
    fn mean_until(&self, end: &Self) -> Vec3 {
        let width = end.x - self.x;
        // Below this the difference of antiderivatives has fewer digits than the polynomial at the
        // midpoint.
        if width > 0.01 {
            (end.area - self.area) / width
        } else {
            Marble::<Perlin>::spline(0.5 * (self.x + end.x))
        }
    }
}

/// The sum as a pixel resolves it.
struct Resolved {
    sum: f32,
    /// The variance of the unresolved part.
    removed: f32,
    /// The variance of the resolved part within the pixel.
    within: f32,
}

/// The fraction of a footprint by which octaves are removed.
const SOFTER: f32 = 0.5;

/// Parts of the distribution of the removed octaves.
const PARTS: usize = 16;

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    type Blue = Marble<Perlin>;

    #[test]
    fn spline_interpolates_its_inner_colors_smoothly() {
        for (k, color) in COLORS[1..12].iter().enumerate() {
            let x = k as f32 / 10.0;
            assert_abs_diff_eq!(Blue::spline(x), *color, epsilon = 1e-6, "knot {k}");
            let h = 1e-3;
            if k > 0 && k < 10 {
                let (left, right) =
                    (Blue::spline(x) - Blue::spline(x - h), Blue::spline(x + h) - Blue::spline(x));
                // The second derivative is discontinuous, by less than 200.
                assert_abs_diff_eq!(right, left, epsilon = 200.0 * h * h, "knot {k}");
            }
        }
        assert!((0..=1000).all(|k| Blue::spline(k as f32 / 1000.0).min_element() > 0.0));
        assert_eq!(Blue::spline(-3.0), Blue::spline(0.0));
        assert_eq!(Blue::spline(f32::INFINITY), Blue::spline(1.0));
        assert_eq!(Blue::spline(f32::NAN), Blue::spline(0.0));
    }

    #[test]
    fn antiderivative_matches_the_spline() {
        let h = 1e-3;
        for k in -30..130 {
            let x = 0.01 * k as f32 + 0.003;
            let rate = (Blue::antiderivative(x + h) - Blue::antiderivative(x - h)) / (2.0 * h);
            assert_abs_diff_eq!(rate, Blue::spline(x), epsilon = 3e-4, "{x}");
        }
    }
}
