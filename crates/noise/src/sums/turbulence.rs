//! Shapes of octaves with creases: turbulence, plasma, billow and ridged.
//!
//! All are functions of |n|, whose gradient is sign(n) ∇n. The sum has a crease where an octave
//! passes through 0. On the crease sign(0) = 0, the mean of the slopes of both sides.

use asperity_core::math;

use crate::sums::shape::Shape;

/// φ(n) = |n|: turbulence, with dark veins where an octave is 0.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/turbulence.md"))]
///
/// ```text
/// t(p) = Σ wᵢ aᵢ |nᵢ| / Σ wᵢ aᵢ,   ∇|n| = sign(n) ∇n,   sign(0) = 0
/// ```
///
/// - **Range:** [0, 1] under [`Normalization::UnitRange`](crate::Normalization::UnitRange), for
///   kinds of range 1.
///
/// Perlin 1985; Nilsson 2008, section 4.1.5.
///
/// ```
/// use asperity_noise::{Field, Normalization, Fbm, Simplex, FbmSpectrum, Turbulence, glam::Vec3};
///
/// let noise = Fbm::new(Simplex::new(5), FbmSpectrum::CLOUD).with_shape(Turbulence);
/// let sample = noise.with_normalization(Normalization::UnitRange).sample(Vec3::new(0.4, 0.1, -3.0));
/// assert!((0.0..=1.0).contains(&sample.value));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turbulence;

/// φ(n) = 1 − |n|: plasma, with bright veins where an octave is 0.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/plasma.md"))]
///
/// ```text
/// Σ wᵢ aᵢ (1 − |nᵢ|) / Σ wᵢ aᵢ = 1 − turbulence
/// ```
///
/// With [`FbmSpectrum::THREADS`](crate::FbmSpectrum::THREADS) and the seventh
/// [`Power`](crate::ops::Power) it is the thread pattern of Nilsson 2008, section 4.2.2.
///
/// - **Range:** [0, 1] under [`Normalization::UnitRange`](crate::Normalization::UnitRange), for
///   kinds of range 1.
///
/// Nilsson 2008, section 4.1.5.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plasma;

/// φ(n) = 2|n| − 1: billow, turbulence over all of [−1, 1].
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/billow.md"))]
///
/// - **Range:** [−1, 1] under [`Normalization::UnitRange`](crate::Normalization::UnitRange), for
///   kinds of range 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Billow;

/// φ(n) = (1 − |n|)²: ridges where an octave is 0, sharper than the veins of [`Plasma`].
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/ridged.md"))]
///
/// Octaves are added independently. In a [`RidgedMultifractal`](crate::RidgedMultifractal) ridges
/// carry smaller ridges.
///
/// - **Range:** [0, 1] under [`Normalization::UnitRange`](crate::Normalization::UnitRange), for
///   kinds of range 1.
///
/// Musgrave in Ebert (ed.) 1994.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ridged;

/// x with the sign of n, 0 where n is ±0.
#[inline(always)]
fn with_sign_of(n: f32, x: f32) -> f32 {
    let positive = if n > 0.0 { x } else { 0.0 };
    if n < 0.0 { -x } else { positive }
}

/// Defines φ and φ′/sign(n) as functions of |n|, bounds for |n| up to a bound, and mean and
/// variance from the moments.
macro_rules! shape {
    ($name:ident, |$size:ident| $value:expr, $slope:expr, |$bound:ident| $range:expr, |$m:ident| $moments:expr) => {
        impl Shape for $name {
            #[inline(always)]
            fn value(self, n: f32) -> f32 {
                let $size = n.abs();
                $value
            }

            #[inline(always)]
            fn slope(self, n: f32) -> f32 {
                let $size = n.abs();
                let _ = $size;
                with_sign_of(n, $slope)
            }

            fn range(self, $bound: f32) -> [f32; 2] {
                $range
            }

            fn mean_and_deviation(self, _: f32, $m: [f32; 4]) -> [f32; 2] {
                let [mean, variance] = $moments;
                [mean, math::sqrt(variance.max(0.0))]
            }
        }
    };
}

shape!(Turbulence, |size| size, 1.0, |bound| [0.0, bound], |m| [m[0], m[1] - m[0] * m[0]]);
shape!(Plasma, |size| 1.0 - size, -1.0, |bound| [1.0 - bound, 1.0], |m| [1.0 - m[0], m[1] - m[0] * m[0]]);
shape!(Billow, |size| (size + size) - 1.0, 2.0, |bound| [-1.0, 2.0 * bound - 1.0], |m| {
    [2.0 * m[0] - 1.0, 4.0 * (m[1] - m[0] * m[0])]
});
shape!(
    Ridged,
    |size| (1.0 - size) * (1.0 - size),
    (size - 1.0) + (size - 1.0),
    |bound| [
        if bound < 1.0 { (1.0 - bound) * (1.0 - bound) } else { 0.0 },
        1.0_f32.max((1.0 - bound) * (1.0 - bound))
    ],
    |m| {
        let mean = 1.0 - 2.0 * m[0] + m[1];
        let square = 1.0 - 4.0 * m[0] + 6.0 * m[1] - 4.0 * m[2] + m[3];
        [mean, square - mean * mean]
    }
);

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;

    fn check<T: Shape>(shape: T, phi: impl Fn(f32) -> f32) {
        let h = 1.0 / 1024.0;
        for i in -31..=31_i8 {
            let n = f32::from(i) / 32.0;
            let (value, slope) = (shape.value(n), shape.slope(n));
            assert_eq!(value, phi(n), "{shape:?} at {n}");
            let [low, high] = shape.range(1.0);
            assert!((low..=high).contains(&value), "{shape:?} at {n}");
            // All are polynomials of degree 2 on either side, at multiples of 2⁻¹⁰. The difference
            // is exact, and at the crease it is the mean of both sides.
            let difference = (phi(n + h) - phi(n - h)) / (2.0 * h);
            assert_eq!(slope, difference, "{shape:?} at {n}");
        }
    }

    #[test]
    fn shapes_and_slopes_are_as_stated() {
        check(crate::sums::shape::Signed, |n| n);
        check(Turbulence, f32::abs);
        check(Plasma, |n| 1.0 - n.abs());
        check(Billow, |n| 2.0 * n.abs() - 1.0);
        check(Ridged, |n| (1.0 - n.abs()) * (1.0 - n.abs()));
        assert_eq!(Ridged.slope(-0.0), 0.0);
    }

    /// Eight equally likely n.
    const NUMBERS: [f32; 8] = [-1.0, -0.625, -0.25, 0.0, 0.25, 0.5, 0.875, 1.0];

    fn mean(f: impl Fn(f32) -> f32) -> f32 {
        NUMBERS.iter().map(|&n| f(n)).sum::<f32>() / 8.0
    }

    fn moments_follow<T: Shape>(shape: T) {
        let moments = [1, 2, 3, 4].map(|k| mean(|n| (0..k).fold(1.0, |x, _| x * n.abs())));
        let phi = |n| shape.value(n);
        let [m, d] = shape.mean_and_deviation(0.0, moments);
        let expected = mean(phi);
        assert!(abs_diff_eq!(m, expected, epsilon = 1e-6), "{shape:?}: {m}, not {expected}");
        let variance = mean(|n| (phi(n) - expected) * (phi(n) - expected));
        assert!(abs_diff_eq!(d * d, variance, epsilon = 1e-6), "{shape:?}: {d}² is not {variance}");
    }

    #[test]
    fn moments_of_shapes_follow_from_absolute_moments() {
        moments_follow(Turbulence);
        moments_follow(Plasma);
        moments_follow(Billow);
        moments_follow(Ridged);
    }
}
