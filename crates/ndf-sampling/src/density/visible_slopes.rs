//! Gaussian slopes seen by a view: mean excess, and inverse of their distribution along the view.

use crate::numeric::normal_distribution::{inverse_gaussian_cdf, phi_and_density};
use asperity_core::lanes::Scalar;
use asperity_core::lanes::elementary::exp;
use asperity_core::math;

/// The smallest `u` that [`visible_slope`] distinguishes from 0.
pub(crate) const LEAST_U: f64 = 1.0 / 4_294_967_296.0;

/// Beyond it a view sees every slope equally, within the rounding of `f64`.
pub(crate) const ZENITH: f64 = 1e17;

/// `E[max(0, X − z)]` of a standard Gaussian `X`, for `z ≥ 0`: `φ(z) − z Φ(−z)`; 0 for infinite `z`
/// and NaN.
///
/// `√2 E/z` with `z = √2 a` is Heitz's Λ for Beckmann.
///
/// - **Accuracy:** 3e-7 relative up to 13; 0 from 13.19 on, where the value is below 5e-41. `E/φ`
///   is a rational function within 5.1e-9, fitted by least squares of relative errors with weights
///   that level them. The exponential is the SIMD one, accurate to 2e-7.
pub(crate) fn excess(z: f64) -> f64 {
    // 1/√(2π) is included in the first of the two.
    const A: [f64; 5] = [
        0.398_942_278_388_777_3,
        0.273_146_252_913_735_4,
        0.095_321_662_854_654_97,
        0.018_341_173_700_489_814,
        0.001_694_654_051_984_454_1,
    ];
    const B: [f64; 6] = [
        1.937_989_848_344_043,
        1.667_851_451_874_996,
        0.824_955_303_931_734_2,
        0.251_525_991_772_032_1,
        0.045_980_309_134_483_456,
        0.004_247_772_245_385_646,
    ];
    // There the exponential is 0. NaN takes this branch too.
    let z = if z < 13.2 { z } else { 13.2 };
    let square = z * z;
    let exponent = -0.5 * square;
    let rounded = exponent as f32;
    let falloff = f64::from(exp(Scalar, rounded)) * (1.0 + (exponent - f64::from(rounded)));
    // Separate even and odd powers are two chains of half the length.
    let above = (A[0] + square * (A[2] + square * A[4])) + z * (A[1] + square * A[3]);
    let below = (1.0 + square * (B[1] + square * (B[3] + square * B[5])))
        + z * (B[0] + square * (B[2] + square * B[4]));
    falloff * above / below
}

/// [`excess`] by its definition; the relative error is about `z² · 10⁻¹⁶`, from the difference.
#[cfg(test)]
pub(crate) fn exact_excess(z: f64) -> f64 {
    let (below, density) = phi_and_density(-z);
    if z > 38.0 { 0.0 } else { (density - z * below).max(0.0) }
}

/// The `u`-quantile of the slope along the view, in standard deviations.
///
/// ```text
/// p(x) = (b + x) φ(x)/(b Φ(b) + φ(b))   for x ≥ −b;       b: the cotangent of the view's angle in standard deviations
/// ```
///
/// - **Domain:** `b ≥ 0`, `u` in `[0, 1)`; `u` below 2⁻³² is read as 2⁻³², NaN in `b` as the
///   zenith.
/// - **Accuracy:** 1e-9, and 1e-6 where `u < 2⁻²⁴`.
///
/// Heitz and d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using the Distribution of
/// Visible Normals", section 5, with the same distribution. They bisect and take Newton steps in
/// erf x. Here Halley steps are taken in √u below the median, where the distribution starts like a
/// square, and in u above it.
pub(crate) fn visible_slope(b: f64, u: f64) -> f64 {
    let u = u.max(LEAST_U);
    SeenSlopes::new(b).quantile(inverse_gaussian_cdf(u), [u, 1.0 - u])
}

/// The slope along the view with the same fractions below and above it among the seen slopes as
/// `gaussian` has among all slopes.
///
/// The identity for views at the zenith. It increases, and never leaves `x ≥ −b`.
pub(crate) fn visible_of_gaussian(b: f64, gaussian: f64) -> f64 {
    let tail = phi_and_density(-gaussian.abs()).0;
    SeenSlopes::new(b)
        .quantile(gaussian, if gaussian < 0.0 { [tail, 1.0 - tail] } else { [1.0 - tail, tail] })
}

/// The inverse of [`visible_of_gaussian`]; infinite where `x` has nothing below or above it.
pub(crate) fn gaussian_of_visible(b: f64, x: f64) -> f64 {
    let [below, above] = SeenSlopes::new(b).fractions(x);
    if below < above { inverse_gaussian_cdf(below) } else { -inverse_gaussian_cdf(above) }
}

/// The distribution of the slopes along a view.
struct SeenSlopes {
    b: f64,
    total: f64,
    /// `b Φ(−b) − φ(b)`, minus the part that the edge cuts off.
    edge: f64,
}

impl SeenSlopes {
    fn new(b: f64) -> Self {
        let b = if b < ZENITH { b } else { ZENITH };
        let (seen, at_edge) = phi_and_density(b);
        Self { b, total: b * seen + at_edge, edge: b * (1.0 - seen) - at_edge }
    }

    /// The fraction below `x`, from `Φ(x)` and `φ(x)`.
    fn below(&self, below_x: f64, gaussian: f64) -> f64 {
        (self.b * below_x - self.edge - gaussian) / self.total
    }

    /// The fraction above `x`, from `Φ(−x)` and `φ(x)`.
    fn above(&self, above_x: f64, gaussian: f64) -> f64 {
        (self.b * above_x + gaussian) / self.total
    }

    /// The fractions below and above `x`.
    fn fractions(&self, x: f64) -> [f64; 2] {
        if x > -self.b {
            let ((below, gaussian), (above, _)) = (phi_and_density(x), phi_and_density(-x));
            [self.below(below, gaussian).max(0.0), self.above(above, gaussian)]
        } else {
            [0.0, 1.0]
        }
    }

    /// The slope with these fractions below and above it, of which `gaussian` is the quantile.
    fn quantile(&self, gaussian: f64, [u, rest]: [f64; 2]) -> f64 {
        let &Self { b, total, .. } = self;
        // Correct for b → ∞ to the second order in 1/b, and never left of the edge at −b.
        let y = b + gaussian;
        let root = math::sqrt_f64(y * y + 4.0);
        let mut x = gaussian + if y > 0.0 { 2.0 / (root + y) } else { 0.5 * (root - y) };
        for _ in 0..MOST_STEPS {
            let height = b + x;
            let (side, gaussian) = phi_and_density(if u < 0.5 { x } else { -x });
            let p = height * gaussian / total;
            // p'/p
            let growth = 1.0 / height - x;
            let step = if u < 0.5 {
                let below = self.below(side, gaussian).max(f64::MIN_POSITIVE);
                let newton = 2.0 * (math::sqrt_f64(u * below) - below) / p;
                newton / (1.0 + 0.5 * newton * (growth - 0.5 * p / below)).max(0.5)
            } else {
                let newton = (self.above(side, gaussian) - rest) / p;
                newton / (1.0 + 0.5 * newton * growth).max(0.5)
            };
            x += step.max(-0.9 * height);
            // The next step is below its cube.
            if step.abs() < 5e-4 {
                break;
            }
        }
        x
    }
}

/// More steps than any `b` and `u` need (measured: 3).
const MOST_STEPS: usize = 8;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::normal_distribution::gaussian_cdf;
    use asperity_core::assert_abs_diff_eq;

    fn density(x: f64) -> f64 {
        (-0.5 * x * x).exp() / core::f64::consts::TAU.sqrt()
    }

    #[test]
    fn excess_equals_its_integral_and_its_series() {
        // ∫_z^∞ Φ(−t) dt by Simpson's rule.
        for z in [0.0, 0.3, 1.0, 2.5, 6.0] {
            let h = 1.0 / 512.0;
            let simpson: f64 = (0..4096)
                .map(|k| z + 2.0 * h * f64::from(k))
                .map(|t| {
                    h / 3.0 * (gaussian_cdf(-t) + 4.0 * gaussian_cdf(-t - h) + gaussian_cdf(-t - 2.0 * h))
                })
                .sum();
            assert_abs_diff_eq!(exact_excess(z) / simpson, 1.0, epsilon = 1e-9, "{z}");
        }
        // φ(z)/z² (1 − 3/z² + 15/z⁴ − 105/z⁶), the last term bounds the error.
        for z in [10.0, 13.0, 20.0, 37.0] {
            let t = 1.0 / (z * z);
            let series = density(z) * t * (1.0 - 3.0 * t + 15.0 * t * t);
            assert_abs_diff_eq!(exact_excess(z) / series, 1.0, epsilon = 110.0 * t * t * t, "{z}");
        }
        assert_eq!([f64::INFINITY, 39.0, f64::NAN].map(exact_excess), [0.0; 3]);
    }

    #[test]
    fn excess_is_a_rational_function_of_the_density() {
        for k in 0..=13_000 {
            let z = 1e-3 * f64::from(k);
            assert_abs_diff_eq!(excess(z) / exact_excess(z), 1.0, epsilon = 3e-7, "{z}");
        }
        assert!(excess(13.18) < 5e-41);
        assert_eq!([13.2, 1e200, f64::INFINITY, f64::NAN].map(excess), [0.0; 4]);
    }

    #[test]
    fn slopes_invert_their_distribution() {
        for b in [0.0, 1e-9, 1e-3, 0.1, 0.5, 1.0, 2.0, 4.0, 4.6, 8.0, 30.0, 1e3, 1e6, 1e12, f64::INFINITY] {
            let total = if b < ZENITH { b * gaussian_cdf(b) + density(b) } else { b };
            let mut last = f64::NEG_INFINITY;
            for k in 0..=400 {
                let u = if k <= 24 { 0.5_f64.powi(32 - k) } else { f64::from(k - 24) / 377.0 };
                let x = visible_slope(b, u);
                let above =
                    if b < ZENITH { (b * gaussian_cdf(-x) + density(x)) / total } else { gaussian_cdf(-x) };
                // Measured: 5e-12, by the cube of the last step.
                assert_abs_diff_eq!(1.0 - above, u, epsilon = 1e-10, "b = {b}: {x}");
                assert!(x >= -b && (x > last || k <= 26), "b = {b}, u = {u}: {x}");
                last = x;
            }
        }
        assert!(visible_slope(1.0, 1.0 - 0.5f64.powi(25)) < 6.0);
        assert_abs_diff_eq!(visible_slope(f64::NAN, 0.5), 0.0, epsilon = 1e-15);
    }
}
