//! The function along one axis of a height field, with its derivative.

use crate::calculus::moment_basis::MomentError;
use crate::numeric::estimate::Estimate;
use crate::numeric::interval::{Bounded, Interval};
use crate::surface::height_field::function::Function;

/// An axis of a [`HeightField`](crate::HeightField): a [`Curve`], alone or with tables; sealed.
pub trait Axis: sealed::Descend {
    /// `[x_0, x_N]`.
    #[must_use]
    fn domain(&self) -> Interval;

    /// A rigorous enclosure of the values.
    #[must_use]
    fn range(&self) -> Interval;

    /// The value at `x`, as [`System::evaluate`](crate::System::evaluate).
    #[must_use]
    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded;

    /// The slope at `x` to the rounding error, or `None` for a function that is only continuous.
    #[must_use]
    fn slope(&self, x: f64) -> Option<f64>;
}

/// Means of a function over an interval, and of its slope when it has one.
#[derive(Clone, Copy, Debug)]
pub struct LineMeans {
    /// The mean of `f`.
    pub(crate) value: Estimate,
    /// The mean of `f²`.
    pub(crate) value_squared: Estimate,
    /// The means of `f′`, of `f′²` and of `f f′`.
    pub(crate) slope: Option<[Estimate; 3]>,
}

pub(crate) mod sealed {
    use super::{LineMeans, MomentError};
    use crate::numeric::interval::{Bounded, Interval};
    #[cfg(feature = "alloc")]
    use crate::surface::height_field::{axis_tables::AxisTables, jet_table::Jets};

    /// Descent from the domain to ever smaller cells.
    pub trait Descend {
        /// A cell, as far as its children and bounds need it.
        type Cell: Copy;

        /// A table of values and slopes.
        #[cfg(feature = "alloc")]
        type Jets: Jets;

        /// The whole domain.
        fn root(&self) -> Self::Cell;

        /// The number of children of a cell.
        fn count(&self) -> usize;

        /// Knots of child `j` in units of the cell's width.
        fn part(&self, j: usize) -> [f64; 2];

        /// Child `j`; the cell itself when there is none.
        fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell;

        /// Enclosures of the values and of the slopes over the cell; [`Interval::ENTIRE`] for unknown slopes.
        fn bounds(&self, cell: &Self::Cell) -> [Interval; 2];

        /// The value to the rounding error, as near as a ray's own coordinates are.
        fn near(&self, x: f64) -> Bounded;

        /// Means over the interval between `l` and `r`, clamped to the domain; the values at `l` when both are equal.
        fn means(&self, l: f64, r: f64) -> Result<LineMeans, MomentError>;

        /// The tables of the top levels, where there are values and slopes too.
        #[cfg(feature = "alloc")]
        fn top(&self) -> Option<&AxisTables<Self::Jets>>;
    }
}

/// A function along an axis with its derivative, where that is continuous.
#[derive(Clone, Copy, Debug)]
pub struct Curve<F: Function> {
    function: F,
    derivative: Option<F::Derivative>,
}

impl<F: Function> Curve<F> {
    pub(crate) fn new(function: F) -> Self {
        Self { derivative: function.differentiated(), function }
    }

    /// The function.
    #[must_use]
    pub const fn function(&self) -> &F {
        &self.function
    }

    /// Its derivative, by [`System::derivative`](crate::System::derivative).
    #[must_use]
    pub const fn derivative(&self) -> Option<&F::Derivative> {
        self.derivative.as_ref()
    }

    /// The table of values and slopes, where there can be one.
    #[cfg(feature = "alloc")]
    pub(crate) fn jets(&self) -> Option<F::Jets> {
        self.function.jets(self.derivative.as_ref()?.range())
    }
}

/// A cell of a function and of its derivative.
#[derive(Clone, Copy, Debug)]
pub struct CurveCell<V, D> {
    value: V,
    slope: D,
}

/// The cells of a curve of `F`.
#[cfg(feature = "alloc")]
pub(crate) type CellOf<F> = CurveCell<<F as Function>::Cell, <<F as Function>::Derivative as Function>::Cell>;

impl<F: Function> sealed::Descend for Curve<F> {
    type Cell = CurveCell<F::Cell, <F::Derivative as Function>::Cell>;
    #[cfg(feature = "alloc")]
    type Jets = F::Jets;

    fn root(&self) -> Self::Cell {
        CurveCell { value: F::root(), slope: F::Derivative::root() }
    }

    #[inline]
    fn count(&self) -> usize {
        self.function.count()
    }

    #[inline]
    fn part(&self, j: usize) -> [f64; 2] {
        self.function.part(j)
    }

    #[inline]
    fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell {
        let slope = self.derivative.as_ref().map_or(cell.slope, |slope| slope.child(&cell.slope, j));
        CurveCell { value: self.function.child(&cell.value, j), slope }
    }

    #[inline]
    fn bounds(&self, cell: &Self::Cell) -> [Interval; 2] {
        let slope = self.derivative.as_ref().map_or(Interval::ENTIRE, |slope| slope.cell_range(&cell.slope));
        [self.function.cell_range(&cell.value), slope]
    }

    #[inline]
    fn near(&self, x: f64) -> Bounded {
        self.function.evaluate(x, 0.0)
    }

    fn means(&self, l: f64, r: f64) -> Result<LineMeans, MomentError> {
        let (value, value_squared) = (self.function.mean(l, r), self.function.mean_square(l, r)?);
        let Some(derivative) = &self.derivative else {
            return Ok(LineMeans { value, value_squared, slope: None });
        };
        let slope = derivative.mean(l, r);
        // ∫ f f′ = (f(r)² − f(l)²)/2 = (f(r) + f(l))/2 · ∫ f′: the second form does not cancel.
        let [a, b] = [l, r].map(|x| self.function.evaluate(x, 0.0));
        let ends = Estimate::new(
            0.5 * (a.value + b.value),
            0.5 * (a.value.abs() + b.value.abs()),
            a.bound + b.bound,
        );
        let slope = [slope, derivative.mean_square(l, r)?, ends.product(slope)];
        Ok(LineMeans { value, value_squared, slope: Some(slope) })
    }

    #[cfg(feature = "alloc")]
    fn top(&self) -> Option<&crate::surface::height_field::axis_tables::AxisTables<Self::Jets>> {
        None
    }
}

impl<F: Function> Axis for Curve<F> {
    fn domain(&self) -> Interval {
        self.function.domain()
    }

    fn range(&self) -> Interval {
        self.function.range()
    }

    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        self.function.evaluate(x, tolerance)
    }

    fn slope(&self, x: f64) -> Option<f64> {
        Some(self.derivative.as_ref()?.evaluate(x, 0.0).value)
    }
}
