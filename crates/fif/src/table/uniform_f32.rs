//! Values in `f32`: half the table, twice the speed, and SIMD.

use alloc::vec::Vec;
use asperity_core::BatchError;

use crate::system::fif::FifRef;
use crate::table::composite::{Composite, Composites, Series};
use crate::table::table::Table;
use crate::table::uniform::digit;

/// The smallest position in the domain whose 24 bits all lie within 64: 2⁻⁴⁰.
const LEAST: f32 = 1.0 / 1_099_511_627_776.0;

/// The unit of rounding, 2⁻²⁴, and the unit of the powers of a row.
const UNIT: f64 = 1.0 / 16_777_216.0;

/// A function with a table in `f32`, from [`Table::to_f32`], for single values and SIMD batches.
///
/// On equally spaced knots, with up to three coefficients and values below 8·10³⁴, the table has 16
/// bytes per row and at most 1024 rows. It is computed in `f64` and rounded once, and its digits
/// are exact. Other systems round the values of their [`Table`], to infinity beyond `f32`.
///
/// ```
/// use asperity_fif::cochran_2000;
/// let f = cochran_2000::f()?.table(1e-6)?.to_f32();
/// assert!((f.value(0.625) - 1.25).abs() <= f.bound() && f.bound() < 2e-6);
/// let mut values = [0.0; 5];
/// f.values(&[0.1, 0.3, 0.5, 0.7, 1.9], &mut values)?;
/// assert_eq!(values[3], f.value(0.7)); // equal bits
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Table32<const C: usize> {
    pub(crate) rows: Option<Rows32>,
    bound: f32,
    table: Table<C>,
}

/// Rows of composites in `f32`.
#[derive(Clone, Debug)]
pub(crate) struct Rows32 {
    /// `a, c_0, c_1, c_2`, powers in units of 2⁻²⁴.
    pub(crate) table: Vec<[f32; 4]>,
    /// Number of rows.
    pub(crate) radix: u64,
    /// Number of composites per value.
    pub(crate) steps: u32,
    /// Left end of the domain.
    pub(crate) origin: f32,
    /// Reciprocal of the width of the domain.
    pub(crate) per_width: f32,
    /// Start and rise of the chord.
    pub(crate) chord: [f32; 2],
    /// Middle of the range of deviations from the chord.
    pub(crate) middle: f32,
}

impl<const C: usize> Table<C> {
    /// Values in `f32`, truncated at the tolerance of the table or half the rounding error of
    /// `f32`.
    ///
    /// The larger of the two applies.
    ///
    /// The rounding of `f32` is added, see [`Table32::bound`]: a few units of 6·10⁻⁸ of the largest
    /// value.
    #[must_use]
    pub fn to_f32(&self) -> Table32<C> {
        let rounding = UNIT * self.system().range().magnitude();
        let made = rows(self.system().view(), f64::from(self.tolerance() as f32));
        let (error, elsewhere) = match &made {
            Some((_, bound)) => (*bound, self.system().least_bound() + rounding),
            None => (self.bound(), self.bound() + rounding),
        };
        let bound = (if error > elsewhere { error } else { elsewhere } as f32).next_up();
        Table32 { rows: made.map(|(rows, _)| rows), bound, table: self.clone() }
    }
}

/// Rows and their error bound away from knots.
///
/// `None` on unequal knots, for more than three coefficients, for scalings too close to one and for
/// values near the largest `f32`.
fn rows<const C: usize>(system: FifRef<'_, C>, tolerance: f64) -> Option<(Rows32, f64)> {
    let made = if C > 3 { None } else { Composites::new(system) }?;
    let chord = system.chord();
    let series = Series {
        ratio: made.steepest * (1.0 + UNIT),
        largest: made.largest,
        // One for the coefficients, three for a product, a sum and the unused bits of u, per power.
        row: made.error + (3.0 * C as f64 + 1.0) * UNIT * made.largest,
        roundings: 2.0,
        tail: made.deviation,
        scale: 1.25 * (chord.start.abs() + chord.rise.abs()),
        end: made.end(),
        lost: (1..C).fold(f64::from(f32::MIN_POSITIVE), |lost, _| lost / UNIT),
        unit: UNIT,
    };
    // Sums of thousands of the largest stay in the range of f32.
    let largest = series.scale + made.largest + made.deviation.magnitude();
    if largest >= f64::from(f32::MAX) / 4096.0 {
        return None;
    }
    let depth = series.depth_of_truncation(tolerance).ok()?;
    let row = |row: &Composite<C>| {
        let mut out = [row.a as f32, 0.0, 0.0, 0.0];
        let mut unit = 1.0;
        for (to, c) in out.iter_mut().skip(1).zip(row.c) {
            *to = (c * unit) as f32;
            unit *= UNIT;
        }
        out
    };
    let domain = system.domain();
    let rows = Rows32 {
        table: made.table.iter().map(row).collect(),
        radix: made.radix as u64,
        steps: depth.steps,
        origin: domain.lo as f32,
        per_width: (1.0 / domain.width()) as f32,
        chord: [chord.start as f32, chord.rise as f32],
        middle: made.deviation.middle() as f32,
    };
    Some((rows, depth.bound))
}

impl<const C: usize> Table32<C> {
    /// `f(x)`, within [`Table32::bound`].
    ///
    /// - **Domain:** points outside the domain are clamped to it; NaN returns NaN.
    /// - **Accuracy:** the bound holds for `f(x)` itself if `x − x_0` and its product with `1/(x_N
    ///   − x_0)` are exact in `f32`, otherwise for an `f(x′)` with `x′` within four units in the
    ///   last place of `x` and of the ends of the domain. Knots are within the bound, not exact.
    #[inline]
    #[must_use]
    pub fn value(&self, x: f32) -> f32 {
        match self.rows.as_ref().and_then(|rows| rows.sum::<C>(x)) {
            Some(value) => value,
            None => self.elsewhere(x),
        }
    }

    /// Values at many points, in any order, bit-identical to [`Table32::value`].
    ///
    /// Uses SIMD if the number of maps is a power of two (feature `simd`), otherwise evaluates one
    /// by one.
    ///
    /// # Errors
    /// [`BatchError`] if the lengths of `y` and `x` differ. Nothing is written in this case.
    pub fn values(&self, x: &[f32], y: &mut [f32]) -> Result<(), BatchError> {
        BatchError::check("y", x.len(), y.len())?;
        #[cfg(feature = "simd")]
        self.in_lanes(x, y);
        #[cfg(not(feature = "simd"))]
        self.one_by_one(x, y);
        Ok(())
    }

    /// Error bound of every value: truncation and rounding, including those of the table.
    #[must_use]
    pub fn bound(&self) -> f32 {
        self.bound
    }

    /// The table in `f64` from which it was built.
    #[must_use]
    pub fn table(&self) -> &Table<C> {
        &self.table
    }

    #[inline(always)]
    pub(crate) fn one_by_one(&self, x: &[f32], y: &mut [f32]) {
        for (x, y) in x.iter().zip(y) {
            *y = self.value(*x);
        }
    }

    /// Out of line: every point without rows, hardly any with rows.
    #[cold]
    fn elsewhere(&self, x: f32) -> f32 {
        let x = f64::from(x);
        (if self.rows.is_some() { self.table.system().evaluate(x, 0.0).value } else { self.table.value(x) })
            as f32
    }
}

impl Rows32 {
    #[inline(always)]
    fn sum<const C: usize>(&self, x: f32) -> Option<f32> {
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
                // The following terms are zeros.
                return Some(sum);
            }
            weight *= row[0];
        }
        Some(sum + weight * self.middle)
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
    use crate::{Fif, System, cochran_2000, system::map::Piece};

    #[test]
    fn values_near_the_largest_float_are_not_nan() {
        for largest in [1e34, 3e38, 1e39, 1e300] {
            let y = [largest, 0.0, -largest];
            let f = Fif::<2>::affine(&[0.0, 0.5, 1.0], &y, &[0.5, -0.5]).unwrap();
            let table = f.table(1e-3 * largest).unwrap().to_f32();
            for x in [0.0, 0.1, 0.25, 0.5, 0.886, 1.0] {
                let (got, want) = (table.value(x), f.evaluate(f64::from(x), 0.0).value);
                let error = (f64::from(got) - want).abs();
                let within = error <= f64::from(table.bound());
                assert!(!got.is_nan() && (within || got == want as f32), "{largest} at {x}: {got}, {want}");
            }
        }
    }

    fn check<S: AsRef<[Piece<C>]>, const C: usize>(f: &System<S, C>, tolerance: f64) {
        let table = f.table(tolerance).unwrap().to_f32();
        assert!(f64::from(table.bound()) <= tolerance.max(0.0) + 1e-5, "{}", table.bound());
        let (domain, n) = (f.domain(), 5003);
        let spread = (0..n).map(|k| domain.lo + domain.width() * (f64::from(k) + 0.618) / f64::from(n));
        let ends = [-1.0, 0.0, 1.0, 2.0, 3.0, 1e-3, 1e-9, 1e-30, 1.999_999_9, f64::INFINITY];
        let x: Vec<f32> = spread.chain(ends).map(|x| x as f32).collect();
        let mut values = alloc::vec![0.0; x.len()];
        table.values(&x, &mut values).unwrap();
        for (&x, &in_batch) in x.iter().zip(&values) {
            let got = table.value(x);
            assert_eq!(got.to_bits(), in_batch.to_bits(), "{x}: {got} {in_batch}");
            let want = f.evaluate(f64::from(x), 0.0);
            let error = (f64::from(got) - want.value).abs();
            assert!(error <= f64::from(table.bound()) + want.bound, "{x}: {got} {want:?}, {}", table.bound());
        }
        assert!(table.value(f32::NAN).is_nan());
        let mut y = [0.0; 90];
        table.values(&[f32::NAN; 90], &mut y).unwrap();
        assert!(y.iter().all(|y| y.is_nan()));
    }

    #[test]
    fn values_are_within_the_bound_and_bit_identical_in_lanes() {
        for tolerance in [1e-2, 1e-6, 0.0, f64::NAN] {
            check(&cochran_2000::f().unwrap(), tolerance);
            check(&cochran_2000::g().unwrap(), tolerance);
            check(&cochran_2000::f_hat().unwrap(), tolerance);
            check(&cochran_2000::g_hat().unwrap(), tolerance);
        }
        // Quarters: another number of bits; one coefficient; cubics and six maps, whose powers have
        // trailing zeros too.
        let x = [0.0, 0.5, 1.0, 1.5, 2.0];
        check(&Fif::affine(&x, &[0.0, 1.0, -0.5, 0.3, 0.9], &[0.5, -0.7, 0.4, 0.9]).unwrap(), 1e-6);
        check(&Fif::<1>::new(&[0.0, 1.0, 2.0], &[0.5, 0.5], &[[0.0], [0.5]]).unwrap(), 1e-6);
        check(&Fif::hermite(&[0.0, 1.0, 2.0], &[0.0; 3], &[0.0, 1.0, 0.5], &[0.1; 2]).unwrap(), 1e-6);
        let x: [f64; 7] = core::array::from_fn(|j| j as f64 / 3.0);
        let (y, alpha) = ([0.0, 1.0, -1.0, 0.5, 0.25, 1.5, 0.0], [0.3, -0.4, 0.2, 0.5, -0.1, 0.6]);
        check(&Fif::affine(&x, &y, &alpha).unwrap(), 1e-6);
    }

    #[test]
    fn values_of_any_length_are_bit_identical_to_value() {
        let table = cochran_2000::g().unwrap().table(1e-6).unwrap().to_f32();
        let x: Vec<f32> = (0_u16..300).map(|k| 0.01 + 0.006_61 * f32::from(k)).collect();
        for n in [0, 1, 16, 17, 63, 64, 65, 127, 128, 144, 145, 192, 209, 300] {
            let mut y = alloc::vec![f32::NAN; n];
            table.values(&x[..n], &mut y).unwrap();
            assert!(x.iter().zip(&y).all(|(x, y)| y.to_bits() == table.value(*x).to_bits()), "{n}");
        }
    }
}
