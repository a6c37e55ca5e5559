//! Fast values of a function from a table for its knots.

use alloc::vec::Vec;
use asperity_core::{BatchError, Interval};

use crate::numeric::estimate::Bounded;
use crate::system::error::FifError;
use crate::system::fif::{Fif, FifRef, System};
use crate::system::map::Piece;
use crate::table::composite::Composites;
use crate::table::jet::jet::Jet;
use crate::table::jet::rows::{Jets, derivatives};
use crate::table::nonuniform::Nonuniform;
use crate::table::uniform::Uniform;

#[doc = include_str!("../../docs/tables.md")]
#[derive(Clone, Debug)]
#[doc(alias = "lookup")]
pub struct Table<const C: usize> {
    rows: Rows<C>,
    /// Value, slope and integral together, if the function is smooth and its knots equally spaced.
    jets: Option<Jets<C>>,
    bound: f64,
    tolerance: f64,
    system: Fif<C>,
    /// All derivatives that are continuous.
    derivatives: Vec<Fif<C>>,
}

/// Composites for either kind of knots.
#[derive(Clone, Debug)]
enum Rows<const C: usize> {
    Uniform(Uniform<C>),
    Nonuniform(Nonuniform<C>),
}

impl<const C: usize> Rows<C> {
    /// The value away from knots, and its error bound.
    #[inline(always)]
    fn sum(&self, x: f64) -> (Option<f64>, f64) {
        match self {
            Self::Uniform(rows) => (rows.sum(x), rows.away),
            Self::Nonuniform(rows) => Self::nonuniform(rows, x),
        }
    }

    /// Out of line, because loops over single values on equal knots take a third longer with both
    /// inlined.
    #[inline(never)]
    fn nonuniform(rows: &Nonuniform<C>, x: f64) -> (Option<f64>, f64) {
        (rows.sum(x), rows.away)
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// Builds a table for values to `tolerance`, on any knots.
    ///
    /// A tolerance that is zero, negative, NaN or below the rounding error means the rounding
    /// error, so [`Table::bound`] never increases with a smaller tolerance.
    ///
    /// # Errors
    /// [`FifError`] if 64 steps leave more than `tolerance`: near-critical scalings on a number
    /// of maps that is not a power of two, or unequal knots with such scalings or thousands of
    /// maps.
    pub fn table(&self, tolerance: f64) -> Result<Table<C>, FifError> {
        self.view().tabulate(tolerance)
    }
}

impl<const C: usize> FifRef<'_, C> {
    /// [`System::table`], compiled once for all storage types.
    fn tabulate(self, tolerance: f64) -> Result<Table<C>, FifError> {
        let derivatives = derivatives(self);
        let (rows, jets, away) = match Composites::new(self) {
            Some(made) => {
                let rows = Uniform::new(self, &made, tolerance)?;
                let (away, jets) = (rows.away, Jets::new(self, &made, derivatives.len(), tolerance));
                (Rows::Uniform(rows), jets, away)
            }
            None => {
                let rows = Nonuniform::new(self, tolerance)?;
                let away = rows.away;
                (Rows::Nonuniform(rows), None, away)
            }
        };
        let elsewhere = self.least_bound();
        let bound = if away > elsewhere { away } else { elsewhere };
        Ok(Table { rows, jets, bound, tolerance, system: self.owned(), derivatives })
    }
}

impl<const C: usize> Table<C> {
    /// `f(x)`, within [`Table::bound`].
    ///
    /// - **Domain:** points outside the domain are clamped to it; NaN returns NaN. Knots are exact.
    /// - **Accuracy:** on equally spaced knots the bound holds for `f(x)` itself if `x − x_0` and
    ///   its product with `1/(x_N − x_0)` are exact, otherwise for an `f(x′)` with `x′` within
    ///   eight units in the last place. On other knots it is within sixteen units of `x` and of the
    ///   ends of the domain.
    ///
    /// Next to knots of the first digit of the table, and within 2⁻¹¹ of the domain from its left
    /// end, this calls [`System::evaluate`], which is ten to thirty times slower.
    // In a loop of the caller the constants stay in registers, which saves a quarter of the time of
    // a call.
    #[inline(always)]
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        match self.rows.sum(x) {
            (Some(value), _) => value,
            (None, _) => self.elsewhere(x).value,
        }
    }

    /// `f(x)` with its error bound: 0 at knots, NaN for NaN, otherwise at most [`Table::bound`].
    #[inline]
    pub fn evaluate(&self, x: f64) -> Bounded {
        match self.rows.sum(x) {
            (Some(value), bound) => Bounded { value, bound },
            (None, _) => self.elsewhere(x),
        }
    }

    /// Values at many points, in any order; each equals [`Table::value`].
    ///
    /// # Errors
    /// [`BatchError`] if the lengths of `y` and `x` differ. Nothing is written in this case.
    #[inline]
    pub fn values(&self, x: &[f64], y: &mut [f64]) -> Result<(), BatchError> {
        BatchError::check("y", x.len(), y.len())?;
        let places = x.iter().zip(y);
        match &self.rows {
            Rows::Uniform(rows) => {
                places.for_each(|(x, y)| *y = rows.sum(*x).unwrap_or_else(|| self.elsewhere(*x).value));
            }
            Rows::Nonuniform(rows) => {
                places.for_each(|(x, y)| *y = rows.sum(*x).unwrap_or_else(|| self.elsewhere(*x).value));
            }
        }
        Ok(())
    }

    /// Value, slope and integral at `x`, each within the bound that [`Table::evaluate_jet`]
    /// returns.
    ///
    /// - **Domain:** points outside the domain are clamped to it, slopes there are those of its
    ///   ends; NaN returns NaN. The slope of a function without a continuous
    ///   [`derivative`](System::derivative) is NaN. Otherwise it is finite, however close to 1 its
    ///   scalings are. Values at knots are exact.
    /// - **Accuracy:** as for [`Table::value`]; the slope is that of [`System::derivative`].
    /// - **Speed:** from the table if the function is smooth, its knots equally spaced and the
    ///   scalings of its slope not near one. Otherwise by [`System::evaluate`] and
    ///   [`System::integral_over`], in microseconds. The [`integral`](System::integral) of a rough
    ///   function is smooth: its jets contain `f` as the slope.
    ///
    /// ```
    /// use asperity_fif::cochran_2000;
    /// let f_hat = cochran_2000::f_hat()?.table(1e-12)?;
    /// let jet = f_hat.jet(1.3);
    /// assert!((jet.value - f_hat.system().evaluate(1.3, 1e-14).value).abs() <= 1e-12);
    /// assert!((jet.slope - cochran_2000::f()?.evaluate(1.3, 1e-14).value).abs() <= 1e-12);
    /// assert!((jet.integral - f_hat.system().integral_over(0.0, 1.3).value).abs() <= 1e-12);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    // See [`Table::value`].
    #[inline(always)]
    #[must_use]
    pub fn jet(&self, x: f64) -> Jet {
        match self.jets.as_ref().and_then(|jets| jets.sum(x)) {
            Some(jet) => jet,
            None => self.jet_elsewhere(x).map(|part| part.value),
        }
    }

    /// [`Table::jet`] with error bounds: NaN for NaN, 0 for values at knots. Slopes at knots are
    /// rounded.
    #[must_use]
    pub fn evaluate_jet(&self, x: f64) -> Jet<Bounded> {
        let Some(jets) = &self.jets else { return self.jet_elsewhere(x) };
        match jets.sum(x) {
            Some(jet) => jet.zip(jets.away).map(|(value, bound)| Bounded { value, bound }),
            None => self.jet_elsewhere(x),
        }
    }

    /// Jets at many points, in any order, bit-identical to [`Table::jet`].
    ///
    /// Uses SIMD if the number of maps is a power of two (feature `simd`), otherwise evaluates one
    /// by one.
    ///
    /// ```
    /// use asperity_fif::{Jet, cochran_2000};
    /// let f_hat = cochran_2000::f_hat()?.table(1e-12)?;
    /// let (mut value, mut slope, mut integral) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    /// f_hat.jets(&[0.3, 0.7], Jet { value: &mut value, slope: &mut slope, integral: &mut integral })?;
    /// assert_eq!(slope[1], f_hat.jet(0.7).slope);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`BatchError`] if the lengths of a list of `jets` and `x` differ. Nothing is written in this
    /// case.
    pub fn jets(&self, x: &[f64], jets: Jet<&mut [f64]>) -> Result<(), BatchError> {
        BatchError::check("value", x.len(), jets.value.len())?;
        BatchError::check("slope", x.len(), jets.slope.len())?;
        BatchError::check("integral", x.len(), jets.integral.len())?;
        let one_by_one = |x: &[f64], out: Jet<&mut [f64]>| {
            let places = out.value.iter_mut().zip(out.slope).zip(out.integral);
            for (x, ((value, slope), integral)) in x.iter().zip(places) {
                Jet { value: *value, slope: *slope, integral: *integral } = self.jet(*x);
            }
        };
        match &self.jets {
            #[cfg(feature = "simd")]
            Some(rows) => rows.in_lanes(x, jets, &one_by_one),
            _ => one_by_one(x, jets),
        }
        Ok(())
    }

    /// `f, f′, …, f^(M−1)` at `x`, with error bounds as in [`Table::jet`].
    ///
    /// NaN for derivatives beyond [`System::differentiability`].
    ///
    /// ```
    /// use asperity_fif::{FixedFif, cochran_2000};
    /// let twice: FixedFif<2, 4> = cochran_2000::f_hat()?.integral(0.0)?;
    /// let [_, first, second, third] = twice.table(1e-12)?.derivatives(0.3);
    /// assert!((first.value - cochran_2000::f_hat()?.evaluate(0.3, 1e-14).value).abs() <= first.bound + 1e-14);
    /// assert!((second.value - cochran_2000::f()?.evaluate(0.3, 1e-14).value).abs() <= second.bound + 1e-14);
    /// assert!(third.value.is_nan());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn derivatives<const M: usize>(&self, x: f64) -> [Bounded; M] {
        let by_rows = self.jets.as_ref().and_then(|jets| jets.derivatives(x));
        by_rows.unwrap_or_else(|| {
            core::array::from_fn(|m| match m.checked_sub(1) {
                None => self.system.evaluate(x, 0.0),
                Some(m) => self.derivatives.get(m).map_or(Bounded::NAN, |f| derivative_at(f, x)),
            })
        })
    }

    /// Error bound of every value: truncation and rounding, including those of the table.
    #[inline]
    #[must_use]
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// The tolerance for which the table was built.
    #[inline]
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The system from which the table was built.
    #[inline]
    #[must_use]
    pub fn system(&self) -> &Fif<C> {
        &self.system
    }

    /// An enclosure of the slopes of a smooth function.
    pub(crate) fn slopes(&self) -> Option<Interval> {
        self.derivatives.first().map(System::range)
    }

    /// Out of line: knots, and hardly any other point.
    #[cold]
    fn elsewhere(&self, x: f64) -> Bounded {
        self.system.evaluate(x, 0.0)
    }

    #[cold]
    fn jet_elsewhere(&self, x: f64) -> Jet<Bounded> {
        let slope = self.derivatives.first().map_or(Bounded::NAN, |f| derivative_at(f, x));
        let integral = match &self.jets {
            Some(jets) => jets.integral_at(x),
            None => {
                let area = self.system.integral_over(self.system.domain().lo, x);
                Bounded { value: area.value, bound: area.bound }
            }
        };
        Jet { value: self.system.evaluate(x, 0.0), slope, integral }
    }
}

/// The value of a derivative, whose ordinates at knots are rounded.
fn derivative_at<const C: usize>(f: &Fif<C>, x: f64) -> Bounded {
    let Bounded { value, bound } = f.evaluate(x, 0.0);
    Bounded { value, bound: bound + f.ordinate_error() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cochran_2000;
    use alloc::string::ToString;

    #[test]
    fn near_critical_scalings_are_an_error() {
        let thirds = [0.0, 1.0, 2.0, 3.0];
        let f = Fif::affine(&thirds, &[0.0, 1.0, -1.0, 0.0], &[0.999, -0.999, 0.99]).unwrap();
        for tolerance in [1e-6, 0.0, f64::NAN] {
            let error = f.table(tolerance).unwrap_err();
            assert!(matches!(error, FifError::TableDepth { alpha: 0.999, steps: 64, .. }), "{error}");
            let message = error.to_string();
            assert!(message.starts_with("`alpha` is too close to 1 for the tolerance: 0.999 leaves "));
            assert!(message.ends_with(" after 64 composites"), "{message}");
        }
        assert!(f.table(1e6).is_ok());
        let uneven = Fif::affine(&[0.0, 0.4, 1.0], &[0.0, 1.0, 0.0], &[0.999, 0.999]).unwrap();
        let error = uneven.table(1e-12).unwrap_err();
        assert!(matches!(error, FifError::TableDepth { alpha: 0.999, .. }), "{error}");
    }

    #[test]
    fn jet_slope_factor_near_one_is_finite() {
        let (y, slopes) = ([0.3, 1.0, -0.5, 0.25, 0.7], [1.0, 0.0, -1.0, 0.5, 0.3]);
        let knots: [&[f64]; 4] =
            [&[0.0, 1.0, 2.0], &[0.0, 0.4, 1.0], &[0.0, 1.0, 2.0, 3.0], &[0.0, 0.25, 0.5, 0.75, 1.0]];
        for part in [0.9999, 0.99999, 0.999_999, 0.999_999_99, 1.0 - 1e-12] {
            for x in knots {
                let maps = x.len() - 1;
                let alternating = |j: usize| if j % 2 == 1 { 0.5 } else { part };
                let each: [&dyn Fn(usize) -> f64; 3] = [&|_| part, &|_| -part, &alternating];
                for alpha in each {
                    let list: Vec<f64> =
                        (0..maps).map(|j| alpha(j) * (x[j + 1] - x[j]) / (x[maps] - x[0])).collect();
                    let f = Fif::hermite(x, &y[..=maps], &slopes[..=maps], &list).unwrap();
                    let table = f.table(1e-6).unwrap();
                    for at in [0.3, 0.777, 1e-9] {
                        let slope = table.evaluate_jet(at).slope;
                        assert!(
                            slope.value.is_finite() && slope.bound.is_finite(),
                            "{x:?} {list:?}: {slope:?}"
                        );
                        assert!(table.jet(at).slope.is_finite());
                    }
                    for (&at, want) in x.iter().zip(slopes) {
                        let slope = table.evaluate_jet(at).slope;
                        assert!(
                            (slope.value - want).abs() <= slope.bound,
                            "{x:?} {list:?}: {slope:?} {want}"
                        );
                    }
                    // The slope of an integral is the function.
                    let list: Vec<f64> = (0..maps).map(alpha).collect();
                    let f = Fif::affine(x, &y[..=maps], &list).unwrap();
                    let table = f.integral::<Vec<_>, 3>(0.0).unwrap().table(1e300).unwrap();
                    for at in [0.3, 0.777] {
                        let (slope, want) = (table.evaluate_jet(at).slope, f.evaluate(at, 0.0));
                        let error = (slope.value - want.value).abs();
                        assert!(error <= slope.bound + want.bound, "{x:?} {list:?}: {slope:?} {want:?}");
                    }
                    for (&at, want) in x.iter().zip(y) {
                        let slope = table.evaluate_jet(at).slope;
                        assert!(
                            (slope.value - want).abs() <= slope.bound,
                            "{x:?} {list:?}: {slope:?} {want}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn jets_of_rough_functions_and_unequal_knots() {
        let g = cochran_2000::g().unwrap();
        let jet = g.table(1e-9).unwrap().evaluate_jet(0.7);
        assert!(jet.slope.value.is_nan());
        assert_eq!(jet.integral.value, g.integral_over(0.0, 0.7).value);
        let x = [0.0, 0.4, 1.0];
        let f = Fif::hermite(&x, &[0.0, 1.0, 0.5], &[1.0, 0.0, -1.0], &[0.3, -0.4]).unwrap();
        let (table, slope) = (f.table(1e-9).unwrap(), f.derivative::<Vec<Piece<3>>, 3>().unwrap());
        let (jet, want) = (table.evaluate_jet(0.3), slope.evaluate(0.3, 0.0));
        assert!((jet.slope.value - want.value).abs() <= jet.slope.bound + want.bound);
        assert_eq!(table.jet(0.3).value, jet.value.value);
    }
}
