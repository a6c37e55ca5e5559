//! The sealed `Function` trait: functions along an axis of a height field.

use asperity_core::Interval;
use core::fmt::Debug;

use crate::numeric::double::Double;
use crate::numeric::estimate::{Bounded, Estimate};
#[cfg(feature = "alloc")]
use crate::surface::height_field::jet_table::{JetTable, Rows};
use crate::system::cell::Cell;
use crate::system::error::FifError;
use crate::system::fif::{Spacing, System};
use crate::system::map::Piece;
use crate::system::support::Support;
#[cfg(feature = "alloc")]
use crate::table::composite::Composite;

/// A function along an axis of a [`HeightField`](crate::HeightField): any [`System`] of up to eight
/// coefficients.
///
/// The trait is sealed.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be the function along an axis of a height field",
    note = "an axis takes a `Fif`, a `FixedFif` or, with the feature `alloc`, a `FifRef` of one to eight coefficients"
)]
pub trait Function: Axis {}

impl<F: Axis> Function for F {}

/// The operations of a [`Function`].
pub trait Axis: Clone + Debug {
    /// A cell of the domain, with the data for its children and bounds.
    type Cell: Copy + Debug;
    /// The derivative: one coefficient fewer in the same kind of storage.
    type Derivative: Function;
    #[cfg(feature = "alloc")]
    type Rows: Rows;

    fn domain(&self) -> Interval;
    fn range(&self) -> Interval;
    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded;
    /// The value at a position between doubles, and its change over the precision of that position.
    fn evaluate_between(&self, x: Double, tolerance: f64) -> Bounded;
    fn blur(&self, distance: f64) -> f64;
    fn mean(&self, l: f64, r: f64) -> Estimate;
    fn mean_square(&self, l: f64, r: f64) -> Result<Estimate, FifError>;
    /// The derivative, if it is continuous.
    fn differentiated(&self) -> Option<Self::Derivative>;
    fn root() -> Self::Cell;
    /// The number of children of a cell.
    fn count(&self) -> usize;
    /// Knots of child `j` in units of the width of the cell.
    fn part(&self, j: usize) -> [f64; 2];
    /// Knot `j` in units of the domain, as exactly as in [`System::evaluate`].
    fn knot(&self, j: usize) -> Double;
    /// Whether all children of a cell have the same width.
    fn is_even(&self) -> bool;
    /// Child `j`; the cell itself if it does not exist.
    fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell;
    /// An enclosure of the values over a cell.
    fn cell_range(&self, cell: &Self::Cell) -> Interval;
    /// Ranges of `f` plus lines, if they are worthwhile.
    fn support(&self) -> Option<Support>;
    /// A tighter enclosure of the values over a cell, using the support.
    fn supported_range(&self, cell: &Self::Cell, support: &Support) -> Interval;
    /// Values and slopes from a table, if possible; `slopes` encloses the derivative.
    #[cfg(feature = "alloc")]
    fn jets(&self, slopes: Interval) -> Option<JetTable<Self::Rows>>;
}

/// Storage of pieces for which the same kind of storage exists for the pieces of the derivative.
pub trait Lower<const C: usize>: AsRef<[Piece<C>]> + Clone + Debug {
    /// The derivative.
    type Derivative: Function;

    /// The derivative, if it is continuous.
    fn lower(system: &System<Self, C>) -> Option<Self::Derivative>
    where
        Self: Sized;
}

macro_rules! lower {
    (@[$($n:tt)*] $storage:ty, $c:literal => $derivative:ty) => {
        impl<$($n)*> Lower<$c> for $storage {
            type Derivative = $derivative;

            fn lower(system: &System<Self, $c>) -> Option<Self::Derivative> {
                system.derivative().ok()
            }
        }
    };
    ($($c:literal to $d:literal),*) => {$(
        lower!(@[const N: usize] [Piece<$c>; N], $c => System<[Piece<$d>; N], $d>);
        #[cfg(feature = "alloc")]
        lower!(@[] alloc::vec::Vec<Piece<$c>>, $c => System<alloc::vec::Vec<Piece<$d>>, $d>);
        #[cfg(feature = "alloc")]
        lower!(@[] &[Piece<$c>], $c => System<alloc::vec::Vec<Piece<$d>>, $d>);
    )*};
}

lower!(1 to 1, 2 to 1, 3 to 2, 4 to 3, 5 to 4, 6 to 5, 7 to 6, 8 to 7);

impl<S: Lower<C>, const C: usize> Axis for System<S, C> {
    type Cell = Cell<C>;
    type Derivative = S::Derivative;
    #[cfg(feature = "alloc")]
    type Rows = alloc::vec::Vec<Composite<C>>;

    #[inline]
    fn domain(&self) -> Interval {
        self.domain()
    }

    #[inline]
    fn range(&self) -> Interval {
        self.range()
    }

    #[inline]
    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        self.evaluate(x, tolerance)
    }

    fn evaluate_between(&self, x: Double, tolerance: f64) -> Bounded {
        self.evaluate_between(x, tolerance)
    }

    fn blur(&self, distance: f64) -> f64 {
        // On unequal knots a position represents a point within the precision of a double.
        match self.spacing() {
            Spacing::Uniform => self.modulus().at(distance),
            Spacing::Nonuniform => 0.0,
        }
    }

    fn mean(&self, l: f64, r: f64) -> Estimate {
        self.mean(l, r)
    }

    fn mean_square(&self, l: f64, r: f64) -> Result<Estimate, FifError> {
        self.mean_square(l, r)
    }

    fn differentiated(&self) -> Option<Self::Derivative> {
        S::lower(self)
    }

    fn root() -> Self::Cell {
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
    fn knot(&self, j: usize) -> Double {
        self.place(j)
    }

    #[inline]
    fn is_even(&self) -> bool {
        self.spacing() == Spacing::Uniform
    }

    #[inline]
    fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell {
        self.pieces().get(j).map_or(*cell, |piece| cell.child(piece))
    }

    #[inline]
    fn cell_range(&self, cell: &Self::Cell) -> Interval {
        cell.range(self.range())
    }

    fn support(&self) -> Option<Support> {
        Support::new(self.pieces(), self.range())
    }

    #[inline]
    fn supported_range(&self, cell: &Self::Cell, support: &Support) -> Interval {
        support.tilted_range(cell, [0.0; 2]).intersection(cell.range(self.range()))
    }

    #[cfg(feature = "alloc")]
    fn jets(&self, slopes: Interval) -> Option<JetTable<Self::Rows>> {
        JetTable::new(self.view(), slopes)
    }
}
