//! What a height field asks of the function along one of its axes.

use crate::numeric::interval::{Bounded, Interval};
#[cfg(feature = "alloc")]
use crate::surface::height_field::axis_tables::AxisTables;
#[cfg(feature = "alloc")]
use crate::surface::height_field::jet_table::{JetTable, NoJets};
use crate::system::cell::Cell;
use crate::system::error::SystemError;
use crate::system::fif::Fif;
use crate::system::map::Piece;
use crate::system::storage::Storage;

/// A function along one axis of a [`HeightField`](crate::HeightField): values, bounds over cells, slopes if it has them.
///
/// Implemented by [`Fif`], [`Smooth`] and [`Cached`](crate::Cached); sealed.
pub trait Axis: sealed::Descend {
    /// `[x_0, x_N]`.
    #[must_use]
    fn domain(&self) -> Interval;

    /// A rigorous enclosure of the values.
    #[must_use]
    fn range(&self) -> Interval;

    /// The value at `x`, as [`Fif::evaluate`].
    #[must_use]
    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded;

    /// The slope at `x` to the rounding error, or `None` for a function that is only continuous.
    #[must_use]
    fn slope(&self, x: f64) -> Option<f64>;
}

pub(crate) mod sealed {
    use crate::numeric::interval::{Bounded, Interval};
    #[cfg(feature = "alloc")]
    use crate::surface::height_field::axis_tables::AxisTables;
    #[cfg(feature = "alloc")]
    use crate::surface::height_field::jet_table::Jets;

    /// Descent from the domain to ever smaller cells.
    pub trait Descend {
        /// A cell, as far as its children and bounds need it.
        type Cell: Copy;

        /// A table of values and slopes, for functions that can have one.
        #[cfg(feature = "alloc")]
        type Jets: Jets;

        /// The whole domain.
        fn root(&self) -> Self::Cell;

        /// The number of children of a cell.
        fn count(&self) -> usize;

        /// Where the knots of child `j` lie in the cell, in units of its width.
        fn part(&self, j: usize) -> [f64; 2];

        /// Child `j`; the cell itself when there is none.
        fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell;

        /// Enclosures of the values and of the slopes over the cell; [`Interval::ENTIRE`] for unknown slopes.
        fn bounds(&self, cell: &Self::Cell) -> [Interval; 2];

        /// The value to the rounding error, as near as a ray's own coordinates are.
        fn near(&self, x: f64) -> Bounded;

        /// Makes the table, where there can be one.
        #[cfg(feature = "alloc")]
        fn jets(&self) -> Option<Self::Jets> {
            None
        }

        /// The tables of the cached top levels, where there are values and slopes too.
        #[cfg(feature = "alloc")]
        fn top(&self) -> Option<&AxisTables<Self::Jets>> {
            None
        }
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize> sealed::Descend for Fif<S, C> {
    type Cell = Cell<C>;
    #[cfg(feature = "alloc")]
    type Jets = NoJets;

    fn root(&self) -> Self::Cell {
        Cell::root()
    }

    #[inline]
    fn count(&self) -> usize {
        self.pieces().len()
    }

    #[inline]
    fn part(&self, j: usize) -> [f64; 2] {
        self.pieces().get(j).map_or([0.0, 1.0], |piece| piece.s)
    }

    #[inline]
    fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell {
        self.pieces().get(j).map_or(*cell, |piece| cell.child(piece))
    }

    #[inline]
    fn bounds(&self, cell: &Self::Cell) -> [Interval; 2] {
        [cell.range(self.range()), Interval::ENTIRE]
    }

    #[inline]
    fn near(&self, x: f64) -> Bounded {
        self.evaluate(x, 0.0)
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize> Axis for Fif<S, C> {
    fn domain(&self) -> Interval {
        self.domain()
    }

    fn range(&self) -> Interval {
        self.range()
    }

    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        self.evaluate(x, tolerance)
    }

    fn slope(&self, _x: f64) -> Option<f64> {
        None
    }
}

/// A continuously differentiable fractal interpolation function together with its derivative.
///
/// ```text
/// f̂(x) = y_0 + ∫ f,   f̂′ = f
/// ```
///
/// Cochran, Lewis, Hart 2000, §3 and eq. 34–36.
#[derive(Clone, Copy, Debug)]
pub struct Smooth<S, const C: usize, T, const D: usize> {
    value: Fif<S, C>,
    slope: Fif<T, D>,
}

impl<S: Storage<C>, const C: usize, T: AsRef<[Piece<D>]>, const D: usize> Smooth<S, C, T, D> {
    /// The integral of `slope` that begins with `y0`, as [`Fif::integral`].
    ///
    /// # Errors
    /// Those of [`Fif::integral`].
    pub fn integral(slope: Fif<T, D>, y0: f64) -> Result<Self, SystemError> {
        Ok(Self { value: slope.integral(y0)?, slope })
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize, T: Storage<D>, const D: usize> Smooth<S, C, T, D> {
    /// `value` with its derivative found, as [`Fif::derivative`].
    ///
    /// # Errors
    /// Those of [`Fif::derivative`]: the function may not be differentiable.
    pub fn of(value: Fif<S, C>) -> Result<Self, SystemError> {
        Ok(Self { slope: value.derivative()?, value })
    }
}

impl<S, const C: usize, T, const D: usize> Smooth<S, C, T, D> {
    /// The function.
    #[must_use]
    pub const fn value(&self) -> &Fif<S, C> {
        &self.value
    }

    /// Its derivative.
    #[must_use]
    pub const fn derivative(&self) -> &Fif<T, D> {
        &self.slope
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize, T: AsRef<[Piece<D>]>, const D: usize> sealed::Descend
    for Smooth<S, C, T, D>
{
    type Cell = (Cell<C>, Cell<D>);
    #[cfg(feature = "alloc")]
    type Jets = JetTable<C>;

    fn root(&self) -> Self::Cell {
        (Cell::root(), Cell::root())
    }

    #[inline]
    fn count(&self) -> usize {
        self.value.count()
    }

    #[inline]
    fn part(&self, j: usize) -> [f64; 2] {
        self.value.part(j)
    }

    #[inline]
    fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell {
        (self.value.child(&cell.0, j), self.slope.child(&cell.1, j))
    }

    #[inline]
    fn bounds(&self, cell: &Self::Cell) -> [Interval; 2] {
        [cell.0.range(self.value.range()), cell.1.range(self.slope.range())]
    }

    #[inline]
    fn near(&self, x: f64) -> Bounded {
        self.value.evaluate(x, 0.0)
    }

    #[cfg(feature = "alloc")]
    fn jets(&self) -> Option<Self::Jets> {
        JetTable::new(&self.value, &self.slope)
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize, T: AsRef<[Piece<D>]>, const D: usize> Axis for Smooth<S, C, T, D> {
    fn domain(&self) -> Interval {
        self.value.domain()
    }

    fn range(&self) -> Interval {
        self.value.range()
    }

    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        self.value.evaluate(x, tolerance)
    }

    fn slope(&self, x: f64) -> Option<f64> {
        Some(self.slope.evaluate(x, 0.0).value)
    }
}

/// A borrowed axis is an axis, so that one table can serve two axes or two surfaces.
impl<A: sealed::Descend> sealed::Descend for &A {
    type Cell = A::Cell;
    #[cfg(feature = "alloc")]
    type Jets = A::Jets;

    #[inline]
    fn root(&self) -> Self::Cell {
        A::root(self)
    }

    #[inline]
    fn count(&self) -> usize {
        A::count(self)
    }

    #[inline]
    fn part(&self, j: usize) -> [f64; 2] {
        A::part(self, j)
    }

    #[inline]
    fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell {
        A::child(self, cell, j)
    }

    #[inline]
    fn bounds(&self, cell: &Self::Cell) -> [Interval; 2] {
        A::bounds(self, cell)
    }

    #[inline]
    fn near(&self, x: f64) -> Bounded {
        A::near(self, x)
    }

    #[cfg(feature = "alloc")]
    fn jets(&self) -> Option<Self::Jets> {
        A::jets(self)
    }

    #[cfg(feature = "alloc")]
    #[inline]
    fn top(&self) -> Option<&AxisTables<Self::Jets>> {
        A::top(self)
    }
}

impl<A: Axis> Axis for &A {
    fn domain(&self) -> Interval {
        A::domain(self)
    }

    fn range(&self) -> Interval {
        A::range(self)
    }

    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        A::evaluate(self, x, tolerance)
    }

    fn slope(&self, x: f64) -> Option<f64> {
        A::slope(self, x)
    }
}
