//! The columns of a map: their values along y and the integrals of these.

use crate::map::prefix_sums::{PrefixSums, WINDOW};
use crate::map::reconstruction::Reconstruction;

/// Values along y, and for every line of the grid their integral from the middle of the map, in cells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Columns {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) kind: Reconstruction,
    pub(crate) integrals: PrefixSums,
}

/// Values and integrals on the left and right side of a column of cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip<'a> {
    sums: [&'a [f64]; 2],
    values: [&'a [f32]; 2],
    /// From a row's value at its beginning to that at its end.
    step: usize,
}

/// The values at a cell's corners: on its left and on its right side, each at its beginning and its end along y.
pub(crate) type Corners = [[f64; 2]; 2];

impl Columns {
    /// Number of values of a column.
    const fn stride(&self) -> usize {
        match self.kind {
            Reconstruction::Constant => self.height,
            Reconstruction::Bilinear => self.height + 2,
        }
    }

    /// A column's integrals, a line's after another's.
    pub(crate) fn sums(&self, column: usize) -> &[f64] {
        let lines = self.kind.cells(self.height) + 1;
        self.integrals.sums.get(column * lines..(column + 1) * lines).unwrap_or_default()
    }

    /// A column's values, one after another.
    pub(crate) fn values(&self, column: usize) -> &[f32] {
        let stride = self.stride();
        self.integrals.values.get(column * stride..(column + 1) * stride).unwrap_or_default()
    }

    /// The values at a cell's corners, and the integrals to a line on its column's sides.
    #[inline(always)]
    pub(crate) fn at(&self, cell: usize, row: usize, line: usize) -> (Corners, [f64; 2]) {
        let PrefixSums { values, sums, .. } = &self.integrals;
        let (stride, lines) = (self.stride(), self.kind.cells(self.height) + 1);
        let sum = |column: usize| sums.get(column * lines + line).copied().unwrap_or(0.0);
        match self.kind {
            Reconstruction::Constant => {
                let value = values.get(cell * stride + row).map_or(0.0, |&value| f64::from(value));
                ([[value; 2]; 2], [sum(cell); 2])
            }
            Reconstruction::Bilinear => {
                let side = |column: usize| match values.get(column * stride + row..) {
                    Some(&[begin, end, ..]) => [f64::from(begin), f64::from(end)],
                    _ => [0.0; 2],
                };
                let sides = self.sides(cell);
                (sides.map(side), sides.map(sum))
            }
        }
    }

    /// On the two sides of a column of cells the integrals to every [`WINDOW`]th line.
    pub(crate) fn landmarks(&self, cell: usize) -> [&[f64]; 2] {
        let count = (self.kind.cells(self.height) + 1).div_ceil(WINDOW);
        self.sides(cell).map(|column| {
            self.integrals.landmarks.get(column * count..(column + 1) * count).unwrap_or_default()
        })
    }

    /// The columns to the left and to the right of a column of cells.
    const fn sides(&self, cell: usize) -> [usize; 2] {
        match self.kind {
            Reconstruction::Constant => [cell; 2],
            Reconstruction::Bilinear => {
                [cell.saturating_sub(1), if cell < self.width { cell } else { self.width - 1 }]
            }
        }
    }

    /// The sides of a column of cells.
    pub(crate) fn strip(&self, cell: usize) -> Strip<'_> {
        let step = usize::from(self.kind == Reconstruction::Bilinear);
        let sides = self.sides(cell);
        Strip {
            sums: sides.map(|column| self.sums(column)),
            values: sides.map(|column| self.values(column)),
            step,
        }
    }

    /// Ends of the chord `½ ± c`, in cells, and the integrals to there along the middle of a column of cells.
    pub(crate) fn chord(&self, cell: usize, c: f64) -> [(f64, f64); 2] {
        let (strip, last) = (self.strip(cell), self.kind.cells(self.height) - 1);
        [0.5 - c, 0.5 + c].map(|y| {
            let end = y * self.height as f64 + self.kind.offset();
            let row = (end as usize).min(last);
            let [begin, next] = [row, row + 1].map(|line| strip.sum(0.5, line));
            (end, begin + (next - begin) * (end - row as f64))
        })
    }

    /// The value at a point of the map.
    #[inline]
    pub(crate) fn value(&self, [x, y]: [f64; 2]) -> f64 {
        let (column, row) = (self.kind.cell(x, self.width), self.kind.cell(y, self.height));
        let along =
            |x: f64, n: usize, cell: usize| (x * n as f64 + self.kind.offset() - cell as f64).clamp(0.0, 1.0);
        let corners = self.strip(column).corners(row);
        value(corners, along(x, self.width, column), along(y, self.height, row))
    }
}

impl<'a> Strip<'a> {
    /// The integral to a line of the grid, `t` of the way from left to right.
    ///
    /// It does not decrease from line to line, and not at all where there is no weight: products and the sum round alike.
    #[inline]
    pub(crate) fn sum(self, t: f64, line: usize) -> f64 {
        let [left, right] = self.sums.map(|sums| sums.get(line).copied().unwrap_or(0.0));
        mix(left, right, t)
    }

    /// Number of the [`WINDOW`] lines from `line` on have integrals of at most `target`; nothing if there are not as many lines.
    #[inline]
    pub(crate) fn passed(self, t: f64, line: usize, target: f64) -> Option<usize> {
        let [left, right] =
            self.sums.map(|sums| sums.get(line..).and_then(|sums| sums.first_chunk::<WINDOW>()));
        let (left, right) = (left?, right?);
        let counts: [u64; WINDOW] = core::array::from_fn(|k| u64::from(mix(left[k], right[k], t) <= target));
        Some(counts.iter().sum::<u64>() as usize)
    }

    #[inline]
    pub(crate) fn corners(self, row: usize) -> Corners {
        self.values.map(|values| {
            [row, row + self.step].map(|k| values.get(k).map_or(0.0, |&value| f64::from(value)))
        })
    }

    /// A row's values at its beginning and its end, `t` of the way from left to right.
    #[inline]
    pub(crate) fn row(self, t: f64, row: usize) -> [f64; 2] {
        let [left, right] = self.corners(row);
        [mix(left[0], right[0], t), mix(left[1], right[1], t)]
    }
}

/// `a` at t = 0, `b` at t = 1.
#[inline]
pub(crate) fn mix(a: f64, b: f64, t: f64) -> f64 {
    (1.0 - t) * a + t * b
}

/// The bilinear value in a cell.
#[inline]
pub(crate) fn value([left, right]: Corners, t: f64, q: f64) -> f64 {
    mix(mix(left[0], left[1], q), mix(right[0], right[1], q), t)
}
