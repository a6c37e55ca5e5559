//! The orbit of a point under the inverse maps: its address, one index per step.

use crate::numeric::double::Double;
use crate::system::map::Piece;

/// One inverse step: the map, and where in the domain its inverse sends the point.
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

/// A point on equally spaced knots, 2⁻⁷⁵ of the domain or more from its left end: a 128-bit fraction of the domain,
/// exact at every depth.
pub(crate) struct Fraction {
    high: u64,
    low: u64,
}

impl Fraction {
    /// The least `t` whose 53 bits all lie within the fraction, 2⁻⁷⁵.
    pub(crate) const LEAST: f64 = f64::EPSILON / 8_388_608.0;

    /// `t` in `[0, 1)`, exact from [`Fraction::LEAST`] on; one and beyond become the largest fraction.
    pub(crate) fn new(t: f64) -> Self {
        const SCALE: f64 = 18_446_744_073_709_551_616.0;
        let scaled = t * SCALE;
        // The casts saturate; the difference is exact because `high` holds the leading bits of `scaled`.
        let high = scaled as u64;
        let rest = scaled - high as f64;
        if scaled >= SCALE {
            return Self { high: u64::MAX, low: u64::MAX };
        }
        Self { high, low: (rest.max(0.0) * SCALE) as u64 }
    }

    /// `t` in `(0, 1)`, cut to 128 bits.
    pub(crate) fn between(t: Double) -> Self {
        const SCALE: f64 = 18_446_744_073_709_551_616.0;
        let Self { high, low } = Self::new(t.hi);
        let rest = (t.lo * SCALE * SCALE) as i128;
        let all = (u128::from(high) << 64 | u128::from(low)).saturating_add_signed(rest);
        Self { high: (all >> 64) as u64, low: all as u64 }
    }
}

impl Orbit for Fraction {
    #[inline]
    fn step<const C: usize>(&mut self, pieces: &[Piece<C>]) -> Step {
        const ULP: f64 = 1.0 / 18_446_744_073_709_551_616.0;
        let maps = pieces.len() as u128;
        let low = u128::from(self.low) * maps;
        let high = u128::from(self.high) * maps + (low >> 64);
        self.low = low as u64;
        self.high = high as u64;
        Step {
            index: (high >> 64) as usize,
            s: self.high as f64 * ULP,
            at_knot: self.high == 0 && self.low == 0,
        }
    }
}

/// A point on equally spaced knots, however near the left end: a fraction of the domain with every bit that an `f64`
/// under one can have, the least significant word first.
#[derive(Clone, Copy)]
pub(crate) struct LongFraction {
    words: [u64; Self::WORDS],
}

impl LongFraction {
    /// 1088 bits; the last bit of the least `f64` is 2⁻¹⁰⁷⁴.
    const WORDS: usize = 17;

    /// `t` in `[0, 1)`, exact; one and beyond become the largest fraction.
    pub(crate) fn new(t: f64) -> Self {
        const MANTISSA: u32 = 52;
        if t >= 1.0 {
            return Self { words: [u64::MAX; Self::WORDS] };
        }
        let bits = t.to_bits();
        let exponent = (bits >> MANTISSA) as usize & 0x7FF;
        let fraction = bits & ((1 << MANTISSA) - 1);
        let mantissa = if exponent == 0 { fraction } else { fraction | 1 << MANTISSA };
        // The last bit of the mantissa weighs 2^(exponent − 1075); that of the words 2⁻¹⁰⁸⁸.
        let shift = exponent.max(1) + 13;
        let mut rest = u128::from(mantissa) << (shift % 64);
        let mut words = [0; Self::WORDS];
        for word in words.iter_mut().skip(shift / 64) {
            *word = rest as u64;
            rest >>= 64;
        }
        Self { words }
    }
}

impl Orbit for LongFraction {
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
        let [.., high] = self.words;
        Step { index: carry as usize, s: high as f64 * ULP, at_knot: any == 0 }
    }
}

/// A point on any knots; the float orbit is that of a point within a few units in the last place.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_exact() {
        let f = Fraction::new(0.75);
        assert_eq!((f.high, f.low), (3 << 62, 0));
        let f = Fraction::new(f64::EPSILON * f64::EPSILON);
        assert_eq!((f.high, f.low), (0, 1 << 24));
        // 53 bits below one: everything sits in the high word.
        let f = Fraction::new(1.0 - f64::EPSILON / 2.0);
        assert_eq!((f.high, f.low), (u64::MAX << 11, 0));
        let f = Fraction::new(1e-5);
        let back = f.high as f64 / 2f64.powi(64) + f.low as f64 / 2f64.powi(128);
        assert_eq!(back, 1e-5);
        assert_eq!(Fraction::new(1.0).high, u64::MAX);
        assert_eq!(Fraction::new(f64::NAN).high, 0);
        let least = Fraction::new(Fraction::LEAST * (1.0 + f64::EPSILON));
        assert_eq!((least.high, least.low), (0, (1 << 53) + 2));
    }

    #[test]
    fn long_fractions_are_exact() {
        let words = |t: f64| LongFraction::new(t).words;
        assert_eq!((words(1.0), words(0.0), words(f64::NAN)), ([u64::MAX; 17], [0; 17], [0; 17]));
        assert_eq!(words(0.75), core::array::from_fn(|k| if k == 16 { 3 << 62 } else { 0 }));
        // 2⁻¹⁰⁷⁴ of 2⁻¹⁰⁸⁸, and the least normal number with every bit of its mantissa.
        assert_eq!(words(f64::from_bits(1)), core::array::from_fn(|k| if k == 0 { 1 << 14 } else { 0 }));
        let normal = f64::MIN_POSITIVE * (2.0 - f64::EPSILON);
        let want = [((1_u64 << 53) - 1) << 14, (1 << 3) - 1];
        assert_eq!(words(normal), core::array::from_fn(|k| if k < 2 { want[k] } else { 0 }));
    }
}
