//! The Gaussian distribution in SIMD lanes: tail, quantile, and Gaussian slopes along a view.

use asperity_core::lanes::Arithmetic;
use asperity_core::lanes::elementary::{exp, ln};

/// The smallest uniform number that a quantile distinguishes from 0.
pub(crate) const LEAST_U: f32 = 1.0 / 4_294_967_296.0;

/// `1/√(2π)`.
const FRAC_1_SQRT_2PI: f32 = 0.398_942_3;

/// Beyond it a view sees every slope equally, within 1e-6.
const ZENITH: f32 = 1e6;

/// Mills' ratio `Φ(−x)/φ(x)` for `x ≥ 0`: `t P(t)`, `t = 1/(1 + 0.33 x)`, fitted to 7e-8 relative
/// over all x.
#[inline(always)]
fn mills_ratio<S: Arithmetic>(s: S, x: S::F) -> S::F {
    const P: [f32; 10] = [
        0.329_999_98,
        0.330_003_74,
        0.293_970_06,
        0.222_906_14,
        0.125_405_16,
        0.012_852_157,
        0.053_225_066,
        -0.277_753_9,
        0.214_995_02,
        -0.052_289_367,
    ];
    let t = s.float(1.0) / (s.float(1.0) + x * s.float(0.33));
    let t2 = t * t;
    let t4 = t2 * t2;
    let low = (s.float(P[0]) + t * s.float(P[1])) + t2 * (s.float(P[2]) + t * s.float(P[3]));
    let middle = (s.float(P[4]) + t * s.float(P[5])) + t2 * (s.float(P[6]) + t * s.float(P[7]));
    let high = s.float(P[8]) + t * s.float(P[9]);
    t * (low + t4 * (middle + t4 * high))
}

/// [`mills_ratio`] to 1e-4 relative, for an intermediate step.
#[inline(always)]
fn rough_mills_ratio<S: Arithmetic>(s: S, x: S::F) -> S::F {
    let t = s.float(1.0) / (s.float(1.0) + x * s.float(0.4));
    let t2 = t * t;
    let low = s.float(0.399_989_74) + t * s.float(0.402_338_87);
    let high = s.float(0.302_258_1) + t * s.float(0.361_063_16);
    t * (low + t2 * (high - t2 * s.float(0.212_454_62)))
}

/// `φ(x)`.
#[inline(always)]
fn density<S: Arithmetic>(s: S, x: S::F) -> S::F {
    exp(s, x * x * s.float(-0.5)) * s.float(FRAC_1_SQRT_2PI)
}

/// `Φ(−x)` for the `tail` beyond |x|.
#[inline(always)]
fn above<S: Arithmetic>(s: S, x: S::F, tail: S::F) -> S::F {
    s.select(s.less(x, s.float(0.0)), s.float(1.0) - tail, tail)
}

/// |x|.
#[inline(always)]
fn magnitude<S: Arithmetic>(s: S, x: S::F) -> S::F {
    s.float_of_bits(s.bits(x) & s.word(0x7FFF_FFFF))
}

/// `Φ⁻¹(u)` for `u` in [2⁻³², 1 − 2⁻²⁴].
///
/// `√2 erf⁻¹(x)/x` with `x = 2u − 1` by two polynomials, in `w = −ln(1 − x²)` below 5.4 and in `√w`
/// above. The method is from Giles 2010, "Approximating the erfinv function", fitted again to 2e-7
/// relative up to `w = 22.3`. Accuracy: 1e-6 relative to 1 + |Φ⁻¹|.
#[inline(always)]
pub(crate) fn inverse_gaussian_cdf<S: Arithmetic>(s: S, u: S::F) -> S::F {
    const NEAR: [f32; 9] = [
        1.501_409_3,
        0.246_641_08,
        -0.004_177_151_2,
        -0.001_254_203_7,
        2.180_755_7e-4,
        -4.231_298_6e-6,
        -3.379_765e-6,
        3.283_630_6e-7,
        1.584_308_3e-8,
    ];
    const FAR: [f32; 9] = [
        2.832_976_8,
        1.001_679_9,
        0.009_442_821,
        -0.007_702_142,
        0.005_732_530_7,
        -0.003_381_568_2,
        0.001_250_364_1,
        -2.238_207e-4,
        9.556_487e-6,
    ];
    let one = s.float(1.0);
    let x = (u + u) - one;
    let w = -ln(s, u * (one - u) * s.float(4.0));
    let central = s.less(w, s.float(5.4));
    let t = s.select(central, w - s.float(2.5), s.sqrt(w) - s.float(3.0));
    let mut sum = s.float(0.0);
    for (near, far) in NEAR.into_iter().zip(FAR).rev() {
        sum = sum * t + s.select(central, s.float(near), s.float(far));
    }
    sum * x * s.float(core::f32::consts::SQRT_2)
}

/// `Φ⁻¹(u)` to 2e-3 relative, as a starting point: one polynomial in `√(w + 2)`.
#[inline(always)]
fn rough_inverse_phi<S: Arithmetic>(s: S, u: S::F) -> S::F {
    let one = s.float(1.0);
    let t = s.sqrt(s.float(2.0) - ln(s, u * (one - u) * s.float(4.0)));
    let low = s.float(1.745_07) - t * s.float(2.147_86);
    let high = (s.float(1.691_288) - t * s.float(0.329_287_5)) + t * t * s.float(0.023_135_82);
    (low + t * t * high) * ((u + u) - one)
}

/// The `u`-quantile of the slope along the view, in standard deviations; see `visible_gaussian`.
///
/// Two steps of the same iteration, in `f32`. The fraction of slopes below the result is `u` within
/// 8e-7, and within 2e-6 below u = 10⁻⁵.
#[inline(always)]
pub(crate) fn visible_slope<S: Arithmetic>(s: S, b: S::F, u: S::F) -> S::F {
    let (zero, one, half) = (s.float(0.0), s.float(1.0), s.float(0.5));
    let b = s.at_most(b, ZENITH);
    let u = s.at_least(u, LEAST_U);
    let at_edge = density(s, b);
    let per_total = one / (b * (one - at_edge * mills_ratio(s, b)) + at_edge);
    let gaussian = rough_inverse_phi(s, u);
    let y = b + gaussian;
    let root = s.sqrt(y * y + s.float(4.0));
    let positive = s.less(zero, y);
    let ahead = s.select(positive, s.float(2.0) / (root + y), (root - y) * half);
    let x = gaussian + ahead;
    let here = density(s, x);
    let x = closer(s, [b, u, per_total], x, [here, here * rough_mills_ratio(s, magnitude(s, x))]);
    let here = density(s, x);
    closer(s, [b, u, per_total], x, [here, here * mills_ratio(s, magnitude(s, x))])
}

/// One step towards the `u`-quantile from `x`, given the Gaussian density and the tail beyond |x|.
#[inline(always)]
fn closer<S: Arithmetic>(s: S, [b, u, per_total]: [S::F; 3], x: S::F, [density, tail]: [S::F; 2]) -> S::F {
    let (one, half) = (s.float(1.0), s.float(0.5));
    let height = s.at_least(b + x, 1e-20);
    let q = density * per_total;
    let p = height * q;
    let per_p = one / p;
    let growth = q * per_p - x;
    let above = b * per_total * above(s, x, tail) + q;
    let below = s.at_least(one - above, 1e-12);
    let lower = s.less(u, half);
    let newton = s.select(lower, s.float(2.0) * (s.sqrt(u * below) - below), above - (one - u)) * per_p;
    let bend = s.select(lower, growth - half * p / below, growth);
    let step = newton / s.at_least(one + half * newton * bend, 0.5);
    let least = height * s.float(-0.9);
    x + s.select(s.less(step, least), least, step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::normal_distribution;
    use asperity_core::assert_abs_diff_eq;
    use asperity_core::lanes::Scalar;

    #[test]
    fn tail_is_relatively_accurate() {
        for k in -500..=1300 {
            let x = k as f32 * 0.01;
            let tail = density(Scalar, x) * mills_ratio(Scalar, x.abs());
            let tail = above(Scalar, x, tail);
            let exact = normal_distribution::gaussian_cdf(-f64::from(x));
            // The exponential magnifies the rounding of x²/2.
            let bound = 5e-7 + 6e-8 * f64::from(x * x);
            assert_abs_diff_eq!(f64::from(tail) / exact, 1.0, epsilon = bound, "{x}");
        }
    }

    #[test]
    fn quantile_is_accurate_over_its_domain() {
        let mut worst = 0.0_f64;
        let powers = (1..=32).map(|k| 0.5_f32.powi(k));
        let near_one = (2..=24).map(|k| 1.0 - 0.5_f32.powi(k));
        for u in (1..2000).map(|k| k as f32 / 2000.0).chain(powers).chain(near_one) {
            let exact = normal_distribution::inverse_gaussian_cdf(f64::from(u));
            worst =
                worst.max((f64::from(inverse_gaussian_cdf(Scalar, u)) - exact).abs() / (1.0 + exact.abs()));
        }
        assert!(worst < 1e-6, "{worst:e}");
        assert_eq!(inverse_gaussian_cdf(Scalar, 0.5), 0.0);
    }

    #[test]
    fn slopes_invert_their_distribution() {
        let (mut worst, mut at_edge) = ((0.0_f64, 0.0, 0.0), (0.0_f64, 0.0, 0.0));
        for b in [0.0, 1e-9, 1e-3, 0.03, 0.1, 0.5, 1.0, 2.0, 4.0, 4.6, 8.0, 30.0, 1e3, 1e6, f32::INFINITY] {
            let exact = f64::from(b.min(1e9));
            let density = |x: f64| (-0.5 * x * x).exp() / core::f64::consts::TAU.sqrt();
            let total = exact * normal_distribution::gaussian_cdf(exact) + density(exact);
            for k in 0..=2000 {
                let u = if k <= 32 { 0.5_f32.powi(32 - k) } else { (k - 33) as f32 / 1968.0 };
                let u = u.min(1.0 - f32::EPSILON / 2.0);
                let x = f64::from(visible_slope(Scalar, b, u));
                let above = (exact * normal_distribution::gaussian_cdf(-x) + density(x)) / total;
                let error = (1.0 - above - f64::from(u)).abs();
                let worst = if u < 1e-5 { &mut at_edge } else { &mut worst };
                if error > worst.0 {
                    *worst = (error, b, u);
                }
                assert!(x >= -exact, "b = {b}, u = {u}: {x}");
            }
        }
        assert!(worst.0 < 8e-7 && at_edge.0 < 2e-6, "{worst:?} {at_edge:?}");
    }
}
