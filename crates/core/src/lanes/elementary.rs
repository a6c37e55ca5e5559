//! Exponential, logarithm, sine and cosine in lanes, by Taylor series after exact argument
//! reduction.
//!
//! Only correctly rounded operations are used, so the results have the same bits on every machine.
//! Series are summed by pairs, which shortens the dependency chain of a single lane.

use crate::lanes::lanes::Arithmetic;

/// 1.5·2²³: adding it rounds to an integer, which the lowest bits hold.
const ROUND: f32 = 12_582_912.0;

/// `exp(x)` for `x ≤ 0`; 0 for NaN and below −87, where the result would be subnormal.
///
/// `x = k ln 2 + r` with |r| ≤ ½ ln 2; the series ends at r⁷/7!, 6e-9 relative. Accuracy: 2e-7
/// relative.
#[inline(always)]
pub fn exp<S: Arithmetic>(s: S, x: S::F) -> S::F {
    let shifted = x * s.float(core::f32::consts::LOG2_E) + s.float(ROUND);
    let k = shifted - s.float(ROUND);
    // ln 2 in two parts. The first has 15 bits, so that its product with k is exact.
    let r = (x - k * s.float(0.693_145_75)) - k * s.float(1.428_606_8e-6);
    let r2 = r * r;
    let low = (s.float(1.0) + r) + r2 * (s.float(1.0 / 2.0) + r * s.float(1.0 / 6.0));
    let high = (s.float(1.0 / 24.0) + r * s.float(1.0 / 120.0))
        + r2 * (s.float(1.0 / 720.0) + r * s.float(1.0 / 5040.0));
    let fraction = low + (r2 * r2) * high;
    let power = s.float_of_bits(s.shl::<23>(s.bits(shifted)) + s.word(1.0_f32.to_bits()));
    s.select(s.less(s.float(-87.0), x), fraction * power, s.float(0.0))
}

/// `(1 − exp(−t))/t` for `t ≥ 0`, 1 at 0.
///
/// Up to t = 1 as `exp(−t/2) sinh(t/2)/(t/2)`, whose series ends at (t/2)⁸/9!. Accuracy: 3e-7
/// relative.
#[inline(always)]
pub fn one_minus_exp_ratio<S: Arithmetic>(s: S, t: S::F, root: S::F) -> S::F {
    let x2 = t * t * s.float(0.25);
    let x4 = x2 * x2;
    let series = (s.float(1.0) + x2 * s.float(1.0 / 6.0))
        + x4 * ((s.float(1.0 / 120.0) + x2 * s.float(1.0 / 5040.0)) + x4 * s.float(1.0 / 362_880.0));
    let far = (s.float(1.0) - root * root) / t;
    s.select(s.less(t, s.float(1.0)), root * series, far)
}

/// `ln(1 + x)` for finite `x > −1`; NaN is not propagated.
///
/// `1 + x = 2ᵏ m` with m in √½ … √2, and `ln m = 2 artanh(f/(2 + f))`, `f = m − 1`, by its series
/// to the ninth power, 5e-9 relative. For k = 0, f is x itself, so that the rounding of `1 + x`
/// does not matter. Accuracy: 3e-7 relative.
#[inline(always)]
pub fn ln_1p<S: Arithmetic>(s: S, x: S::F) -> S::F {
    let one = s.float(1.0);
    let [k, m] = parts(s, one + x);
    ln_of_parts(s, k, s.select(s.less(k * k, one), x, m - one))
}

/// `ln x` for normal, positive, finite `x`. Accuracy: 3e-7 relative, also near 1.
#[inline(always)]
pub fn ln<S: Arithmetic>(s: S, x: S::F) -> S::F {
    let [k, m] = parts(s, x);
    ln_of_parts(s, k, m - s.float(1.0))
}

/// `k` and `m` of `x = 2ᵏ m` with m in √½ … √2.
#[inline(always)]
fn parts<S: Arithmetic>(s: S, x: S::F) -> [S::F; 2] {
    const SQRT_HALF: u32 = core::f32::consts::FRAC_1_SQRT_2.to_bits();
    let shifted = s.bits(x) + s.word(1.0_f32.to_bits() - SQRT_HALF);
    // The biased exponent as a float: in the lowest bits of 2²³.
    let exponent = s.float_of_bits(s.shr::<23>(shifted) | s.word(8_388_608.0_f32.to_bits()));
    let m = s.float_of_bits((shifted & s.word(0x007F_FFFF)) + s.word(SQRT_HALF));
    [exponent - s.float(8_388_608.0 + 127.0), m]
}

/// `k ln 2 + ln(1 + f)` for `1 + f` in √½ … √2.
#[inline(always)]
fn ln_of_parts<S: Arithmetic>(s: S, k: S::F, f: S::F) -> S::F {
    let q = f / (s.float(2.0) + f);
    let q2 = q * q;
    let q4 = q2 * q2;
    let series =
        (s.float(2.0 / 3.0) + q2 * s.float(2.0 / 5.0)) + q4 * (s.float(2.0 / 7.0) + q2 * s.float(2.0 / 9.0));
    let ln_m = q * s.float(2.0) + q * (q2 * series);
    k * s.float(core::f32::consts::LN_2) + ln_m
}

/// `(cos 2πu, sin 2πu)` for |u| < 2²¹.
///
/// The nearest quarter turn is subtracted exactly. The series end at x¹⁰/10! and x⁹/9!. Accuracy:
/// 1.2e-7 absolute.
#[inline(always)]
pub fn cos_sin_turns<S: Arithmetic>(s: S, u: S::F) -> [S::F; 2] {
    let shifted = u * s.float(4.0) + s.float(ROUND);
    let quarters = shifted - s.float(ROUND);
    let x = (u - quarters * s.float(0.25)) * s.float(core::f32::consts::TAU);
    let x2 = x * x;
    let x4 = x2 * x2;
    let cos = (s.float(1.0) - x2 * s.float(1.0 / 2.0))
        + x4 * ((s.float(1.0 / 24.0) - x2 * s.float(1.0 / 720.0))
            + x4 * (s.float(1.0 / 40_320.0) - x2 * s.float(1.0 / 3_628_800.0)));
    let sin = (s.float(1.0) - x2 * s.float(1.0 / 6.0))
        + x4 * ((s.float(1.0 / 120.0) - x2 * s.float(1.0 / 5040.0)) + x4 * s.float(1.0 / 362_880.0));
    let sin = sin * x;
    // Quarter 1: (−sin, cos), 2: (−cos, −sin), 3: (sin, −cos).
    let quarter = s.bits(shifted);
    // The lowest bit as the smallest normal float.
    let odd = s.less(s.float(0.0), s.float_of_bits(s.shl::<23>(quarter & s.word(1))));
    let (a, b) = (s.select(odd, sin, cos), s.select(odd, cos, sin));
    let flip_cos = s.shl::<30>((quarter + s.word(1)) & s.word(2));
    let flip_sin = s.shl::<30>(quarter & s.word(2));
    [s.float_of_bits(s.bits(a) ^ flip_cos), s.float_of_bits(s.bits(b) ^ flip_sin)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::lanes::Scalar;

    /// The largest error of `got` relative to `exact` over `points` arguments.
    fn worst(points: impl Iterator<Item = f32>, got: impl Fn(f32) -> f32, exact: impl Fn(f64) -> f64) -> f64 {
        points.map(|x| (f64::from(got(x)) / exact(f64::from(x)) - 1.0).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn exp_accuracy() {
        let points = (0..200_000).map(|k| k as f32 * -4.3e-4);
        let error = worst(points, |x| exp(Scalar, x), libm::exp);
        assert!(error < 2e-7, "{error:e}");
        assert_eq!([-87.5, f32::NEG_INFINITY, f32::NAN].map(|x| exp(Scalar, x)), [0.0; 3]);
        assert_eq!(exp(Scalar, 0.0), 1.0);
    }

    #[test]
    fn one_minus_exp_ratio_accuracy() {
        let points = (1..100_000).map(|k| k as f32 * 1e-4).chain([1e-30, 1e-10, 1e-6, 40.0, 160.0]);
        let got = |t: f32| one_minus_exp_ratio(Scalar, t, exp(Scalar, -0.5 * t));
        let error = worst(points, got, |t| -libm::expm1(-t) / t);
        assert!(error < 3e-7, "{error:e}");
        assert_eq!(got(0.0), 1.0);
    }

    #[test]
    fn ln_1p_accuracy() {
        let near = (1..100_000).map(|k| k as f32 * 1e-5);
        let points = near
            .clone()
            .map(|x| -x * 0.999_999)
            .chain(near.map(|x| 40.0 * x))
            .chain([1e-30, 1e-8, 1e9, 1e38]);
        let error = worst(points, |x| ln_1p(Scalar, x), libm::log1p);
        assert!(error < 3e-7, "{error:e}");
        assert_eq!(ln_1p(Scalar, 0.0), 0.0);
    }

    #[test]
    fn cos_sin_turns_accuracy() {
        let mut worst = 0.0_f64;
        for k in -100_000..=100_000 {
            let u = k as f32 * 1e-5;
            let turn = core::f64::consts::TAU * f64::from(u);
            for (got, exact) in cos_sin_turns(Scalar, u).into_iter().zip([libm::cos(turn), libm::sin(turn)]) {
                worst = worst.max((f64::from(got) - exact).abs());
            }
        }
        assert!(worst < 1.2e-7, "{worst:e}");
        for (u, exact) in [
            (0.0, [1.0, 0.0]),
            (0.25, [0.0, 1.0]),
            (0.5, [-1.0, 0.0]),
            (0.75, [0.0, -1.0]),
            (1.0, [1.0, 0.0]),
        ] {
            assert_eq!(cos_sin_turns(Scalar, u), exact, "{u}");
        }
    }
}
