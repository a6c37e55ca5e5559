//! The orbit of a point under the inverse maps: its address, one index per step.

use crate::map::Piece;

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

/// A point on equally spaced knots: a 128-bit fraction of the domain, exact at every depth.
pub(crate) struct Fraction {
    high: u64,
    low: u64,
}

impl Fraction {
    /// `t` in `[0, 1)`, exact above 2⁻⁷⁵; one and beyond become the largest fraction.
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

/// A point on any knots; the float orbit is that of a point within a few units in the last place.
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
    }
}
