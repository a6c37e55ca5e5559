//! Values in `f32` on equally spaced knots, one by one and in the lanes of a SIMD register.

use alloc::vec::Vec;

use crate::evaluate::batch_error::BatchError;
use crate::system::fif::Fif;
use crate::system::map::Piece;
use crate::table::composite::{Composite, Composites, TableError};
use crate::table::truncation::Series;
use crate::table::uniform::digit;

/// The least place in the domain whose 24 bits all lie within 64: 2⁻⁴⁰.
const LEAST: f32 = 1.0 / 1_099_511_627_776.0;

/// The unit of rounding, 2⁻²⁴, and that of a row's powers.
const UNIT: f64 = 1.0 / 16_777_216.0;

/// [`Fast`](crate::Fast) in `f32`, of systems with three coefficients at most: half the table, twice the speed, and lanes.
///
/// The table holds 16 bytes a row, 1024 rows at most, made in `f64` and rounded once; digits are exact as there.
///
/// ```
/// use asperity_fif::{Fast32, paper};
/// let f = Fast32::new(paper::f()?, 1e-6)?;
/// assert!((f.value(0.625) - 1.25).abs() <= f.bound() && f.bound() < 2e-6);
/// let mut values = [0.0; 5];
/// f.values(&[0.1, 0.3, 0.5, 0.7, 1.9], &mut values)?;
/// assert_eq!(values[3], f.value(0.7)); // the same bits
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Fast32<S, const C: usize> {
    /// `a, c_0, c_1, c_2`.
    pub(crate) table: Vec<[f32; 4]>,
    pub(crate) radix: u64,
    pub(crate) steps: u32,
    pub(crate) origin: f32,
    pub(crate) per_width: f32,
    /// Start and rise of the chord.
    pub(crate) chord: [f32; 2],
    pub(crate) middle: f32,
    bound: f32,
    system: Fif<S, C>,
}

impl<S: AsRef<[Piece<C>]>, const C: usize> Fast32<S, C> {
    /// The table of `system` for values cut off at `tolerance`, which stands for half the rounding error when it is less or
    /// NaN. The rounding of `f32` comes on top, see [`Fast32::bound`]: a few units of 6·10⁻⁸ of the largest value.
    ///
    /// # Errors
    /// [`TableError::Nonuniform`]; [`TableError::Coefficients`] when `C > 3`; [`TableError::Depth`] when 64 steps leave
    /// more than `tolerance`.
    pub fn new(system: Fif<S, C>, tolerance: f32) -> Result<Self, TableError> {
        if C > 3 {
            return Err(TableError::Coefficients { found: C });
        }
        let made = Composites::<Vec<Composite<C>>, C>::new(&system)?;
        let chord = system.chord();
        let series = Series {
            ratio: made.steepest * (1.0 + UNIT),
            largest: made.largest,
            // One for the coefficients, three for a product, a sum and the bits of u that are not seen, per power.
            row: made.error + (3.0 * C as f64 + 1.0) * UNIT * made.largest,
            roundings: 2.0,
            tail: made.deviation,
            scale: 1.25 * (chord.start.abs() + chord.rise.abs()),
            end: made.end(),
            lost: (1..C).fold(f64::from(f32::MIN_POSITIVE), |lost, _| lost / UNIT),
            unit: UNIT,
        };
        let depth =
            series.depth_of_truncation(f64::from(tolerance)).map_err(|bound| system.too_deep(bound))?;
        let row = |row: &Composite<C>| {
            let mut out = [row.a as f32, 0.0, 0.0, 0.0];
            let mut unit = 1.0;
            for (to, c) in out.iter_mut().skip(1).zip(row.c) {
                *to = (c * unit) as f32;
                unit *= UNIT;
            }
            out
        };
        let elsewhere = system.least_bound() + UNIT * system.range().magnitude();
        let domain = system.domain();
        Ok(Self {
            table: made.table.iter().map(row).collect(),
            radix: made.radix as u64,
            steps: depth.steps,
            origin: domain.lo as f32,
            per_width: (1.0 / domain.width()) as f32,
            chord: [chord.start as f32, chord.rise as f32],
            middle: made.deviation.middle() as f32,
            bound: (if depth.bound > elsewhere { depth.bound } else { elsewhere } as f32).next_up(),
            system,
        })
    }

    /// `f(x)`, within [`Fast32::bound`].
    ///
    /// - **Domain:** points outside the domain are clamped to it; NaN gives NaN.
    /// - **Accuracy:** the bound holds for `f(x)` itself when `x − x_0` and its product with `1/(x_N − x_0)` are exact in
    ///   `f32`, else for an `f(x′)` with `x′` within four units in the last place of `x` and of the ends of the domain.
    ///   Knots are within the bound, not exact.
    #[inline]
    #[must_use]
    pub fn value(&self, x: f32) -> f32 {
        match self.sum(x) {
            Some(value) => value,
            None => self.elsewhere(x),
        }
    }

    /// Values at many points, in any order: in lanes of the machine's SIMD level where the number of maps is a power of two
    /// (feature `simd`), one by one otherwise. Each has the bits of [`Fast32::value`].
    ///
    /// # Errors
    /// [`BatchError::LengthMismatch`]; nothing is written then.
    pub fn values(&self, x: &[f32], out: &mut [f32]) -> Result<(), BatchError> {
        BatchError::check(x.len(), out.len())?;
        #[cfg(feature = "simd")]
        self.in_lanes(x, out);
        #[cfg(not(feature = "simd"))]
        self.one_by_one(x, out);
        Ok(())
    }

    /// Bound of the error of every value: truncation and rounding, the table's included.
    #[inline]
    #[must_use]
    pub fn bound(&self) -> f32 {
        self.bound
    }

    /// The system that the table was made of.
    #[inline]
    #[must_use]
    pub fn system(&self) -> &Fif<S, C> {
        &self.system
    }

    #[inline(always)]
    pub(crate) fn one_by_one(&self, x: &[f32], out: &mut [f32]) {
        for (x, out) in x.iter().zip(out) {
            *out = self.value(*x);
        }
    }

    #[inline(always)]
    fn sum(&self, x: f32) -> Option<f32> {
        let t = (x - self.origin) * self.per_width;
        if !(LEAST..1.0).contains(&t) {
            return None;
        }
        let bits = t.to_bits();
        let mut rest = ((u64::from(bits) << 40) | 1 << 63) >> (126_u32.wrapping_sub(bits >> 23) & 63);
        let (mut sum, mut weight) = (self.chord[0] + self.chord[1] * t, 1.0_f32);
        for _ in 0..self.steps {
            let Some(row) = self.table.get(digit(&mut rest, self.radix)) else { break };
            // 24 bits, which are a float exactly.
            let s = (rest >> 40) as i32 as f32;
            sum += weight * polynomial::<C>(row, s);
            if rest == 0 {
                // The terms that follow are zeros.
                return Some(sum);
            }
            weight *= row[0];
        }
        Some(sum + weight * self.middle)
    }

    /// Out of line: hardly any point.
    #[cold]
    fn elsewhere(&self, x: f32) -> f32 {
        self.system.evaluate(f64::from(x), 0.0).value as f32
    }
}

#[inline(always)]
fn polynomial<const C: usize>(row: &[f32; 4], s: f32) -> f32 {
    match C {
        0 | 1 => row[1],
        2 => row[2] * s + row[1],
        _ => (row[3] * s + row[2]) * s + row[1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FifBuf, paper};

    fn check<S: AsRef<[Piece<C>]>, const C: usize>(system: Fif<S, C>, tolerance: f32) {
        let fast = Fast32::new(system, tolerance).unwrap();
        assert!(fast.bound() <= tolerance.max(0.0) + 1e-5, "{}", fast.bound());
        let (domain, n) = (fast.system().domain(), 5003);
        let spread = (0..n).map(|k| domain.lo + domain.width() * (f64::from(k) + 0.618) / f64::from(n));
        let ends = [-1.0, 0.0, 1.0, 2.0, 3.0, 1e-3, 1e-9, 1e-30, 1.999_999_9, f64::INFINITY];
        let x: Vec<f32> = spread.chain(ends).map(|x| x as f32).collect();
        let mut values = alloc::vec![0.0; x.len()];
        fast.values(&x, &mut values).unwrap();
        for (&x, &in_batch) in x.iter().zip(&values) {
            let got = fast.value(x);
            assert_eq!(got.to_bits(), in_batch.to_bits(), "{x}: {got} {in_batch}");
            let want = fast.system().evaluate(f64::from(x), 0.0);
            let error = (f64::from(got) - want.value).abs();
            assert!(error <= f64::from(fast.bound()) + want.bound, "{x}: {got} {want:?}, {}", fast.bound());
        }
        assert!(fast.value(f32::NAN).is_nan());
        let mut out = [0.0; 9];
        fast.values(&[f32::NAN; 9], &mut out).unwrap();
        assert!(out.iter().all(|y| y.is_nan()));
    }

    #[test]
    fn values_lie_within_the_bound_and_lanes_have_their_bits() {
        for tolerance in [1e-2, 1e-6, 0.0, f32::NAN] {
            check(paper::f().unwrap(), tolerance);
            check(paper::g().unwrap(), tolerance);
            check(paper::f_hat().unwrap(), tolerance);
            check(paper::g_hat().unwrap(), tolerance);
        }
        // Quarters: another number of bits; one coefficient.
        let x = [0.0, 0.5, 1.0, 1.5, 2.0];
        check(FifBuf::affine(&x, &[0.0, 1.0, -0.5, 0.3, 0.9], &[0.5, -0.7, 0.4, 0.9]).unwrap(), 1e-6);
        check(FifBuf::<1>::new(&[0.0, 1.0, 2.0], &[0.5, 0.5], &[[0.0], [0.5]]).unwrap(), 1e-6);
    }

    #[test]
    fn other_numbers_of_maps_are_served_one_by_one() {
        // Six maps: their powers have trailing zeros too.
        let x = [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0];
        let (y, alpha) = ([0.0, 1.0, -1.0, 0.5, 0.25, 1.5, 0.0], [0.3, -0.4, 0.2, 0.5, -0.1, 0.6]);
        let f = Fast32::new(FifBuf::affine(&x, &y, &alpha).unwrap(), 1e-6).unwrap();
        let x: [f32; 11] = core::array::from_fn(|k| k as f32 * 0.27 + 0.05);
        let mut out = [0.0; 11];
        f.values(&x, &mut out).unwrap();
        assert_eq!(out, x.map(|x| f.value(x)));
        assert_eq!(f.values(&x, &mut [0.0; 3]), Err(BatchError::LengthMismatch { expected: 11, found: 3 }));
    }

    #[test]
    fn cubics_are_refused() {
        let f = FifBuf::hermite(&[0.0, 1.0, 2.0], &[0.0; 3], &[0.0; 3], &[0.1; 2]).unwrap();
        assert_eq!(Fast32::new(f, 1e-6).unwrap_err(), TableError::Coefficients { found: 4 });
    }
}
