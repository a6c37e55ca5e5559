//! The distribution of a noise from its excess kurtosis.

use crate::coordinates::bounded_coordinate;
use crate::error::{NdfError, in_range};
use crate::noise_distribution::distribution::{NoiseDistribution, check};
use asperity_core::math::sqrt_f64;

/// A nearly Gaussian noise, given only its standard deviation and its excess kurtosis `κ`.
///
/// ```text
/// κ ≤ 0:  z = x + a (x³ − 3x);        κ ≥ 0:  x = z + a (z³ − 3z);        x = d r/σ
/// ```
///
/// A sum of octaves of classic noise has `σ² = σ₁² Σ w²a²` and `κ = κ₁ Σ w⁴a⁴/(Σ w²a²)²`, which
/// change as an octave fades in. One family of distributions serves every number of octaves and
/// every blend. A table measured for one of them has a Kolmogorov–Smirnov distance of up to 0.03
/// from the others.
///
/// The constant `a` is the one for which the excess kurtosis is `κ`, and `d` is the standard
/// deviation of `x` before scaling. For `κ ≥ 0` they solve
///
/// ```text
/// κ + 3 = (3 + 24a + 252a² + 1296a³ + 3348a⁴)/d⁴,  d² = 1 + 6a²
/// ```
///
/// For `κ < 0` no such polynomials are known, and `a` and `d` are fitted polynomials of `κ`. Their
/// first order is `a = |κ|/24`, which alone would turn `κ = 0.85` into 1.17.
///
/// - **Domain:** `κ` in [−1.5, 2], where both forms increase everywhere. The first form never has a
///   kurtosis below −1.71. Values are clamped to ±13 Gaussian standard deviations.
/// - **Moments:** standard deviation to 3e-6 relative, excess kurtosis to 3e-5.
/// - **Accuracy:** each form is inverted to `f32` rounding. Kolmogorov–Smirnov distance to the
///   measured distributions of classic noises in 3-D, eight octaves of gain ½, whose kurtosis is
///   0.6 times the kurtosis of one octave:
///
/// | noise | κ | a Gaussian | this |
/// |---|---|---|---|
/// | Perlin 1985 | −0.22 | 0.0058 | 0.0004 |
/// | Perlin 2002 | −0.28 | 0.0076 | 0.0002 |
/// | value | −0.39 | 0.0111 | 0.0010 |
/// | value-gradient | −0.30 | 0.0080 | 0.0007 |
/// | simplex, r² = 0.5; 0.6 | −0.20; −0.44 | 0.0038; 0.0132 | 0.0039; 0.0011 |
/// | sparse convolution | 0.85 | 0.0272 | 0.0127 |
///
/// ```
/// use asperity_ndf_sampling::{KurtoticDistribution, NoiseDistribution};
///
/// // Perlin noise of 2002 has thinner tails than a Gaussian: two deviations are rarer.
/// let g = KurtoticDistribution::new(1.0, -0.46)?;
/// assert!(g.invert(2.5) > 2.6);
/// assert!(KurtoticDistribution::new(1.0, 3.0).is_err());
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Cornish, Fisher 1938, "Moments and Cumulants in the Specification of Distributions", to the
/// fourth cumulant. The normalizing form is used for `κ ≤ 0` and the quantile form for `κ ≥ 0`,
/// since each is monotone only there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KurtoticDistribution {
    deviation: f32,
    kurtosis: f32,
    /// `a`, not negative.
    bend: f32,
    /// `σ/d`.
    scale: f32,
}

#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; KurtoticDistribution: noise => noise.deviation, noise.kurtosis; }

impl KurtoticDistribution {
    /// The smallest excess kurtosis.
    pub const MIN_KURTOSIS: f32 = -1.5;

    /// The largest excess kurtosis.
    pub const MAX_KURTOSIS: f32 = 2.0;

    /// Creates the distribution with the standard deviation `σ` and the excess kurtosis `κ`.
    ///
    /// # Errors
    /// A standard deviation that is not positive, normal and finite; a kurtosis outside [−1.5, 2].
    pub fn new(deviation: f32, kurtosis: f32) -> Result<Self, NdfError> {
        in_range("kurtosis", kurtosis, [Self::MIN_KURTOSIS, Self::MAX_KURTOSIS])?;
        let deviation = check(deviation)?;
        let (bend, d) =
            if kurtosis > 0.0 { spread(f64::from(kurtosis)) } else { bounded(f64::from(kurtosis)) };
        Ok(Self { deviation, kurtosis, bend: bend as f32, scale: (f64::from(deviation) / d) as f32 })
    }
}

impl NoiseDistribution for KurtoticDistribution {
    fn invert(&self, r: f32) -> f32 {
        let x = bounded_coordinate(r / self.scale);
        let z = if self.kurtosis <= 0.0 { cubic(x, self.bend) } else { inverse_cubic(x, self.bend) };
        bounded_coordinate(z)
    }

    fn warp_gaussian(&self, z: f32) -> f32 {
        let z = bounded_coordinate(z);
        let x = if self.kurtosis <= 0.0 { inverse_cubic(z, self.bend) } else { cubic(z, self.bend) };
        x * self.scale
    }
}

/// `a` and `d` for `κ > 0`, from the moments of `z + a (z³ − 3z)`.
fn spread(kurtosis: f64) -> (f64, f64) {
    let mut a = kurtosis / 24.0;
    for _ in 0..NEWTON {
        let variance = 1.0 + 6.0 * a * a;
        let fourth = 3.0 + a * (24.0 + a * (252.0 + a * (1296.0 + a * 3348.0)));
        let slope = 24.0 + a * (504.0 + a * (3888.0 + a * 13_392.0));
        // Newton's method on fourth − (κ + 3) variance²; it is convex and the root is below the
        // start.
        let excess = fourth - (kurtosis + 3.0) * variance * variance;
        a -= excess / (slope - (kurtosis + 3.0) * 24.0 * a * variance);
    }
    (a, sqrt_f64(1.0 + 6.0 * a * a))
}

/// Steps from `κ/24`, which is off by at most 0.02; convergence is quadratic from there.
const NEWTON: usize = 5;

/// `a` and `d` for `κ ≤ 0`, of the `x` with `x + a (x³ − 3x) = z`.
///
/// Polynomials fitted at Chebyshev points of [−1.5, 0]: 1.2e-5 in the kurtosis and 1.5e-6 in `d`.
fn bounded(kurtosis: f64) -> (f64, f64) {
    const BEND: [f64; 7] = [
        0.041_653_971_4,
        -0.047_024_413_6,
        0.015_217_841_6,
        -0.010_977_127_6,
        -0.008_173_108_53,
        -0.002_395_618_61,
        0.000_330_308_27,
    ];
    const DEVIATION: [f64; 7] = [
        1.0,
        9.645_357_14e-5,
        0.037_563_553,
        -0.028_811_398_6,
        0.012_321_918_1,
        0.011_560_416_6,
        0.004_075_037_93,
    ];
    let at = |polynomial: [f64; 7]| polynomial.into_iter().rev().fold(0.0, |sum, c| sum * kurtosis + c);
    (-kurtosis * at(BEND), at(DEVIATION))
}

/// `t + a (t³ − 3t)`, increasing for `0 ≤ a < 1/3`.
fn cubic(t: f32, a: f32) -> f32 {
    t + a * t * (t * t - 3.0)
}

/// The `t` with `t + a (t³ − 3t) = y`.
fn inverse_cubic(y: f32, a: f32) -> f32 {
    let (a, y) = (f64::from(a), f64::from(y));
    // Newton's method from above: right of its root the cubic of |y| is convex and increasing, so
    // that every step stays there. The start ignores the cube.
    let (mut t, size) = (y.abs() / (1.0 - 3.0 * a), y.abs());
    for _ in 0..STEPS {
        t -= (t + a * t * (t * t - 3.0) - size) / (1.0 + 3.0 * a * (t * t - 1.0));
    }
    if y < 0.0 { -t as f32 } else { t as f32 }
}

/// Newton steps: each removes a third where the cube dominates, and doubles the digits at the end.
const STEPS: usize = 10;

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn both_forms_increase_and_round_trip() {
        for kurtosis in [-1.5, -0.65, 0.0, 0.4, 2.0] {
            let g = KurtoticDistribution::new(0.3, kurtosis).unwrap();
            let mut before = f32::NEG_INFINITY;
            // Fewer than 13 scales.
            for k in -385..=385 {
                let r = k as f32 * 0.01;
                let z = g.invert(r);
                // Farther out the bound of the Gaussian coordinates is reached.
                assert!(z > before || z.abs() == 13.0, "κ = {kurtosis}, r = {r}");
                before = z;
                if z.abs() < 13.0 {
                    let back = g.warp_gaussian(z);
                    assert_abs_diff_eq!(back, r, epsilon = 1e-6 * (1.0 + r.abs()), "κ = {kurtosis}, r =");
                }
            }
            assert_abs_diff_eq!(g.quantile(g.cdf(0.2)), 0.2, epsilon = 1e-6);
        }
    }

    #[test]
    fn moments_match_the_parameters() {
        // Means over the Gaussian, by a fine sum.
        for kurtosis in [-1.5_f32, -1.2, -0.46, -0.05, 0.0, 0.05, 0.3, 0.85, 1.4, 2.0] {
            let g = KurtoticDistribution::new(1.7, kurtosis).unwrap();
            let (mut second, mut fourth) = (0.0, 0.0);
            for k in -3000..=3000 {
                let z = f64::from(k) * 0.003;
                let weight =
                    asperity_core::math::exp_f64(-0.5 * z * z) * 0.003 / sqrt_f64(core::f64::consts::TAU);
                let x = f64::from(g.warp_gaussian(z as f32)) / 1.7;
                second += weight * x * x;
                fourth += weight * (x * x) * (x * x);
            }
            assert_abs_diff_eq!(second, 1.0, epsilon = 6e-6, "{kurtosis}: {second}");
            let excess = fourth / (second * second) - 3.0;
            assert_abs_diff_eq!(excess, f64::from(kurtosis), epsilon = 3e-5, "{kurtosis}");
        }
    }

    #[test]
    fn accepts_every_input() {
        for kurtosis in [-1.5, 0.5] {
            let g = KurtoticDistribution::new(1e-30, kurtosis).unwrap();
            for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38, -1e38, 1e-40] {
                assert!(g.invert(bad).is_finite() && g.warp_gaussian(bad).is_finite(), "{bad}");
                assert!((0.0..=1.0).contains(&g.cdf(bad)) && g.quantile(bad).is_finite(), "{bad}");
            }
        }
    }
}
