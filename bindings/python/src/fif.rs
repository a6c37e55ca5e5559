//! Fractal interpolation functions over arrays.

use std::sync::Arc;

use asperity_fif::{Fif as Function, fit};
use pyo3::prelude::*;

use crate::batch::{Flat, Rows, map, value_error};
use crate::curve::{Curve, System, through};
use crate::parallel;

/// A fractal interpolation function.
#[pyclass(frozen, module = "asperity._asperity")]
pub(crate) struct Fif(pub(crate) Arc<dyn Curve>);

/// A value, its bound and its condition number.
type Triple = (f64, f64, f64);

/// Minimum, maximum, and the brackets of their positions.
type Extremes = [(f64, f64); 4];

#[pymethods]
impl Fif {
    /// The affine function through points.
    #[staticmethod]
    fn affine(x: Vec<f64>, y: Vec<f64>, alpha: Vec<f64>) -> PyResult<Self> {
        Function::<2>::affine(&x, &y, &alpha).map(|f| Self(Arc::new(f))).map_err(value_error)
    }

    /// The differentiable function through points with slopes.
    #[staticmethod]
    fn hermite(x: Vec<f64>, y: Vec<f64>, slope: Vec<f64>, alpha: Vec<f64>) -> PyResult<Self> {
        Function::<4>::hermite(&x, &y, &slope, &alpha).map(|f| Self(Arc::new(f))).map_err(value_error)
    }

    /// The function with these polynomials.
    #[staticmethod]
    fn polynomial(x: Vec<f64>, alpha: Vec<f64>, q: Vec<Vec<f64>>) -> PyResult<Self> {
        through(&x, &alpha, &q).map(Self).map_err(value_error)
    }

    /// The affine function that fits data between knots, with its error and rms, and its collage error
    /// and bound.
    #[staticmethod]
    fn fit(
        py: Python<'_>,
        x: Vec<f64>,
        y: Vec<f64>,
        knots: Vec<usize>,
        steps: usize,
    ) -> PyResult<(Self, [f64; 4])> {
        let fitted = parallel::until_signal(py, |_| {
            if steps == 0 { fit::affine(&x, &y, &knots) } else { fit::refine(&x, &y, &knots, steps) }
        })?;
        let fit::Fit { system, error, rms, collage, bound } = fitted.map_err(value_error)?;
        Ok((Self(Arc::new(system)), [error, rms, collage, bound]))
    }

    /// Knots for a fit within a tolerance, as indices of the data.
    #[staticmethod]
    fn fit_knots(
        py: Python<'_>,
        x: Vec<f64>,
        y: Vec<f64>,
        tolerance: f64,
        longest: usize,
    ) -> PyResult<Vec<usize>> {
        parallel::until_signal(py, |_| fit::knots(&x, &y, tolerance, longest))?.map_err(value_error)
    }

    /// Values and bounds at numbers, in rows of one.
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        x: Rows<'py, f64>,
        tolerance: f64,
        threads: Option<isize>,
    ) -> PyResult<Flat<'py, f64>> {
        map(py, &x, threads, |[x]: [f64; 1]| {
            let value = self.0.evaluate(x, tolerance);
            [value.value, value.bound]
        })
    }

    /// Integrals, means or moments over intervals, with bounds and condition numbers.
    fn integrate<'py>(
        &self,
        py: Python<'py>,
        what: &str,
        ends: Rows<'py, f64>,
        threads: Option<isize>,
    ) -> PyResult<Flat<'py, f64>> {
        let triple = |e: asperity_fif::Estimate| [e.value, e.bound, e.condition];
        match what {
            "integral" => map(py, &ends, threads, |[l, r]: [f64; 2]| triple(self.0.integral_over(l, r))),
            "mean" => map(py, &ends, threads, |[l, r]: [f64; 2]| triple(self.0.mean(l, r))),
            _ => Err(value_error(format!("unknown quantity `{what}`"))),
        }
    }

    /// ∫ xᵏ f(x)ᵖ dx with its bound and condition number.
    fn moment(&self, py: Python<'_>, k: usize, p: usize, l: f64, r: f64) -> PyResult<Triple> {
        let moment = parallel::until_signal(py, |_| self.0.moment_over(k, p, l, r))?;
        moment.map(|e| (e.value, e.bound, e.condition)).map_err(value_error)
    }

    /// Minimum and maximum over an interval, and where they are.
    fn extrema(&self, py: Python<'_>, l: f64, r: f64, width: f64) -> PyResult<Option<Extremes>> {
        let extrema = parallel::until_signal(py, |_| self.0.extrema_over(l, r, width))?;
        Ok(extrema.map(|e| [e.minimum, e.maximum, e.at_minimum, e.at_maximum].map(|i| (i.lo, i.hi))))
    }

    /// The graph's box dimension, between two bounds.
    fn dimension(&self) -> (f64, f64) {
        let dimension = self.0.dimension();
        (dimension.lo, dimension.hi)
    }

    /// The largest |f(x) − f(y)| for |x − y| up to distances, bounded from above.
    fn modulus<'py>(&self, py: Python<'py>, distance: Rows<'py, f64>) -> PyResult<Flat<'py, f64>> {
        map(py, &distance, None, |[d]: [f64; 1]| [self.0.modulus(d)])
    }

    fn holder_exponent(&self) -> f64 {
        self.0.holder_exponent()
    }

    fn conditioning<'py>(&self, py: Python<'py>, x: Rows<'py, f64>) -> PyResult<Flat<'py, f64>> {
        map(py, &x, None, |[x]: [f64; 1]| [self.0.conditioning(x)])
    }

    fn integral(&self, y0: f64) -> PyResult<Self> {
        self.0.integral(y0).map(Self).map_err(value_error)
    }

    fn derivative(&self) -> PyResult<Self> {
        self.0.derivative().map(Self).map_err(value_error)
    }

    fn domain(&self) -> (f64, f64) {
        let domain = self.0.domain();
        (domain.lo, domain.hi)
    }

    fn range(&self) -> (f64, f64) {
        let range = self.0.range();
        (range.lo, range.hi)
    }

    /// Knots, values, scalings and polynomials.
    fn system(&self) -> (Vec<f64>, Vec<f64>, Vec<f64>, Vec<Vec<f64>>) {
        let System { knots, values, scaling, polynomials } = self.0.system();
        (knots, values, scaling, polynomials)
    }

    fn degree(&self) -> usize {
        self.0.coefficients() - 1
    }
}
