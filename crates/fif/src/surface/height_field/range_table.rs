//! Ranges over any run of the finest cells of a table, from two overlapping runs of power-of-two
//! length.

use alloc::vec::Vec;
use asperity_core::Interval;

use crate::numeric::floor::floor;

/// Ranges of values and slopes over runs of 1, 2, 4, … cells from every cell: a sparse table.
///
/// Any run is the union of two of these, so its ranges need two lookups. In `f32`, rounded outward.
#[derive(Clone, Debug)]
pub struct RangeTable {
    /// Row by row, with `cells` entries per run length; the lower ends are negated, so that maxima
    /// are hulls.
    runs: Vec<[f32; 4]>,
    cells: usize,
}

impl RangeTable {
    /// Creates the table from the ranges of values and slopes of the finest cells.
    pub(crate) fn new(cells: &[[Interval; 2]]) -> Self {
        let mut runs: Vec<[f32; 4]> = cells
            .iter()
            .map(|[value, slope]| [-value.lo, value.hi, -slope.lo, slope.hi].map(outward))
            .collect();
        let (mut length, mut row) = (1, runs.clone());
        while 2 * length <= cells.len() {
            // Runs that would end behind the last cell end there.
            let partner = |i: usize| row.get(i + length).or(row.last());
            let next =
                row.iter().enumerate().map(|(i, &run)| partner(i).map_or(run, |&other| hull(run, other)));
            row = next.collect();
            runs.extend_from_slice(&row);
            length *= 2;
        }
        Self { runs, cells: cells.len() }
    }

    /// Enclosures of values and slopes over the cells from `first` to `last`.
    ///
    /// The whole line for cells that do not exist.
    #[inline(always)]
    pub(crate) fn over(&self, first: usize, last: usize) -> [Interval; 2] {
        let row = last.wrapping_sub(first).wrapping_add(1).max(1).ilog2();
        let start = row as usize * self.cells;
        let (left, right) = (start + first, (start + last + 1).wrapping_sub(1 << row));
        let (Some(&left), Some(&right)) = (self.runs.get(left), self.runs.get(right)) else {
            return [Interval::ENTIRE; 2];
        };
        let [a, b, c, d] = hull(left, right).map(f64::from);
        [Interval::new(-a, b), Interval::new(-c, d)]
    }

    /// Enclosures over a part of the domain, padded by 1e-12.
    pub(crate) fn between(&self, parts: [f64; 2]) -> [Interval; 2] {
        const LITTLE: f64 = 1e-12;
        let cells = self.cells as f64;
        let cell = |part: f64| floor((part * cells).clamp(0.0, cells - 0.5)).1;
        self.over(cell(parts[0] - LITTLE), cell(parts[1] + LITTLE))
    }

    /// Rows of runs of 1, 2, 4, … cells, with one entry per first cell of a run.
    ///
    /// An entry is the maximum of −value, value, −slope and slope.
    #[must_use]
    pub fn runs(&self) -> &[[f32; 4]] {
        &self.runs
    }

    /// Number of the finest cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// Memory.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.runs.as_slice())
    }
}

/// The smallest `f32` that is certainly not less.
fn outward(x: f64) -> f32 {
    (x as f32).next_up()
}

#[inline(always)]
fn hull(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    let most = |i: usize| if a[i] > b[i] { a[i] } else { b[i] };
    [most(0), most(1), most(2), most(3)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of lengths 1, 2, 4, … of runs among this number of cells.
    fn rows(cells: i32) -> usize {
        cells.ilog2() as usize + 1
    }

    #[test]
    fn runs_are_hulls_of_their_cells() {
        for count in [1, 2, 3, 27, 64] {
            let cells: Vec<[Interval; 2]> = (0..count)
                .map(|i| f64::from(i * 37 % 11) + 0.1)
                .map(|v| [Interval::new(-v, 2.0 - v), Interval::new(0.3 * v, v)])
                .collect();
            let table = RangeTable::new(&cells);
            assert_eq!((table.cells(), table.runs().len()), (cells.len(), cells.len() * rows(count)));
            // The first run of the last row: −value, value, −slope and slope of as many cells as
            // fit.
            let longest = 1 << (rows(count) - 1);
            let [value, slope] = table.over(0, longest - 1);
            let run = table.runs()[cells.len() * (rows(count) - 1)].map(f64::from);
            assert_eq!(run, [-value.lo, value.hi, -slope.lo, slope.hi]);
            // Parts that overlap only by rounding are a run that ends before it begins.
            assert!(table.over(1, 0).iter().all(|range| range.lo <= range.hi));
            for first in 0..cells.len() {
                for last in first..cells.len() {
                    let want = cells[first..=last]
                        .iter()
                        .fold([Interval::EMPTY; 2], |h, c| [h[0].hull(c[0]), h[1].hull(c[1])]);
                    for (got, want) in table.over(first, last).into_iter().zip(want) {
                        assert!(
                            got.lo <= want.lo && want.hi <= got.hi,
                            "{first}..={last} of {count}: {got:?} {want:?}"
                        );
                        assert!(
                            got.lo > want.lo - 1e-5 && got.hi < want.hi + 1e-5,
                            "{first}..={last} of {count}: {got:?} {want:?}"
                        );
                    }
                }
            }
        }
    }
}
