//! Values on equally spaced knots by a table of composites: few steps, a fixed number of them.

use crate::evaluate::batch_error::BatchError;
use crate::numeric::interval::Bounded;
use crate::numeric::polynomial::UNIT;
use crate::system::chord::Chord;
use crate::system::fif::Fif;
use crate::system::map::Piece;
use crate::table::composite::{Composite, Composites, TableError, TableStorage};
use crate::table::truncation::Series;

/// The least distance from the left end, in units of the domain, whose 53 bits all lie within 64: 2⁻¹¹.
pub(crate) const LEAST: f64 = 1.0 / 2048.0;

/// A function on equally spaced knots with a table, for values at any points in a few nanoseconds.
///
/// ```text
/// f(t) = chord(t) + Σ_{k < K} W_k P_{e_{k+1}}(u_{k+1}) + W_K τ        W_k = A_{e_1} … A_{e_k}
/// ```
///
/// `e_1, e_2, …` are the digits of `t`, the place in the domain, to the radix `N^r`; `u_k` is what is left after `k` of them;
/// `A_e` and `P_e` make the composite of `r` maps in row `e` of the table, and `τ` is the middle of `f − chord`, or 0
/// where nothing is left. `K` is fixed by the tolerance when the table is made. A row is as good at any depth, because
/// the digits are exact: a 64-bit fraction of the domain holds every bit of `t ≥ 2⁻¹¹`.
///
/// `S` holds the system (see [`Fif`]; [`Fif::view`] borrows one), `T` the table:
/// [`FixedFast`] in an array of `M = N^r` rows, [`FastBuf`] (feature `alloc`) in a vector whose size is chosen: the most
/// composites under 1025 in 32 KB, 8 µs to 1 ms to make.
///
/// Cochran, Lewis, Hart 2000, eq. 26–28, composed in advance, where Algorithm 2 composes for every point.
///
/// ```
/// use asperity_fif::{Composite, FixedFast, paper};
/// let f = FixedFast::<2, 256, 2>::new(paper::f()?, 1e-12)?;
/// let top = f.value(2.0 / 3.0);
/// assert!((top - 4.0 / 3.0).abs() <= f.bound() + 1e-15 && f.bound() <= 1e-12);
/// assert_eq!(f.value(1.0), 1.0); // a knot
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Fast<S, T, const C: usize> {
    table: T,
    radix: u64,
    /// Steps after the first.
    more: u32,
    /// What is left after the first digit, or lacks to the next one, at the knots and around them.
    near: u64,
    origin: f64,
    per_width: f64,
    chord: Chord,
    middle: f64,
    /// Bounds away from knots, and anywhere.
    away: f64,
    bound: f64,
    system: Fif<S, C>,
}

/// A system of `N` maps in an array with its table of `M = N^r` composites in another; needs no allocator.
pub type FixedFast<const N: usize, const M: usize, const C: usize> =
    Fast<[Piece<C>; N], [Composite<C>; M], C>;

/// A system with its table in a vector.
#[cfg(feature = "alloc")]
pub type FastBuf<S, const C: usize> = Fast<S, alloc::vec::Vec<Composite<C>>, C>;

impl<S: AsRef<[Piece<C>]>, T: TableStorage<C>, const C: usize> Fast<S, T, C> {
    /// The table of `system` for values to `tolerance`.
    ///
    /// The least number of steps whose bound is at most `tolerance`, else the least within 5/4 of the least bound: a tolerance that is
    /// zero, negative, NaN or under the rounding error stands for the rounding error, so [`Fast::bound`] never grows with
    /// a smaller tolerance. When the number of maps is a power of two, 64 bits are used up after `⌈64/log₂ M⌉` steps,
    /// however near to one the factors are.
    ///
    /// # Errors
    /// [`TableError::Nonuniform`] when the knots are not equally spaced; [`TableError::Storage`] when an array's length is
    /// no power of the number of maps; [`TableError::Depth`] when 64 steps leave more than `tolerance` for
    /// truncation: near-critical factors. [`Fif::evaluate`] remains for all of them.
    pub fn new(system: Fif<S, C>, tolerance: f64) -> Result<Self, TableError> {
        let mut made = Composites::<T, C>::new(&system)?;
        let (chord, degree) = (system.chord(), C as f64);
        let series = Series {
            ratio: made.steepest,
            largest: made.largest,
            // Horner's rule, the scaled powers, and the 11 bits of u that the sum does not see.
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
        for row in made.table.as_mut() {
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
        let elsewhere = system.least_bound();
        Ok(Self {
            table: made.table,
            radix: made.radix as u64,
            more: depth.steps - 1,
            near: (near * 18_446_744_073_709_551_616.0) as u64,
            origin: domain.lo,
            per_width,
            chord,
            middle: made.deviation.middle(),
            away: depth.bound,
            bound: if depth.bound > elsewhere { depth.bound } else { elsewhere },
            system,
        })
    }

    /// `f(x)`, within [`Fast::bound`].
    ///
    /// - **Domain:** points outside the domain are clamped to it; NaN gives NaN. Knots are exact.
    /// - **Accuracy:** as [`Fif::evaluate`] on equally spaced knots: the bound holds for `f(x)` itself when `x − x_0` and its
    ///   product with `1/(x_N − x_0)` are exact, else for an `f(x′)` with `x′` within eight units in the last place.
    ///
    /// Next to knots of the table's first digit and within 2⁻¹¹ of the domain from its left end this is
    /// [`Fif::evaluate`], ten to thirty times slower.
    #[inline]
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        match self.sum(x) {
            Some(value) => value,
            None => self.elsewhere(x).value,
        }
    }

    /// `f(x)` with the bound of its error: 0 at knots, NaN for NaN, else at most [`Fast::bound`].
    #[inline]
    #[must_use]
    pub fn evaluate(&self, x: f64) -> Bounded {
        match self.sum(x) {
            Some(value) => Bounded { value, bound: self.away },
            None => self.elsewhere(x),
        }
    }

    /// Values at many points, in any order; each equals [`Fast::value`].
    ///
    /// # Errors
    /// [`BatchError::LengthMismatch`]; nothing is written then.
    #[inline]
    pub fn values(&self, x: &[f64], out: &mut [f64]) -> Result<(), BatchError> {
        BatchError::check(x.len(), out.len())?;
        for (x, out) in x.iter().zip(out) {
            *out = self.value(*x);
        }
        Ok(())
    }

    /// Bound of the error of every value: truncation and rounding, the table's included.
    #[inline]
    #[must_use]
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// Composites that a value takes.
    #[inline]
    #[must_use]
    pub fn steps(&self) -> u32 {
        self.more + 1
    }

    /// The system that the table was made of.
    #[inline]
    #[must_use]
    pub fn system(&self) -> &Fif<S, C> {
        &self.system
    }

    /// The sum over the digits; `None` near knots, outside, for NaN and where 64 bits do not hold the place.
    #[inline(always)]
    fn sum(&self, x: f64) -> Option<f64> {
        let t = (x - self.origin) * self.per_width;
        if !(LEAST..1.0).contains(&t) {
            return None;
        }
        let mut rest = fraction(t);
        let table = self.table.as_ref();
        let row = table.get(digit(&mut rest, self.radix))?;
        if rest.wrapping_add(self.near) <= self.near.saturating_mul(2) {
            return None;
        }
        let mut sum = self.chord.at(t) + polynomial(&row.c, rest);
        let mut weight = row.a;
        for _ in 0..self.more {
            let Some(row) = table.get(digit(&mut rest, self.radix)) else { break };
            sum += weight * polynomial(&row.c, rest);
            weight *= row.a;
        }
        Some(sum + if rest == 0 { 0.0 } else { weight * self.middle })
    }

    /// Out of line: knots, and hardly any other point.
    #[cold]
    fn elsewhere(&self, x: f64) -> Bounded {
        self.system.evaluate(x, 0.0)
    }
}

/// The 64-bit fraction of `t` in `[2⁻¹¹, 1)`: its 53 bits, shifted into place.
#[inline(always)]
pub(crate) fn fraction(t: f64) -> u64 {
    let bits = t.to_bits();
    ((bits << 11) | 1 << 63) >> (1022_u64.wrapping_sub(bits >> 52) & 63)
}

/// The next digit of a fraction, which is left with the others.
#[inline(always)]
pub(crate) fn digit(rest: &mut u64, radix: u64) -> usize {
    let wide = u128::from(*rest) * u128::from(radix);
    *rest = wide as u64;
    (wide >> 64) as usize
}

/// A row's polynomial at a fraction, in units of 2⁻⁵³. Starts from the last coefficient: a product with zero would be kept.
#[inline(always)]
pub(crate) fn polynomial<const C: usize>(c: &[f64; C], rest: u64) -> f64 {
    // Signed, which one instruction converts.
    let s = (rest >> 11) as i64 as f64;
    let Some((&last, others)) = c.split_last() else { return 0.0 };
    others.iter().rev().fold(last, |p, &c| p * s + c)
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use crate::{FifBuf, FixedFif, paper};
    use alloc::string::ToString;

    #[test]
    fn points_outside_are_clamped_and_nan_is_nan() {
        let f = FastBuf::new(paper::f_hat().unwrap(), 1e-12).unwrap();
        for x in [-1.0, f64::NEG_INFINITY, -0.0, 0.0] {
            assert_eq!(f.evaluate(x), Bounded { value: 0.0, bound: 0.0 }, "{x}");
        }
        for x in [2.0, 3.0, f64::INFINITY] {
            assert_eq!(f.evaluate(x), Bounded { value: 2.0, bound: 0.0 }, "{x}");
        }
        assert!(f.value(f64::NAN).is_nan() && f.evaluate(f64::NAN).bound.is_nan());
    }

    #[test]
    fn knots_are_exact_where_no_double_is() {
        let thirds = [10.0, 10.0 + 1.0 / 3.0, 10.0 + 2.0 / 3.0, 11.0];
        let y = [0.1, 1.0, -1.0, 0.5];
        let f =
            FastBuf::new(FixedFif::<3, 2>::affine(&thirds, &y, &[0.7, -0.8, 0.5]).unwrap(), 1e-9).unwrap();
        for (x, y) in thirds.into_iter().zip(y) {
            assert_eq!(f.evaluate(x), Bounded { value: y, bound: 0.0 }, "{x}");
        }
    }

    #[test]
    fn powers_of_two_end_however_steep() {
        let x = [0.0, 0.5, 1.0];
        let f = FifBuf::affine(&x, &[0.0, 1.0, 0.0], &[0.999, -0.999]).unwrap();
        let fast = FastBuf::new(f.view(), 1e-9).unwrap();
        assert_eq!(fast.steps(), 7);
        assert!(fast.away < 1e-9, "{:e}", fast.away);
        for k in 1..50 {
            let x = f64::from(k) * 0.019_803;
            let (got, want) = (fast.evaluate(x), f.evaluate(x, 0.0));
            assert!((got.value - want.value).abs() <= got.bound + want.bound, "{x}: {got:?} {want:?}");
        }
    }

    #[test]
    fn near_critical_factors_are_refused() {
        let x = [0.0, 1.0, 2.0, 3.0];
        let f = FifBuf::affine(&x, &[0.0, 1.0, -1.0, 0.0], &[0.999, -0.999, 0.99]).unwrap();
        for tolerance in [1e-6, 0.0, f64::NAN] {
            let error = FastBuf::new(f.view(), tolerance).unwrap_err();
            assert!(matches!(error, TableError::Depth { alpha: 0.999, most: 64, .. }), "{error:?}");
            assert!(
                error.to_string().starts_with("with a vertical factor of size 0.999 64 composites leave")
            );
        }
        assert!(FastBuf::new(f.view(), 1e6).is_ok());
    }

    #[test]
    fn fractions_hold_every_bit() {
        assert_eq!((fraction(0.5), fraction(0.75)), (1 << 63, 3 << 62));
        assert_eq!(fraction(1.0 - f64::EPSILON / 2.0), u64::MAX << 11);
        assert_eq!(fraction(LEAST * (1.0 + f64::EPSILON)), (1 << 53) + 2);
    }

    #[test]
    fn batches_want_one_length() {
        let f = FastBuf::new(paper::f().unwrap(), 1e-6).unwrap();
        let mut out = [9.0; 2];
        assert_eq!(f.values(&[0.5; 3], &mut out), Err(BatchError::LengthMismatch { expected: 3, found: 2 }));
        assert_eq!(out, [9.0; 2]);
        f.values(&[1.0, 0.3], &mut out).unwrap();
        assert_eq!(out, [1.0, f.value(0.3)]);
    }
}
