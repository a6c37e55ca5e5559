//! Values on equally spaced knots from a table of composites, with a fixed small number of steps.

use alloc::vec::Vec;

use crate::numeric::polynomial::{UNIT, horner};
use crate::system::chord::Chord;
use crate::system::error::FifError;
use crate::system::fif::FifRef;
use crate::table::composite::{Composite, Composites, Series};

/// The smallest distance from the left end, in units of the domain, whose 53 bits lie within 64:
/// 2⁻¹¹.
pub(crate) const LEAST: f64 = 1.0 / 2048.0;

/// Rows of composites, one per digit of a position.
///
/// A row is equally accurate at any depth, because the digits are exact: a 64-bit fraction of the
/// domain contains every bit of `t ≥ 2⁻¹¹`.
#[derive(Clone, Debug)]
pub(crate) struct Uniform<const C: usize> {
    rows: Vec<Composite<C>>,
    radix: u64,
    /// Steps after the first.
    more: u32,
    /// Remainder after the first digit, or distance to the next one, at the knots and around them.
    near: u64,
    origin: f64,
    per_width: f64,
    chord: Chord,
    middle: f64,
    /// Error bound away from knots.
    pub(crate) away: f64,
}

impl<const C: usize> Uniform<C> {
    /// The smallest number of steps whose bound is at most `tolerance`, else within 5/4 of the
    /// smallest bound.
    ///
    /// If the number of maps is a power of two, 64 bits are used up after `⌈64/log₂ M⌉` steps,
    /// however close to one the scalings are.
    pub(crate) fn new(system: FifRef<'_, C>, made: &Composites<C>, tolerance: f64) -> Result<Self, FifError> {
        let (chord, degree) = (system.chord(), C as f64);
        let series = Series {
            ratio: made.steepest,
            largest: made.largest,
            // Horner's rule, the scaled powers, and the 11 bits of u that the sum does not use.
            row: made.error + 3.0 * degree * UNIT * made.largest,
            roundings: f64::from(made.digits) + 2.0,
            tail: made.deviation,
            scale: chord.start.abs() + chord.rise.abs(),
            end: made.end(),
            // Coefficients in units of 2⁻⁵³ᵏ may be subnormal.
            lost: (1..C).fold(f64::MIN_POSITIVE, |lost, _| lost / UNIT),
            unit: UNIT,
        };
        let depth = series.depth(tolerance).map_err(|bound| system.too_deep(bound))?;
        let mut rows = made.table.clone();
        for row in &mut rows {
            let mut unit = 1.0;
            for c in &mut row.c {
                // The unit of u is 2⁻⁵³; a power of two is exact.
                *c *= unit;
                unit *= UNIT;
            }
        }
        let domain = system.domain();
        let per_width = 1.0 / domain.width();
        // The cast saturates: far from zero every point is near a knot, in units of its last place.
        let near = 8.0 * f64::EPSILON * domain.magnitude() * per_width * made.radix as f64;
        Ok(Self {
            rows,
            radix: made.radix as u64,
            more: depth.steps - 1,
            near: (near * 18_446_744_073_709_551_616.0) as u64,
            origin: domain.lo,
            per_width,
            chord,
            middle: made.deviation.middle(),
            away: depth.bound,
        })
    }

    /// The sum over the digits; `None` near knots, outside, for NaN and if 64 bits are not
    /// sufficient.
    #[inline(always)]
    pub(crate) fn sum(&self, x: f64) -> Option<f64> {
        let t = (x - self.origin) * self.per_width;
        if !(LEAST..1.0).contains(&t) {
            return None;
        }
        let mut rest = fraction(t);
        let rows = self.rows.as_slice();
        let row = rows.get(digit(&mut rest, self.radix))?;
        if rest.wrapping_add(self.near) <= self.near.saturating_mul(2) {
            return None;
        }
        let mut sum = self.chord.at(t) + polynomial(&row.c, rest);
        let mut weight = row.a;
        for _ in 0..self.more {
            let Some(row) = rows.get(digit(&mut rest, self.radix)) else { break };
            sum += weight * polynomial(&row.c, rest);
            weight *= row.a;
        }
        Some(sum + if rest == 0 { 0.0 } else { weight * self.middle })
    }
}

/// The 64-bit fraction of `t` in `[2⁻¹¹, 1)`: its 53 bits, shifted into place.
#[inline(always)]
pub(crate) fn fraction(t: f64) -> u64 {
    let bits = t.to_bits();
    ((bits << 11) | 1 << 63) >> (1022_u64.wrapping_sub(bits >> 52) & 63)
}

/// The next digit of a fraction, which keeps the remaining digits.
#[inline(always)]
pub(crate) fn digit(rest: &mut u64, radix: u64) -> usize {
    let wide = u128::from(*rest) * u128::from(radix);
    *rest = wide as u64;
    (wide >> 64) as usize
}

/// The polynomial of a row at a fraction, in units of 2⁻⁵³.
#[inline(always)]
pub(crate) fn polynomial<const C: usize>(c: &[f64; C], rest: u64) -> f64 {
    // Signed, which one instruction converts.
    horner(c, (rest >> 11) as i64 as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Fif;

    #[test]
    fn depth_is_bounded_for_powers_of_two() {
        let f = Fif::affine(&[0.0, 0.5, 1.0], &[0.0, 1.0, 0.0], &[0.999, -0.999]).unwrap();
        let table = Uniform::new(f.view(), &Composites::new(f.view()).unwrap(), 1e-9).unwrap();
        assert_eq!(table.more, 6);
        assert!(table.away < 1e-9, "{:e}", table.away);
        for k in 1..50 {
            let x = f64::from(k) * 0.019_803;
            let Some(got) = table.sum(x) else { continue };
            let want = f.evaluate(x, 0.0);
            assert!((got - want.value).abs() <= table.away + want.bound, "{x}: {got:?} {want:?}");
        }
    }
}
