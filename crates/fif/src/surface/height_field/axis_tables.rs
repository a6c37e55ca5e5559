//! Tables of one axis, with the constants that every ray needs.

use crate::numeric::floor::floor;
use crate::numeric::interval::Interval;
use crate::surface::height_field::jet_table::Jets;
use crate::surface::height_field::range_table::RangeTable;

/// Ranges over runs of the finest cells, values and slopes, and numbers drawn from these.
#[derive(Clone, Debug)]
pub struct AxisTables<J> {
    pub(crate) ranges: RangeTable,
    pub(crate) jets: J,
    pub(crate) domain: Interval,
    pub(crate) per_width: f64,
    pub(crate) cells: f64,
    /// `16 ε` of the domain's magnitude.
    pub(crate) pad: f64,
    /// The greatest `|f|` and `|f′|`.
    pub(crate) magnitude: f64,
    pub(crate) steepest: f64,
    /// Errors of values after 0, 1 and 2 steps.
    pub(crate) errors: [f64; 3],
    /// The steps that gain.
    pub(crate) finest: usize,
}

impl<J: Jets> AxisTables<J> {
    /// From ranges of values and slopes over the finest cells.
    pub(crate) fn new(cells: &[[Interval; 2]], jets: J, domain: Interval) -> Self {
        let whole = cells.iter().fold([Interval::EMPTY; 2], |h, c| [h[0].hull(c[0]), h[1].hull(c[1])]);
        Self {
            ranges: RangeTable::new(cells),
            domain,
            per_width: 1.0 / domain.width(),
            cells: cells.len() as f64,
            pad: 16.0 * f64::EPSILON * domain.magnitude(),
            magnitude: whole[0].magnitude(),
            steepest: whole[1].magnitude(),
            errors: [0, 1, 2].map(|steps| error(&jets, steps)),
            finest: jets.finest().0,
            jets,
        }
    }

    /// Ranges of values and slopes from one part of the domain to the next.
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

    /// Narrower enclosures where the parts are within two cells.
    pub(crate) fn finer(&self, parts: [f64; 2]) -> Option<[Interval; 2]> {
        self.jets.finer(&self.ranges, parts)
    }
}

/// Bound of the error of a value after so many steps.
#[inline]
pub(crate) fn error(jets: &impl Jets, steps: usize) -> f64 {
    jets.errors().get(steps).map_or(f64::INFINITY, |e| e[0])
}
