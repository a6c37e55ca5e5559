//! Directions and Gaussian variates from the bits of a lattice word, without library logarithms or
//! trigonometry.

use crate::{
    lanes::{Arithmetic, LANES, Lanes, Scalar},
    lattice::gaussian_levels::{POSITIVE_LEVELS, TAIL_LINES},
    lattice::integer_hash::{MULTIPLIERS, further, multiplied},
};

/// Keeps rounded values below 1.
pub(crate) const MARGIN: f32 = 1.0 - 2e-6;
/// 2/√n, the scale with which gradient noise with unit gradients and any weights attains 1 in cell
/// centers.
pub(crate) const UNIT_SCALE: [f32; 4] =
    [MARGIN * 2.0, MARGIN * core::f32::consts::SQRT_2, MARGIN * 1.154_700_5, MARGIN];

/// The top bit of a word, the sign of a float.
const SIGN: u32 = 0x8000_0000;

/// cos and sin of an angle uniform on the circle, from the upper 2 + `BITS` bits of the word.
///
/// The angle is a quarter turn plus −π/4 … π/4 within it. Minimax polynomials, with errors 2e-9 and
/// 6e-8.
#[inline(always)]
fn turn<S: Lanes, const BITS: u32>(s: S, word: S::U) -> [S::F; 2] {
    let step = 1.0 / (1_u32 << BITS) as f32;
    let fraction = match BITS {
        24 => s.shr::<6>(word) & s.word((1 << 24) - 1),
        _ => s.shr::<16>(word) & s.word((1 << 14) - 1),
    };
    let x = s.real(fraction) * s.float(step) + s.float(0.5 * step - 0.5);
    let y = x * x;
    let sine = x
        * (s.float(core::f32::consts::FRAC_PI_2)
            + y * (s.float(-0.645_962_94) + y * (s.float(0.079_675_9) + y * s.float(-0.004_592_29))));
    let cosine =
        s.float(1.0) + y * (s.float(-1.233_697) + y * (s.float(0.253_598_64) + y * s.float(-0.020_408_35)));
    let odd = s.equal(word & s.word(SIGN >> 1), s.word(0));
    let (a, b) = (s.select(odd, cosine, sine), s.select(odd, sine, cosine));
    [s.flip(a, (word ^ s.shl::<1>(word)) & s.word(SIGN)), s.flip(b, word & s.word(SIGN))]
}

/// A direction of length `length`, uniform on the circle, the sphere or the sphere in 4-D;
/// ±`length` in 1-D.
///
/// In 3-D z = 1 − 2u and the angle is 2πv, as in Ebert (ed.) 1994, with 16 bits each.
///
/// - **Accuracy:** unit length within 2e-7.
#[inline(always)]
pub(crate) fn unit_direction<S: Lanes, const N: usize>(s: S, word: S::U, length: f32) -> [S::F; N] {
    let length = s.float(length);
    let mut g = [length; N];
    match N {
        1 => g[0] = s.flip(length, word & s.word(SIGN)),
        2 => {
            let [c, sine] = turn::<S, 24>(s, word);
            g[0] = c * length;
            g[1] = sine * length;
        }
        3 => {
            let u = s.real(word & s.word(0xffff));
            let z = s.float(1.0 - 1.0 / 65_536.0) - u * s.float(2.0 / 65_536.0);
            let r = length * s.sqrt(s.float(1.0) - z * z);
            let [c, sine] = turn::<S, 14>(s, word);
            g[0] = c * r;
            g[1] = sine * r;
            g[2] = z * length;
        }
        _ => {
            let second = further::<S, 1>(s, word);
            let u = (s.real(word & s.word(0xffff)) + s.float(0.5)) * s.float(1.0 / 65_536.0);
            let (r, rest) = (length * s.sqrt(u), length * s.sqrt(s.float(1.0) - u));
            let ([c, sine], [d, tine]) = (turn::<S, 14>(s, word), turn::<S, 14>(s, second));
            let parts = [c * r, sine * r, d * rest, tine * rest];
            g[..N].copy_from_slice(&parts[..N]);
        }
    }
    g
}

/// A number uniform in (−1, 1), a multiple of 2⁻²³ plus half a step.
#[inline(always)]
pub(crate) fn uniform<S: Lanes>(s: S, word: S::U) -> S::F {
    s.real(s.shr::<8>(word)) * s.float(1.0 / 8_388_608.0) + s.float(0.5 / 8_388_608.0 - 1.0)
}

/// 4096 equally likely levels with the moments of N(0, 1) up to the fifth, ascending; the last is
/// repeated.
pub(crate) static LEVELS: [f32; 4097] = signed(&POSITIVE_LEVELS);

const fn signed(positive: &[f32; 2048]) -> [f32; 4097] {
    let mut levels = [positive[2047]; 4097];
    let mut k = 0;
    while k < 2048 {
        levels[2047 - k] = -positive[k];
        levels[2048 + k] = positive[k];
        k += 1;
    }
    levels
}

/// The level selected by the twelve bits of `word` from bit `SHIFT` on.
#[inline(always)]
fn level<S: Lanes, const SHIFT: u32>(s: S, word: S::U) -> S::F {
    s.floats(|lane| LEVELS[((s.lane_word(word, lane) >> SHIFT) & 0xfff) as usize])
}

/// Words this close to 0 modulo 2³² belong to a tail of [`quantile`].
const TAIL: u32 = 4 << 20;

/// z = Φ⁻¹(word/2³² + 2⁻¹³), by chords between levels and by [`tails`] in the tails.
///
/// Levels are Φ⁻¹ of odd multiples of 2⁻¹³.
#[inline(always)]
fn quantile<S: Lanes>(s: S, word: S::U) -> S::F {
    let [low, high] = s.pairs(|lane| {
        let i = (s.lane_word(word, lane) >> 20) as usize;
        [LEVELS[i], LEVELS[i + 1]]
    });
    let mut z = low + (high - low) * (s.real(word & s.word(0xf_ffff)) * s.float(1.0 / 1_048_576.0));
    if s.any(s.equal((word + s.word(TAIL)) & s.word(!(2 * TAIL - 1)), s.word(0))) {
        let (mut words, mut values) = ([0.0; LANES], [0.0; LANES]);
        s.store(s.float_of_bits(word), &mut words);
        s.store(z, &mut values);
        tails(&words, &mut values);
        z = s.load(&values);
    }
    z
}

/// The values of words in the tails, Φ(−|z|) = |x|/2³².
///
/// x is word + 2¹⁹ as a signed number, made odd so that it is not 0. There is one line for every
/// 32nd of a power of two, on which x is not rounded. Chords between the outer levels would be too
/// long. One word of 512 is in a tail.
#[cold]
#[inline(never)]
fn tails(words: &[f32; LANES], values: &mut [f32; LANES]) {
    for (word, value) in words.iter().zip(values) {
        let word = word.to_bits();
        if word.wrapping_add(TAIL) < 2 * TAIL {
            let x = (word.wrapping_add(1 << 19) as i32 | 1) as f32;
            let bits = x.to_bits() & !SIGN;
            let line = TAIL_LINES.get((bits >> 18).wrapping_sub(127 << 5) as usize);
            let [a, b] = line.copied().unwrap_or_default();
            let z = a + b * f32::from_bits(bits & 0x7f_ffff | 0x3f80_0000);
            *value = if x < 0.0 { z } else { -z };
        }
    }
}

/// The Gaussian value of a lattice point and twice its gradient, independent, of channel 0 or 1.
///
/// At lattice points the value alone determines the noise, so it has its own word and uses all bits
/// of it. The components of the gradient never do. They are levels of twelve bits: scaled medians
/// of equal slices of N(0, 1), with the outermost moved to ±3.78, so that second and fourth moment
/// are 1 and 3.
///
/// - **Range:** |s| ≤ 6.24, |g| ≤ 3.78.
/// - **Accuracy of a value**, over all 2³² words: KS distance 9e-6 to N(0, 1), P(|s| > x) within
///   0.1 % of the normal distribution for x ≤ 5 and 0.6 % for x ≤ 5.5, variance 0.99995.
/// - **Accuracy of a component of g:** KS distance 1.7e-4, excess kurtosis 0 up to `f32` rounding.
#[inline(always)]
pub(crate) fn gaussian_variates<S: Lanes, const N: usize, const CHANNEL: u32>(
    s: S,
    word: S::U,
) -> (S::F, [S::F; N]) {
    let by = |k| multiplied(s, word, s.word(MULTIPLIERS[k]));
    if CHANNEL == 0 { variates(s, word, [by(0), by(1)]) } else { variates(s, by(2), [by(3), by(4)]) }
}

/// [`gaussian_variates`] of channel 0 in the lower half of the lanes, of channel 1 in the others.
#[inline(always)]
pub(crate) fn gaussian_variates_of_both<S: Lanes, const N: usize>(s: S, word: S::U) -> (S::F, [S::F; N]) {
    let second = |lane: usize| lane >= S::LEN / 2;
    let by = |first, other| {
        multiplied(s, word, s.words(|lane| MULTIPLIERS[if second(lane) { other } else { first }]))
    };
    let own = multiplied(s, word, s.word(MULTIPLIERS[2]));
    let is_first = s.equal(s.words(|lane| u32::from(second(lane))), s.word(0));
    variates(s, s.select_word(is_first, word, own), [by(0, 3), by(1, 4)])
}

/// The value of one word, and twice the gradient of two others.
#[inline(always)]
fn variates<S: Lanes, const N: usize>(s: S, value: S::U, words: [S::U; 2]) -> (S::F, [S::F; N]) {
    let value = quantile(s, value);
    let mut twice = [value; N];
    for axis in 0..N {
        let word = words[axis / 2 % 2];
        let g = if axis % 2 == 0 { level::<S, 20>(s, word) } else { level::<S, 4>(s, word) };
        twice[axis] = g + g;
    }
    (value, twice)
}

/// Four numbers of a word with a uniform direction: a quaternion before normalization.
pub(crate) fn gaussian_quaternion(word: u32) -> [f32; 4] {
    let word = Scalar.word(word);
    let [second, third] = [further::<_, 1>(Scalar, word), further::<_, 2>(Scalar, word)];
    let sum = level::<_, 4>(Scalar, word) + level::<_, 20>(Scalar, word);
    [
        sum * core::f32::consts::FRAC_1_SQRT_2,
        level::<_, 4>(Scalar, second),
        level::<_, 20>(Scalar, second),
        level::<_, 4>(Scalar, third),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{abs_diff_eq, assert_abs_diff_eq};
    use asperity_core::SplitMix64;

    #[test]
    fn levels_have_the_moments_of_the_normal_distribution() {
        let mean = |power: i32| {
            let levels = LEVELS[..4096].iter();
            levels.map(|&x| (0..power).fold(1.0, |product, _| product * f64::from(x))).sum::<f64>() / 4096.0
        };
        // The error of levels rounded to `f32` is 1e-9.
        for (power, moment) in [(1, 0.0), (2, 1.0), (3, 0.0), (4, 3.0)] {
            assert!(abs_diff_eq!(mean(power), moment, epsilon = 1e-7), "moment {power}: {}", mean(power));
        }
        assert!(LEVELS[..4096].windows(2).all(|pair| pair[0] < pair[1]));
        assert!(LEVELS[4095] < 3.78 && LEVELS[4096] == LEVELS[4095]);
    }

    #[test]
    fn levels_are_mirrored_about_0() {
        let levels = signed(&POSITIVE_LEVELS);
        for k in 0..2048 {
            assert_eq!([levels[2047 - k], levels[2048 + k]], [-POSITIVE_LEVELS[k], POSITIVE_LEVELS[k]]);
        }
        assert_eq!(levels, LEVELS);
    }

    #[test]
    fn every_tail_word_lies_on_its_line() {
        // The tails end within the last exponent.
        for exponent in 0..22_u32 {
            for part in [0, 13, 31] {
                let [a, b] = TAIL_LINES[(exponent << 5 | part) as usize];
                // The first odd number of the part.
                let x = ((1_u64 << exponent) + (u64::from(part) << exponent >> 5)) as u32 | 1;
                let m = x as f32 / (1_u32 << exponent) as f32;
                if f32::to_bits(m) >> 18 & 31 != part {
                    continue;
                }
                let value = quantile(Scalar, Scalar.word(x.wrapping_sub(1 << 19)));
                assert_eq!(value, -(a + b * m), "exponent {exponent}, part {part}");
            }
        }
    }

    #[test]
    fn quantiles_are_odd_and_rise_from_tail_to_tail() {
        let z = |x: i32| quantile(Scalar, Scalar.word((x as u32).wrapping_sub(1 << 19)));
        assert!(z(1) < -6.23 && z(1) > -6.24 && z(-1) == -z(1));
        let mut before = z(1);
        for i in 1..100_000_i32 {
            // Steps from every word in the tail to every 43 000th in the middle.
            let x = (f64::from(i) * f64::from(i) * 0.2147) as i32 | 1;
            // Between lines, and at the first chord, z may fall by their errors.
            assert!(z(x) >= before - 2e-3, "{x}: {} after {before}", z(x));
            // Mirrored words differ by one word, so one may be on a line and the other on a chord
            // over a quarter of its distance from the end. The error of p is then 1/(8 · 4²) of p,
            // and the error of z a third of that.
            assert_abs_diff_eq!(z(x), -z(-x), epsilon = 2.6e-3);
            before = z(x);
        }
        assert_abs_diff_eq!(z(i32::MAX), 0.0, epsilon = 1e-6);
    }

    fn words() -> impl Iterator<Item = core::num::Wrapping<u32>> {
        (0..10_000)
            .map(|counter| Scalar.word(SplitMix64::nth(counter) as u32))
            .chain([0, 1, u32::MAX].map(|w| Scalar.word(w)))
    }

    fn square_of_length<const N: usize>(g: [f32; N]) -> f64 {
        g.iter().map(|&x| f64::from(x) * f64::from(x)).sum()
    }

    #[test]
    fn directions_have_their_lengths() {
        for word in words() {
            let unit = [
                square_of_length(unit_direction::<_, 1>(Scalar, word, 1.0)),
                square_of_length(unit_direction::<_, 2>(Scalar, word, 1.0)),
                square_of_length(unit_direction::<_, 3>(Scalar, word, 1.0)),
                square_of_length(unit_direction::<_, 4>(Scalar, word, 1.0)),
            ];
            for square in unit {
                assert_abs_diff_eq!(square, 1.0, epsilon = 4e-7);
            }
        }
    }

    #[test]
    fn directions_have_mean_zero_and_no_preferred_axis() {
        fn moments<const N: usize>(draw: impl Fn(core::num::Wrapping<u32>) -> [f32; N], square: f64) {
            let n = 10_003.0;
            for i in 0..N {
                let mean: f64 = words().map(|w| f64::from(draw(w)[i])).sum::<f64>() / n;
                let second: f64 = words().map(|w| f64::from(draw(w)[i]).powi(2)).sum::<f64>() / n;
                // 5 standard errors: of a mean at most √square/100, of a square at most √3
                // square/100.
                assert!(
                    abs_diff_eq!(mean, 0.0, epsilon = 0.05 * square.sqrt()),
                    "{N}-D, axis {i}: mean {mean}"
                );
                assert!(
                    abs_diff_eq!(second, square, epsilon = 0.09 * square),
                    "{N}-D, axis {i}: square {second}"
                );
            }
        }
        moments::<2>(|w| unit_direction(Scalar, w, 1.0), 0.5);
        moments::<3>(|w| unit_direction(Scalar, w, 1.0), 1.0 / 3.0);
        moments::<4>(|w| unit_direction(Scalar, w, 1.0), 0.25);
        moments::<3>(|w| gaussian_variates::<_, 3, 1>(Scalar, w).1, 4.0);
    }

    #[test]
    fn angles_turn_all_the_way_round() {
        for i in 0..64_u32 {
            let [c, s] = unit_direction::<_, 2>(Scalar, Scalar.word(i << 26), 1.0);
            let angle = core::f64::consts::TAU * (f64::from(i) / 64.0 - 0.125 + 0.5 / f64::from(1_u32 << 26));
            let quarter = core::f64::consts::FRAC_PI_2 * f64::from(i >> 4);
            // The angle within a quarter, then whole quarters.
            let within = glam::Vec2::from_angle((angle - quarter) as f32);
            let expected = (0..i >> 4).fold(within, |turned, _| turned.perp());
            assert_abs_diff_eq!(glam::Vec2::new(c, s), expected, epsilon = 2e-7);
        }
    }

    #[test]
    fn uniform_stays_inside_the_interval() {
        assert_eq!(uniform(Scalar, Scalar.word(0)), -1.0 + 0.5 / 8_388_608.0);
        assert!(uniform(Scalar, Scalar.word(u32::MAX)) < 1.0);
    }
}
