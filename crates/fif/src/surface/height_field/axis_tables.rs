//! Tables of one axis, with the constants for rays.

use asperity_core::Interval;

use crate::numeric::floor::floor;
use crate::surface::height_field::jet_table::{JetTable, Rows};
use crate::surface::height_field::range_table::RangeTable;

/// Ranges of values and slopes over runs of the finest cells, and derived numbers.
#[derive(Clone, Debug)]
pub(crate) struct AxisTables<R> {
    pub(crate) ranges: RangeTable,
    pub(crate) jets: JetTable<R>,
    pub(crate) domain: Interval,
    pub(crate) per_width: f64,
    pub(crate) cells: f64,
    /// `16 ε` of the magnitude of the domain.
    pub(crate) pad: f64,
    /// The maximum of `|f|` and `|f′|`.
    pub(crate) magnitude: f64,
    pub(crate) steepest: f64,
}

/// Constants of a product of two axes with tables.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BothAxes {
    /// The maximum of `|∂h/∂x|` and `|∂h/∂y|`.
    pub(crate) falls: [f64; 2],
    /// `16 ε` of the maximum height.
    pub(crate) pad: f64,
    /// Errors of a height after 0, 1 and 2 steps, and after the finest.
    pub(crate) errors: [f64; 3],
    pub(crate) best: f64,
    /// Number of steps for values to the rounding error.
    pub(crate) finest: usize,
}

impl BothAxes {
    pub(crate) fn new<P: Rows, Q: Rows>(x: &AxisTables<P>, y: &AxisTables<Q>) -> Self {
        let finest = x.jets.finest().0.max(y.jets.finest().0);
        let product = |f: f64, g: f64| 1.0001 * (x.magnitude * g + y.magnitude * f + f * g);
        Self {
            falls: [x.steepest * y.magnitude, x.magnitude * y.steepest],
            pad: 16.0 * f64::EPSILON * (x.magnitude * y.magnitude),
            errors: [0, 1, 2].map(|steps| product(x.jets.error(steps), y.jets.error(steps))),
            best: product(x.jets.error(finest), y.jets.error(finest)),
            finest,
        }
    }
}

impl<R: Rows> AxisTables<R> {
    /// Creates tables from ranges of values and slopes over the finest cells.
    pub(crate) fn new(cells: &[[Interval; 2]], jets: JetTable<R>, domain: Interval) -> Self {
        let whole = cells.iter().fold([Interval::EMPTY; 2], |h, c| [h[0].hull(c[0]), h[1].hull(c[1])]);
        Self {
            ranges: RangeTable::new(cells),
            domain,
            per_width: 1.0 / domain.width(),
            cells: cells.len() as f64,
            pad: 16.0 * f64::EPSILON * domain.magnitude(),
            magnitude: whole[0].magnitude(),
            steepest: whole[1].magnitude(),
            jets,
        }
    }

    /// Ranges of values and slopes between two fractions of the domain.
    #[inline(always)]
    pub(crate) fn over(&self, parts: [f64; 2]) -> [Interval; 2] {
        let last = self.cells - 0.5;
        let cell = |part: f64| {
            let cell = part * self.cells;
            let cell = if cell > 0.0 { cell } else { 0.0 };
            floor(if cell < last { cell } else { last }).1
        };
        self.ranges.over(cell(parts[0]), cell(parts[1]))
    }

    /// Narrower enclosures if the fractions are within two cells.
    pub(crate) fn finer(&self, parts: [f64; 2]) -> Option<[Interval; 2]> {
        self.jets.finer(&self.ranges, parts)
    }
}
