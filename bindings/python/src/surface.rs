//! Fractal surfaces and rays over arrays.

use asperity_fif::glam::{DVec2, DVec3};
use asperity_fif::{
    Bounded, Fif as Function, FoldedSurface, HeightField, Hit, Intersect, Interval, PeriodicSurface, Ray,
    RoughFoldedSurface, Tabulated,
};
use pyo3::prelude::*;

use crate::batch::{Flat, Rows, map, value_error};
use crate::fif::Fif;
use crate::parallel;

/// A surface of one of the types.
enum Kind {
    Product(Box<HeightField<Function<4>, Function<4>>>),
    Periodic(Box<Tabulated<PeriodicSurface>>, Box<PeriodicSurface>),
    Folded(Box<Tabulated<FoldedSurface>>, Box<FoldedSurface>),
    Rough(Box<Tabulated<RoughFoldedSurface>>, Box<RoughFoldedSurface>),
}

/// A fractal height field.
#[pyclass(frozen, module = "asperity._asperity")]
pub(crate) struct Surface(Kind);

#[pymethods]
impl Surface {
    /// f(x) g(y).
    #[staticmethod]
    fn product(py: Python<'_>, f: &Fif, g: &Fif) -> PyResult<Self> {
        let message = || value_error("a surface needs functions with polynomials of degree 3 or less");
        let (f, g) = (f.0.cubic().ok_or_else(message)?, g.0.cubic().ok_or_else(message)?);
        let field = parallel::until_signal(py, |_| HeightField::new(f, g).tabulated())?;
        Ok(Self(Kind::Product(Box::new(field))))
    }

    /// A surface of period 1.
    #[staticmethod]
    fn periodic(
        py: Python<'_>,
        side: usize,
        matrix: [[i32; 2]; 2],
        scaling: f64,
        heights: Vec<f64>,
        gradients: Vec<[f64; 2]>,
    ) -> PyResult<Self> {
        let surface = parallel::until_signal(py, |_| {
            PeriodicSurface::new(side, matrix, scaling, &heights, &gradients)
                .map(|surface| Kind::Periodic(Box::new(surface.clone().tabulated()), Box::new(surface)))
        })?;
        surface.map(Self).map_err(value_error)
    }

    /// A surface over a grid of knots with one scaling.
    #[staticmethod]
    fn folded(
        py: Python<'_>,
        x: Vec<f64>,
        y: Vec<f64>,
        scaling: f64,
        heights: Vec<f64>,
        gradients: Vec<[f64; 2]>,
    ) -> PyResult<Self> {
        let surface = parallel::until_signal(py, |_| {
            FoldedSurface::new(&x, &y, scaling, &heights, &gradients)
                .map(|surface| Kind::Folded(Box::new(surface.clone().tabulated()), Box::new(surface)))
        })?;
        surface.map(Self).map_err(value_error)
    }

    /// A surface over a grid of knots with a scaling at each.
    #[staticmethod]
    fn rough_folded(
        py: Python<'_>,
        x: Vec<f64>,
        y: Vec<f64>,
        scaling: Vec<f64>,
        heights: Vec<f64>,
        gradients: Vec<[f64; 2]>,
    ) -> PyResult<Self> {
        let surface = parallel::until_signal(py, |_| {
            RoughFoldedSurface::new(&x, &y, &scaling, &heights, &gradients)
                .map(|surface| Kind::Rough(Box::new(surface.clone().tabulated()), Box::new(surface)))
        })?;
        surface.map(Self).map_err(value_error)
    }

    /// Heights and bounds at points.
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py, f64>,
        tolerance: f64,
        threads: Option<isize>,
    ) -> PyResult<Flat<'py, f64>> {
        map(py, &points, threads, |[x, y]: [f64; 2]| {
            let Bounded { value, bound } = match &self.0 {
                Kind::Product(surface) => surface.evaluate(x, y, tolerance),
                Kind::Periodic(_, surface) => surface.evaluate(x, y, tolerance),
                Kind::Folded(_, surface) => surface.evaluate(x, y, tolerance),
                Kind::Rough(_, surface) => surface.evaluate(x, y, tolerance),
            };
            [value, bound]
        })
    }

    /// Gradients at points, NaN where the height has no derivative.
    fn gradient<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py, f64>,
        threads: Option<isize>,
    ) -> PyResult<Flat<'py, f64>> {
        map(py, &points, threads, |[x, y]: [f64; 2]| {
            let gradient = match &self.0 {
                Kind::Product(surface) => surface.gradient(x, y),
                Kind::Periodic(_, surface) => Some(surface.gradient(x, y)),
                Kind::Folded(_, surface) => Some(surface.gradient(x, y)),
                Kind::Rough(..) => None,
            };
            gradient.unwrap_or(DVec2::NAN).to_array()
        })
    }

    /// First hits of rays: t, x, y, height, normal, and whether the hit is certain. NaN without a hit.
    fn intersect<'py>(
        &self,
        py: Python<'py>,
        rays: Rows<'py, f64>,
        t: [f64; 2],
        tolerance: f64,
        threads: Option<isize>,
    ) -> PyResult<Flat<'py, f64>> {
        let within = Interval::new(t[0], t[1]);
        map(py, &rays, threads, |[ox, oy, oz, dx, dy, dz]: [f64; 6]| {
            let ray = Ray { origin: DVec3::new(ox, oy, oz), direction: DVec3::new(dx, dy, dz) };
            let hit = match &self.0 {
                Kind::Product(surface) => surface.intersect_within(&ray, within, tolerance),
                Kind::Periodic(surface, _) => surface.intersect_within(&ray, within, tolerance),
                Kind::Folded(surface, _) => surface.intersect_within(&ray, within, tolerance),
                Kind::Rough(surface, _) => surface.intersect_within(&ray, within, tolerance),
            };
            hit.map_or([f64::NAN; 8], |Hit { t, x, y, height, normal, certain, .. }| {
                let [nx, ny, nz] = normal.unwrap_or(DVec3::NAN).to_array();
                [t, x, y, height, nx, ny, nz, f64::from(u8::from(certain))]
            })
        })
    }

    /// The domain along x and y.
    fn domain(&self) -> [(f64, f64); 2] {
        use asperity_fif::Surface as _;
        let domain = match &self.0 {
            Kind::Product(surface) => surface.domain(),
            Kind::Periodic(surface, _) => surface.domain(),
            Kind::Folded(surface, _) => surface.domain(),
            Kind::Rough(surface, _) => surface.domain(),
        };
        domain.map(|interval| (interval.lo, interval.hi))
    }

    /// Lower and upper bound of the heights.
    fn range(&self) -> (f64, f64) {
        use asperity_fif::Surface as _;
        let range = match &self.0 {
            Kind::Product(surface) => surface.range(),
            Kind::Periodic(surface, _) => surface.range(),
            Kind::Folded(surface, _) => surface.range(),
            Kind::Rough(surface, _) => surface.range(),
        };
        (range.lo, range.hi)
    }
}
