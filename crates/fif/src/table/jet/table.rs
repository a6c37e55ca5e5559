//! Value, slope, integral and higher derivatives at one address, by a table of composites.

use alloc::vec::Vec;

use crate::evaluate::batch_error::BatchError;
use crate::numeric::interval::Bounded;
use crate::numeric::polynomial::{UNIT, substitute};
use crate::system::chord::Chord;
use crate::system::fif::Fif;
use crate::system::map::Piece;
use crate::system::storage::FifBuf;
use crate::table::composite::{Composite, Composites, TableError};
use crate::table::jet::jet::Jet;
use crate::table::jet::orders::{Order, Sum, derivatives, largest};
use crate::table::jet::primitive::Primitive;
use crate::table::jet::sums::{Scales, Sums};
use crate::table::truncation::MOST;
use crate::table::uniform::{LEAST, digit, fraction};

/// [`Fast`](crate::Fast) for a smooth function, its derivatives and its integral, which share the digits of a point.
///
/// With `r` composites `v(L_e u) = A_e v(u) + P_e(u)` of `v = f − chord`, over the domain scaled to `[0, 1]`, the digits
/// `e_1, e_2, …` of a place `t` to the radix `r`, what is left after them `u_1, u_2, …`, and `c` the middle of a cell:
///
/// ```text
/// v^(m)(t) = Σ_k W_k r^(mk) P^(m)(u_k)                               W_k = A_{e_1} … A_{e_{k−1}},  P = P_{e_k}
/// ∫_{1/2}^t v = Σ_k W_k r^(1−k) (∫_{1/2}^c v + (1/r) ∫_{1/2}^{u_k} P)
/// ```
///
/// Every sum has its own number of terms, fixed by the tolerance. The slope has the most, the integral gains `r` more with
/// each digit; its last term is linear in `u_k`.
///
/// Not in the sources: eq. 29–36 of Cochran, Lewis, Hart 2000 make systems of derivative and integral, each with
/// addresses of its own.
///
/// ```
/// use asperity_fif::{FastJets, paper};
/// let f_hat = FastJets::new(paper::f_hat()?, 1e-12)?;
/// let (jet, bounds) = (f_hat.jet(1.3), f_hat.bounds());
/// assert!((jet.value - f_hat.system().evaluate(1.3, 1e-14).value).abs() <= bounds.value + 1e-14);
/// assert!((jet.slope - paper::f()?.evaluate(1.3, 1e-14).value).abs() <= bounds.slope + 1e-14);
/// assert!((jet.integral - f_hat.system().integral_over(0.0, 1.3).value).abs() <= bounds.integral + 1e-14);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FastJets<S, const C: usize> {
    /// Polynomials in `u − 1/2`.
    pub(crate) table: Vec<Composite<C>>,
    pub(crate) primitive: Primitive,
    pub(crate) radix: u64,
    pub(crate) scales: Scales<f64, C>,
    /// Terms of the sums for the integral, the value and the slope, none fewer than the one before.
    pub(crate) terms: [u32; 3],
    /// What is left after the first digit, or lacks to the next one, at the knots and around them, in units of 2⁻⁶⁴.
    pub(crate) near: u64,
    pub(crate) origin: f64,
    pub(crate) width: f64,
    pub(crate) per_width: f64,
    pub(crate) chord: Chord,
    /// What stands for the tails of value and slope, where digits are left and where they are zeros.
    pub(crate) tails: [[f64; 2]; 2],
    pub(crate) orders: Vec<Order>,
    away: Jet,
    bounds: Jet,
    pub(crate) system: Fif<S, C>,
    /// The first derivative and the higher ones.
    pub(crate) derivatives: Vec<FifBuf<C>>,
}

impl<S: AsRef<[Piece<C>]>, const C: usize> FastJets<S, C> {
    /// The table of `system` for jets to `tolerance`, which stands for the rounding error of each component where it is
    /// less or NaN, as in [`Fast::new`](crate::Fast::new).
    ///
    /// # Errors
    /// [`TableError::Nonuniform`] when the knots are not equally spaced; [`TableError::Rough`] when `f` has no
    /// [`derivative`](Fif::derivative), and then jets of its [`integral`](Fif::integral) hold `f` and `∫ f`;
    /// [`TableError::Depth`] when 64 steps leave more than `tolerance` of a component.
    pub fn new(system: Fif<S, C>, tolerance: f64) -> Result<Self, TableError> {
        let mut made = Composites::<Vec<Composite<C>>, C>::new(&system)?;
        let derivatives = derivatives(&system);
        let Some(first) = derivatives.first() else { return Err(TableError::Rough) };
        let (chord, domain) = (system.chord(), system.domain());
        let (width, radix) = (domain.width(), made.radix as f64);
        let largest = largest(&made.table);
        let (mut orders, mut scale, mut unit, mut least) = (Vec::new(), 1.0, 1.0, 1);
        let primitive = Primitive::new(&made, &chord);
        let integral = primitive.series.depth(tolerance / width).map_err(|bound| system.too_deep(bound))?;
        least = least.max(integral.steps);
        for m in 0..=derivatives.len() {
            let sum = Sum { made: &made, largest: largest.get(m).copied().unwrap_or(0.0), order: m, scale };
            let Some((series, tail)) = sum.series(&chord) else { break };
            // Higher derivatives are as good as 64 steps make them.
            let steps = match series.depth(tolerance * unit) {
                Ok(depth) => depth.steps,
                Err(_) if m > 1 => series.end.min(MOST),
                Err(bound) => return Err(system.too_deep(bound)),
            };
            least = least.max(steps);
            // The chord, the width's power and the product with it.
            let rounding = 4.0 * (m + 1) as f64 * UNIT * (series.tail.magnitude() + series.scale);
            let bound = 1.001 * (series.bound(least) + rounding) / unit;
            orders.push(Order { terms: least, tail, bound });
            scale *= radix;
            unit *= width;
        }
        let [value, slope, ..] = *orders.as_slice() else { return Err(system.too_deep(f64::INFINITY)) };
        let away = Jet {
            value: value.bound,
            slope: slope.bound,
            integral: 1.001 * width * (integral.bound + 4.0 * UNIT * primitive.series.scale),
        };
        let greater = |a: f64, b: f64| if a > b { a } else { b };
        let bounds = Jet {
            value: greater(away.value, system.least_bound()),
            slope: greater(away.slope, first.least_bound()),
            integral: away.integral,
        };
        for row in &mut made.table {
            row.c = substitute(&row.c, 1.0, 0.5);
        }
        let per_width = 1.0 / width;
        // The cast saturates: far from zero every point is near a knot, in units of its last place.
        let near = 8.0 * f64::EPSILON * domain.magnitude() * per_width * radix;
        Ok(Self {
            table: made.table,
            primitive,
            radix: made.radix as u64,
            scales: Scales::new(radix),
            terms: [integral.steps, value.terms, slope.terms],
            near: (near * 18_446_744_073_709_551_616.0) as u64,
            origin: domain.lo,
            width,
            per_width,
            chord,
            tails: [value.tail, slope.tail],
            orders,
            away,
            bounds,
            system,
            derivatives,
        })
    }

    /// Value, slope and integral at `x`, each within its bound of [`FastJets::bounds`].
    ///
    /// - **Domain:** points outside the domain are clamped to it, slopes there are those of its ends; NaN gives NaN.
    ///   Values at knots are exact.
    /// - **Accuracy:** the bounds hold for `x` itself when `x − x_0` and its product with `1/(x_N − x_0)` are exact, else for
    ///   an `x′` within eight units in the last place; the slope is that of [`Fif::derivative`].
    ///
    /// Next to knots of the table's first digit and within 2⁻¹¹ of the domain from its left end, [`Fif::evaluate`] serves
    /// for value and slope.
    #[inline]
    #[must_use]
    pub fn jet(&self, x: f64) -> Jet {
        match self.sum(x) {
            Some(jet) => jet,
            None => self.elsewhere(x).map(|part| part.value),
        }
    }

    /// The same with the bounds of the errors: NaN for NaN, 0 for values at knots.
    #[must_use]
    pub fn evaluate(&self, x: f64) -> Jet<Bounded> {
        match self.sum(x) {
            Some(jet) => jet.zip(self.away).map(|(value, bound)| Bounded { value, bound }),
            None => self.elsewhere(x),
        }
    }

    /// Jets at many points, in any order: in lanes of the machine's SIMD level where the number of maps is a power of two
    /// (feature `simd`), one by one otherwise. Each has the bits of [`FastJets::jet`].
    ///
    /// ```
    /// use asperity_fif::{FastJets, Jet, paper};
    /// let f_hat = FastJets::new(paper::f_hat()?, 1e-12)?;
    /// let (mut value, mut slope, mut integral) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    /// f_hat.jets(&[0.3, 0.7], Jet { value: &mut value, slope: &mut slope, integral: &mut integral })?;
    /// assert_eq!(slope[1], f_hat.jet(0.7).slope);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`BatchError::LengthMismatch`]; nothing is written then.
    pub fn jets(&self, x: &[f64], out: Jet<&mut [f64]>) -> Result<(), BatchError> {
        for found in [out.value.len(), out.slope.len(), out.integral.len()] {
            BatchError::check(x.len(), found)?;
        }
        #[cfg(feature = "simd")]
        self.in_lanes(x, out);
        #[cfg(not(feature = "simd"))]
        self.one_by_one(x, out);
        Ok(())
    }

    /// Bounds of the errors of every jet: truncation and rounding, the table's included.
    #[inline]
    #[must_use]
    pub fn bounds(&self) -> Jet {
        self.bounds
    }

    /// The system that the table was made of.
    #[inline]
    #[must_use]
    pub fn system(&self) -> &Fif<S, C> {
        &self.system
    }

    #[inline(always)]
    pub(crate) fn one_by_one(&self, x: &[f64], out: Jet<&mut [f64]>) {
        let places = out.value.iter_mut().zip(out.slope).zip(out.integral);
        for (x, ((value, slope), integral)) in x.iter().zip(places) {
            Jet { value: *value, slope: *slope, integral: *integral } = self.jet(*x);
        }
    }

    /// The place in the domain and its fraction; `None` near knots, outside, for NaN and where 64 bits do not hold it.
    #[inline(always)]
    pub(crate) fn place(&self, x: f64) -> Option<(f64, u64)> {
        let t = (x - self.origin) * self.per_width;
        if !(LEAST..1.0).contains(&t) {
            return None;
        }
        let rest = fraction(t);
        let first = rest.wrapping_mul(self.radix);
        (first.wrapping_add(self.near) > self.near.saturating_mul(2)).then_some((t, rest))
    }

    /// The row of the next digit with its number, and what is left, from the middle of the cell.
    #[inline(always)]
    pub(crate) fn next(&self, rest: &mut u64) -> Option<(&Composite<C>, usize, f64)> {
        let index = digit(rest, self.radix);
        Some((self.table.get(index)?, index, from_middle(*rest)))
    }

    #[inline(always)]
    fn sum(&self, x: f64) -> Option<Jet> {
        let (t, mut rest) = self.place(x)?;
        let mut sums = Sums::new(self.chord_jet(t), 1.0);
        let [integral, value, slope] = self.terms;
        for _ in 1..integral {
            let (row, index, z) = self.next(&mut rest)?;
            sums.all(&row.c, row.a, *self.primitive.middles.get(index)?, z, &self.scales);
        }
        let (row, index, z) = self.next(&mut rest)?;
        sums.end_integral(&row.c, *self.primitive.middles.get(index)?, z, &self.scales);
        sums.value_and_slope(&row.c, row.a, z, &self.scales);
        for _ in integral..value {
            let (row, _, z) = self.next(&mut rest)?;
            sums.value_and_slope(&row.c, row.a, z, &self.scales);
        }
        let zeros = usize::from(rest == 0);
        sums.end_value(self.tails[0][zeros]);
        for _ in value..slope {
            let (row, _, z) = self.next(&mut rest)?;
            sums.slope(&row.c, row.a, z, &self.scales);
        }
        let zeros = usize::from(rest == 0);
        sums.end_slope(self.tails[1][zeros]);
        Some(sums.jet(self.width, self.per_width))
    }

    /// The jet of the chord at a place, with slope and integral in units of the domain.
    #[inline(always)]
    fn chord_jet(&self, t: f64) -> Jet {
        let Chord { start, rise } = self.chord;
        Jet {
            value: start + rise * t,
            slope: rise,
            integral: t * (start + 0.5 * rise * t) + self.primitive.half,
        }
    }

    /// Out of line: knots, and hardly any other point.
    #[cold]
    fn elsewhere(&self, x: f64) -> Jet<Bounded> {
        let slope = self.derivatives.first().map_or(Bounded::NAN, |f| f.evaluate(x, 0.0));
        let t = (x - self.origin) * self.per_width;
        let integral = if x.is_nan() {
            Bounded::NAN
        } else if t <= 0.0 {
            Bounded { value: 0.0, bound: 0.0 }
        } else {
            Bounded { value: self.width * self.integral(t), bound: self.away.integral }
        };
        Jet { value: self.system.evaluate(x, 0.0), slope, integral }
    }

    /// The integral alone, anywhere right of the left end.
    fn integral(&self, t: f64) -> f64 {
        if t >= 1.0 {
            return self.chord.start + 0.5 * self.chord.rise + self.primitive.whole;
        }
        let mut rest = (t * 18_446_744_073_709_551_616.0) as u64;
        let mut sums = Sums::new(self.chord_jet(t), 1.0);
        for _ in 1..self.terms[0] {
            let Some((row, index, z)) = self.next(&mut rest) else { break };
            let middle = self.primitive.middles.get(index).copied().unwrap_or(0.0);
            sums.all(&row.c, row.a, middle, z, &self.scales);
        }
        if let Some((row, index, z)) = self.next(&mut rest) {
            let middle = self.primitive.middles.get(index).copied().unwrap_or(0.0);
            sums.end_integral(&row.c, middle, z, &self.scales);
        }
        sums.jet(1.0, 1.0).integral
    }
}

/// A fraction less 1/2, exactly but for the last 11 bits.
#[inline(always)]
fn from_middle(rest: u64) -> f64 {
    ((rest ^ 1 << 63) as i64 >> 11) as f64 * UNIT
}
