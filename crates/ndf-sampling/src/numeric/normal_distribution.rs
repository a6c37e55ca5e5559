//! The Gaussian CDF Φ and its inverse, in `f64`.

use asperity_core::math;

/// `Φ(z)`: the probability that a standard Gaussian is at most `z`.
///
/// ```text
/// Φ(z) = ∫_{−∞}^z exp(−t²/2) dt / √(2π) = erfc(−z/√2)/2
/// ```
///
/// - **Domain:** all reals; NaN returns NaN.
/// - **Range:** `[0, 1]`, exactly 0 below −38.5 and 1 above 8.3.
/// - **Accuracy:** 2e-15 relative for `z ≥ −8`, against 25-digit values.
///
/// ```
/// use asperity_ndf_sampling::{inverse_gaussian_cdf, gaussian_cdf};
///
/// assert_eq!(gaussian_cdf(0.0), 0.5);
/// assert!((gaussian_cdf(1.25) + gaussian_cdf(-1.25) - 1.0).abs() < 1e-15);
/// assert!((inverse_gaussian_cdf(gaussian_cdf(-3.0)) + 3.0).abs() < 1e-14);
/// ```
///
/// Cody 1969, "Rational Chebyshev Approximations for the Error Function", in the arrangement of his
/// ANORM 1993.
#[must_use]
#[doc(alias = "erf")]
#[doc(alias = "normal cdf")]
pub fn gaussian_cdf(z: f64) -> f64 {
    phi_and_density(z).0
}

/// `Φ(z)` and the density `φ(z) = exp(−z²/2)/√(2π)`, which share an exponential.
#[inline(always)]
pub(crate) fn phi_and_density(z: f64) -> (f64, f64) {
    const FRAC_1_SQRT_2PI: f64 = 0.398_942_280_401_432_7;
    if z.is_nan() {
        return (z, z);
    }
    let y = z.abs();
    if y <= SPLIT {
        let t = z * z;
        return (0.5 + z * ratio(&NEAR, t), FRAC_1_SQRT_2PI * math::exp_f64(-0.5 * t));
    }
    let tail = if y <= FAR {
        ratio(&MIDDLE, y)
    } else {
        let t = 1.0 / (z * z);
        (FRAC_1_SQRT_2PI - t * ratio(&TAIL, t)) / y
    };
    // exp(−y²/2) in two factors, because y² alone would lose y²/2 ulp in the far tail.
    let coarse = math::floor_f64(y * 16.0) / 16.0;
    let fine = (y - coarse) * (y + coarse);
    let falloff = math::exp_f64(-0.5 * coarse * coarse) * math::exp_f64(-0.5 * fine);
    // At infinity the fine part is NaN, while the tail is 0.
    let (tail, density) = if y > 40.0 { (0.0, 0.0) } else { (falloff * tail, FRAC_1_SQRT_2PI * falloff) };
    (if z > 0.0 { 1.0 - tail } else { tail }, density)
}

/// `Φ⁻¹(u)`: the quantile of the standard Gaussian.
///
/// - **Domain:** `[0, 1]`; `u ≤ 0` returns −∞, `u ≥ 1` returns +∞, NaN returns NaN.
/// - **Accuracy:** 4e-15 relative to the exact value of the `f64` input.
///
/// Wichura 1988, "Algorithm AS 241: The Percentage Points of the Normal Distribution", PPND16.
#[must_use]
#[doc(alias = "probit")]
#[doc(alias = "erfinv")]
#[doc(alias = "quantile")]
pub fn inverse_gaussian_cdf(u: f64) -> f64 {
    let q = u - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(&CENTRE, 0.180_625 - q * q);
    }
    let tail = if q < 0.0 { u } else { 1.0 - u };
    if tail.is_nan() {
        return tail;
    }
    let z = if tail <= 0.0 {
        f64::INFINITY
    } else {
        let r = math::sqrt_f64(-math::ln_f64(tail));
        if r <= 5.0 { ratio(&SHOULDER, r - 1.6) } else { ratio(&OUTER, r - 5.0) }
    };
    if q < 0.0 { -z } else { z }
}

/// Below this |z| the series around 0 is used.
const SPLIT: f64 = 0.662_91;

/// √32: beyond this |z| the asymptotic series in 1/z² is used.
const FAR: f64 = 4.0 * core::f64::consts::SQRT_2;

/// A ratio of two polynomials: numerator and denominator from the highest power down.
type Ratio<const N: usize> = [[f64; N]; 2];

fn ratio<const N: usize>([numerator, denominator]: &Ratio<N>, t: f64) -> f64 {
    let horner = |c: &[f64; N]| c.iter().fold(0.0, |sum, &c| sum * t + c);
    horner(numerator) / horner(denominator)
}

const NEAR: Ratio<5> = [
    [
        0.065_682_337_918_207_45,
        2.235_252_035_460_683_7,
        161.028_231_068_555_87,
        1_067.689_485_460_370_9,
        18_154.981_253_343_56,
    ],
    [1.0, 47.202_581_904_688_245, 976.098_551_737_776_7, 10_260.932_208_618_979, 45_507.789_335_026_73],
];

const MIDDLE: Ratio<9> = [
    [
        1.076_557_677_372_019_2e-08,
        0.398_941_512_088_138_44,
        8.883_149_794_388_377,
        93.506_656_132_177_85,
        597.270_276_394_800_2,
        2_494.537_585_290_372_6,
        6_848.190_450_536_283,
        11_602.651_437_647_35,
        9_842.714_838_383_978,
    ],
    [
        1.0,
        22.266_688_044_328_117,
        235.387_901_782_625,
        1_519.377_599_407_554_7,
        6_485.558_298_266_761,
        18_615.571_640_885_097,
        34_900.952_721_145_98,
        38_912.003_286_093_27,
        19_685.429_676_859_992,
    ],
];

const TAIL: Ratio<6> = [
    [
        0.023_073_441_764_940_174,
        0.215_898_534_057_957,
        0.127_401_161_160_247_36,
        0.022_235_277_870_649_807,
        0.001_421_619_193_227_893_4,
        2.911_287_495_116_879_3e-05,
    ],
    [
        1.0,
        1.284_260_096_144_911,
        0.468_238_212_480_865_1,
        0.065_988_137_868_928_56,
        0.003_782_396_332_027_582_4,
        7.297_515_550_839_662e-05,
    ],
];

const CENTRE: Ratio<8> = [
    [
        2_509.080_928_730_122_7,
        33_430.575_583_588_13,
        67_265.770_927_008_7,
        45_921.953_931_549_87,
        13_731.693_765_509_46,
        1_971.590_950_306_551_3,
        133.141_667_891_784_38,
        3.387_132_872_796_366_5,
    ],
    [
        5_226.495_278_852_854,
        28_729.085_735_721_943,
        39_307.895_800_092_71,
        21_213.794_301_586_597,
        5_394.196_021_424_751,
        687.187_007_492_057_9,
        42.313_330_701_600_91,
        1.0,
    ],
];

const SHOULDER: Ratio<8> = [
    [
        0.000_774_545_014_278_341_4,
        0.022_723_844_989_269_184,
        0.241_780_725_177_450_6,
        1.270_458_252_452_368_4,
        3.647_848_324_763_204_5,
        5.769_497_221_460_691,
        4.630_337_846_156_546,
        1.423_437_110_749_683_5,
    ],
    [
        1.050_750_071_644_416_9e-09,
        0.000_547_593_808_499_534_5,
        0.015_198_666_563_616_457,
        0.148_103_976_427_480_08,
        0.689_767_334_985_1,
        1.676_384_830_183_803_8,
        2.053_191_626_637_759,
        1.0,
    ],
];

const OUTER: Ratio<8> = [
    [
        2.010_334_399_292_288_1e-07,
        2.711_555_568_743_487_6e-05,
        0.001_242_660_947_388_078_4,
        0.026_532_189_526_576_124,
        0.296_560_571_828_504_87,
        1.784_826_539_917_291_3,
        5.463_784_911_164_114,
        6.657_904_643_501_103,
    ],
    [
        2.044_263_103_389_939_7e-15,
        1.421_511_758_316_446e-07,
        1.846_318_317_510_054_8e-05,
        0.000_786_869_131_145_613_3,
        0.014_875_361_290_850_615,
        0.136_929_880_922_735_8,
        0.599_832_206_555_888,
        1.0,
    ],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phi_and_inverse_phi_at_the_edges() {
        assert_eq!(gaussian_cdf(f64::NEG_INFINITY), 0.0);
        assert_eq!(gaussian_cdf(f64::INFINITY), 1.0);
        assert_eq!(
            (inverse_gaussian_cdf(0.0), inverse_gaussian_cdf(1.0)),
            (f64::NEG_INFINITY, f64::INFINITY)
        );
        assert_eq!(
            (inverse_gaussian_cdf(-1.0), inverse_gaussian_cdf(2.0)),
            (f64::NEG_INFINITY, f64::INFINITY)
        );
        assert!(gaussian_cdf(f64::NAN).is_nan() && inverse_gaussian_cdf(f64::NAN).is_nan());
        assert_eq!((gaussian_cdf(0.0), inverse_gaussian_cdf(0.5)), (0.5, 0.0));
    }

    #[test]
    fn inverse_phi_round_trips() {
        for k in -800..=500 {
            let z = f64::from(k) / 100.0;
            // Above 0 the rounding of Φ near 1 dominates: half an ulp of 1 over the density.
            let rounding = 1.2e-16 * (0.5 * z * z).exp() * 2.6;
            let error = (inverse_gaussian_cdf(gaussian_cdf(z)) - z).abs();
            assert!(error < 1e-14 + if z > 0.0 { rounding } else { 0.0 }, "z = {z}: {error:e}");
        }
    }

    #[test]
    fn seams_of_the_approximations_are_monotone() {
        for seam in [-FAR, -SPLIT, SPLIT, FAR] {
            assert!(
                gaussian_cdf(seam - 1e-9) <= gaussian_cdf(seam)
                    && gaussian_cdf(seam) <= gaussian_cdf(seam + 1e-9),
                "{seam}"
            );
        }
    }
}
