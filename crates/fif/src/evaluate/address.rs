//! The orbit of a point under the inverse maps: its address, one index per step.

use asperity_core::Interval;

use crate::numeric::double::Double;
use crate::system::map::Piece;

/// One inverse step: the map, and the image of the point under its inverse.
pub(crate) struct Step {
    pub(crate) index: usize,
    /// The new point in units of the domain, in `[0, 1]`.
    pub(crate) s: f64,
    /// Whether the point was exactly the left knot of the map.
    pub(crate) at_knot: bool,
}

pub(crate) trait Orbit {
    fn step<const C: usize>(&mut self, pieces: &[Piece<C>]) -> Step;
}

/// Points whose distances lose no digits, however close they are.
pub(crate) trait Distance: Sized {
    /// The distance between points in units of the domain, rounded; `None` is the left or right end
    /// of the domain.
    fn between(from: Option<&Self>, to: Option<&Self>) -> f64;
}

/// A point on equally spaced knots: a fraction of the domain in 64-bit words, least significant
/// first.
///
/// Its address is exact at every depth if the words contain all bits of the point.
#[derive(Clone, Copy)]
pub(crate) struct Words<const N: usize> {
    words: [u64; N],
}

/// 128 bits: every double from [`Fraction::LEAST`] on.
pub(crate) type Fraction = Words<2>;

/// 1088 bits: every double; the last bit of the smallest one is 2⁻¹⁰⁷⁴.
pub(crate) type LongFraction = Words<17>;

impl Fraction {
    /// The smallest `t` whose 53 bits all lie within the fraction, 2⁻⁷⁵.
    pub(crate) const LEAST: f64 = f64::EPSILON / 8_388_608.0;
}

impl<const N: usize> Words<N> {
    /// `t` in `[0, 1)`, truncated to the bits of the words; values from one on become the largest
    /// fraction.
    #[inline]
    pub(crate) fn new(t: f64) -> Self {
        const MANTISSA: u32 = 52;
        if t >= 1.0 {
            return Self { words: [u64::MAX; N] };
        }
        let bits = t.to_bits();
        let exponent = (bits >> MANTISSA) as usize & 0x7FF;
        let fraction = bits & ((1 << MANTISSA) - 1);
        let mantissa = if exponent == 0 { fraction } else { fraction | 1 << MANTISSA };
        // The last bit of the mantissa weighs 2^(exponent − 1075); the last bit of the words 2^(−64
        // N).
        let last = exponent.max(1) + 64 * N;
        let (shift, cut) = (last.saturating_sub(1075), 1075_usize.saturating_sub(last));
        let mut rest = if cut < 64 { u128::from(mantissa >> cut) << (shift % 64) } else { 0 };
        let mut words = [0; N];
        for word in words.iter_mut().skip(shift / 64) {
            *word = rest as u64;
            rest >>= 64;
        }
        Self { words }
    }

    /// `t` in `(0, 1)`, both parts truncated to the bits of the words.
    pub(crate) fn of(t: Double) -> Self {
        let (mut all, part) = (Self::new(t.hi), Self::new(t.lo.abs()));
        let mut carry = false;
        for (word, part) in all.words.iter_mut().zip(part.words) {
            let step = |a: u64, b: u64| if t.lo < 0.0 { a.overflowing_sub(b) } else { a.overflowing_add(b) };
            let (sum, first) = step(*word, part);
            let (sum, second) = step(sum, u64::from(carry));
            (*word, carry) = (sum, first || second);
        }
        all
    }
}

impl<const N: usize> Orbit for Words<N> {
    #[inline]
    fn step<const C: usize>(&mut self, pieces: &[Piece<C>]) -> Step {
        const ULP: f64 = 1.0 / 18_446_744_073_709_551_616.0;
        let maps = pieces.len() as u128;
        let (mut carry, mut any) = (0, 0);
        for word in &mut self.words {
            carry += u128::from(*word) * maps;
            *word = carry as u64;
            any |= *word;
            carry >>= 64;
        }
        let high = self.words.last().copied().unwrap_or(0);
        Step { index: carry as usize, s: high as f64 * ULP, at_knot: any == 0 }
    }
}

impl Distance for LongFraction {
    fn between(from: Option<&Self>, to: Option<&Self>) -> f64 {
        const BASE: f64 = 18_446_744_073_709_551_616.0;
        let words = |point: Option<&Self>| point.map_or([0; 17], |point| point.words);
        let (mut rest, mut borrow) = (words(to), false);
        for (word, less) in rest.iter_mut().zip(words(from)) {
            let (part, first) = word.overflowing_sub(less);
            let (part, second) = part.overflowing_sub(u64::from(borrow));
            (*word, borrow) = (part, first || second);
        }
        // The right end is one more than the largest words; a negative distance has borrowed one.
        let whole = f64::from(u8::from(to.is_none())) - f64::from(u8::from(borrow));
        if whole < 0.0 {
            return -Self::between(to, from);
        }
        if whole > 0.0 {
            return whole;
        }
        // From the least significant word up, each part is rounded once relative to the sum.
        rest.iter().fold(0.0, |sum, word| sum / BASE + *word as f64 / BASE)
    }
}

/// A point on any knots; its float orbit is that of a point within a few units in the last place.
#[derive(Clone, Copy)]
pub(crate) struct Position {
    s: f64,
}

impl Position {
    pub(crate) fn new(t: f64) -> Self {
        Self { s: t.clamp(0.0, 1.0) }
    }
}

impl Orbit for Position {
    #[inline]
    fn step<const C: usize>(&mut self, pieces: &[Piece<C>]) -> Step {
        let index = pieces.partition_point(|p| p.s[1] <= self.s).min(pieces.len().saturating_sub(1));
        let Some(piece) = pieces.get(index) else { return Step { index, s: 0.0, at_knot: false } };
        let at_knot = self.s == piece.s[0];
        self.s = ((self.s - piece.s[0]) * piece.stretch).clamp(0.0, 1.0);
        Step { index, s: self.s, at_knot }
    }
}

/// A point on any knots to a hundred bits: its distance from the left end.
///
/// The unit makes the domain about one wide.
#[derive(Clone, Copy)]
pub(crate) struct LongPosition {
    at: Double,
    width: Double,
    origin: f64,
    scale: f64,
}

impl LongPosition {
    /// More than the rounding of one step, in units of the domain.
    pub(crate) const ROUNDING: f64 = f64::EPSILON * f64::EPSILON * 64.0;

    /// `x` in the domain.
    pub(crate) fn new(x: f64, domain: Interval) -> Self {
        const MANTISSA: u32 = 52;
        // A power of two, so that only bits below 2⁻¹⁰⁰⁰ of the domain are rounded.
        let exponent = (domain.width().to_bits() >> MANTISSA) as i64 & 0x7FF;
        let scale = f64::from_bits(((2046 - exponent).clamp(1, 2046) as u64) << MANTISSA);
        let mut point = Self { at: Double::from(0.0), width: Double::from(1.0), origin: domain.lo, scale };
        (point.at, point.width) = (point.offset(x), point.offset(domain.hi));
        point
    }

    /// The distance of a position from the left end.
    fn offset(&self, x: f64) -> Double {
        Double::two_sum(x, -self.origin).scaled(self.scale)
    }

    /// In units of the domain.
    pub(crate) fn place(&self) -> Double {
        self.at.quotient(self.width)
    }
}

impl Distance for LongPosition {
    fn between(from: Option<&Self>, to: Option<&Self>) -> f64 {
        let Some(width) = to.or(from).map(|point| point.width) else { return 1.0 };
        let at = from.map_or(Double::from(0.0), |point| point.at);
        to.map_or(width, |point| point.at).minus(at).hi / width.hi
    }
}

impl Orbit for LongPosition {
    fn step<const C: usize>(&mut self, pieces: &[Piece<C>]) -> Step {
        let right = pieces.partition_point(|piece| self.offset(piece.x()[0]) <= self.at);
        let index = right.saturating_sub(1);
        let Some(piece) = pieces.get(index) else { return Step { index, s: 0.0, at_knot: false } };
        let [left, right] = piece.x();
        let within = self.at.minus(self.offset(left));
        let at_knot = within.hi <= 0.0;
        let narrow = Double::two_sum(right, -left).scaled(self.scale);
        self.at = within.times(self.width).quotient(narrow).max(Double::from(0.0)).min(self.width);
        Step { index, s: self.at.hi / self.width.hi, at_knot }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_fractions_contain_both_parts_of_a_double() {
        for (hi, lo) in
            [(0.5, 2f64.powi(-80)), (0.5, -(2f64.powi(-80))), (2f64.powi(-500), -(2f64.powi(-600)))]
        {
            let (all, whole, part) =
                (LongFraction::of(Double { hi, lo }), LongFraction::new(hi), LongFraction::new(lo.abs()));
            let [less, more] = if lo < 0.0 { [all, whole] } else { [whole, all] };
            let mut carry = 0_u128;
            for ((a, b), c) in less.words.iter().zip(part.words).zip(more.words) {
                carry += u128::from(*a) + u128::from(b);
                assert_eq!(carry as u64, c, "{hi:e} {lo:e}");
                carry >>= 64;
            }
        }
    }

    #[test]
    fn long_positions_keep_a_hundred_bits() {
        use crate::FixedFif;
        // L(x) = x/3 over the left part: three steps down and back up.
        for scale in [1.0, 2f64.powi(1000), 2f64.powi(-900)] {
            let x = [0.0, 1.0, 3.0].map(|x| x * scale);
            let f = FixedFif::<2, 2>::affine(&x, &[0.0, 1.0, 0.0], &[0.5, 0.5]).unwrap();
            let mut point = LongPosition::new(0.125 * scale, f.domain());
            for want in [0.375, 1.125, 0.1875] {
                let step = point.step(f.pieces());
                assert!((step.s * 3.0 - want).abs() < 1e-15, "{scale:e}: {} {want}", step.s);
                let rest = point.at.quotient(point.width).times(Double::from(3.0)).minus(Double::from(want));
                assert!(rest.hi.abs() < 4.0 * LongPosition::ROUNDING, "{scale:e}: {rest:?}");
            }
            assert!(LongPosition::new(scale, f.domain()).step(f.pieces()).at_knot);
        }
    }

    #[test]
    fn long_fractions_are_exact() {
        let words = |t: f64| LongFraction::new(t).words;
        assert_eq!((words(1.0), words(0.0), words(f64::NAN)), ([u64::MAX; 17], [0; 17], [0; 17]));
        assert_eq!(words(0.75), core::array::from_fn(|k| if k == 16 { 3 << 62 } else { 0 }));
        // 2⁻¹⁰⁷⁴ of 2⁻¹⁰⁸⁸, and the smallest normal number with every bit of its mantissa.
        assert_eq!(words(f64::from_bits(1)), core::array::from_fn(|k| if k == 0 { 1 << 14 } else { 0 }));
        let normal = f64::MIN_POSITIVE * (2.0 - f64::EPSILON);
        let want = [((1_u64 << 53) - 1) << 14, (1 << 3) - 1];
        assert_eq!(words(normal), core::array::from_fn(|k| if k < 2 { want[k] } else { 0 }));
        assert_eq!((Fraction::new(0.75).words, Fraction::new(1.0).words), ([0, 3 << 62], [u64::MAX; 2]));
        assert_eq!(Fraction::new(Fraction::LEAST * (1.0 + f64::EPSILON)).words, [(1 << 53) + 2, 0]);
        assert_eq!((Fraction::new(f64::NAN).words, Fraction::new(1e-300).words), ([0; 2], [0; 2]));
    }
}
