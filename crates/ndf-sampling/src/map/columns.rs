//! The columns of a map: their values along y and the integrals of the values.

use crate::map::prefix_sums::PrefixSums;
use crate::map::reconstruction::Reconstruction;

/// Values along y, and their integral from the middle of the map to each grid line, in cells.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Columns {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) kind: Reconstruction,
    pub(crate) integrals: PrefixSums,
}

/// The values at the corners of a cell: on its left and its right side, each at its beginning and
/// end along y.
pub(crate) type Corners = [[f64; 2]; 2];

impl Columns {
    /// Number of values of a column.
    const fn stride(&self) -> usize {
        match self.kind {
            Reconstruction::Constant => self.height,
            Reconstruction::Bilinear => self.height + 2,
        }
    }

    /// The integrals of a column, line by line.
    pub(crate) fn sums(&self, column: usize) -> &[f64] {
        let lines = self.kind.cells(self.height) + 1;
        self.integrals.sums.get(column * lines..(column + 1) * lines).unwrap_or_default()
    }

    /// The values of a column in order.
    pub(crate) fn values(&self, column: usize) -> &[f32] {
        let stride = self.stride();
        self.integrals.values.get(column * stride..(column + 1) * stride).unwrap_or_default()
    }

    /// The values at the corners of a cell, and the integrals to a line on both sides of its
    /// column.
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

    /// The columns of values to the left and to the right of a column of cells.
    const fn sides(&self, cell: usize) -> [usize; 2] {
        match self.kind {
            Reconstruction::Constant => [cell; 2],
            Reconstruction::Bilinear => {
                [cell.saturating_sub(1), if cell < self.width { cell } else { self.width - 1 }]
            }
        }
    }
}

/// `a` at t = 0, `b` at t = 1.
#[inline]
pub(crate) fn mix(a: f64, b: f64, t: f64) -> f64 {
    (1.0 - t) * a + t * b
}
