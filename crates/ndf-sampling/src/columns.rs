//! The columns of a map: their values along y and the integrals of these.

use alloc::vec;
use alloc::vec::Vec;

use crate::reconstruction::Reconstruction;
use crate::sum::Sum;

/// Values along y, and for every line of the grid their integral from the middle of the map, in cells.
///
/// Integrals begin in the middle because every chord of the disk does: what lies beyond a chord's ends, be it a million times
/// brighter, is never subtracted from what lies on it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Columns {
    width: usize,
    height: usize,
    kind: Reconstruction,
    /// Column by column; bilinear columns repeat their first and their last value.
    values: Vec<f32>,
    sums: Vec<f64>,
}

/// What a column of cells has on its left and right side.
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
    /// How many values a column of `height` texels has.
    pub(crate) const fn stride(kind: Reconstruction, height: usize) -> usize {
        match kind {
            Reconstruction::Constant => height,
            Reconstruction::Bilinear => height + 2,
        }
    }

    /// The columns of `values`, of [`Columns::stride`] each.
    pub(crate) fn new(width: usize, height: usize, kind: Reconstruction, values: Vec<f32>) -> Self {
        let rows = kind.cells(height);
        let mut sums = vec![0.0; width * (rows + 1)];
        let stride = Self::stride(kind, height);
        for (sums, values) in sums.chunks_exact_mut(rows + 1).zip(values.chunks_exact(stride)) {
            let ends = values.get(stride - rows..).unwrap_or_default();
            integrate(sums, values, ends, 0.5 * height as f64 + kind.offset());
        }
        Self { width, height, kind, values, sums }
    }

    pub(crate) const fn width(&self) -> usize {
        self.width
    }

    pub(crate) const fn height(&self) -> usize {
        self.height
    }

    pub(crate) const fn kind(&self) -> Reconstruction {
        self.kind
    }

    /// A column's integrals, a line's after another's.
    pub(crate) fn sums(&self, column: usize) -> &[f64] {
        let lines = self.kind.cells(self.height) + 1;
        self.sums.get(column * lines..(column + 1) * lines).unwrap_or_default()
    }

    /// A column's values with one before and one after.
    pub(crate) fn padded(&self, column: usize) -> impl Iterator<Item = f32> {
        let stride = Self::stride(self.kind, self.height);
        let values = self.values.get(column * stride..(column + 1) * stride).unwrap_or_default();
        let rest = (self.height + 2).saturating_sub(stride);
        values.iter().copied().chain(core::iter::repeat_n(0.0, rest))
    }

    /// The sides of a column of cells.
    pub(crate) fn strip(&self, cell: usize) -> Strip<'_> {
        let (left, right, step) = match self.kind {
            Reconstruction::Constant => (cell, cell, 0),
            Reconstruction::Bilinear => (cell.saturating_sub(1), cell.min(self.width - 1), 1),
        };
        let (lines, stride) = (self.kind.cells(self.height) + 1, Self::stride(self.kind, self.height));
        let sums = |column: usize| self.sums.get(column * lines..(column + 1) * lines).unwrap_or_default();
        let values =
            |column: usize| self.values.get(column * stride..(column + 1) * stride).unwrap_or_default();
        Strip { sums: [sums(left), sums(right)], values: [values(left), values(right)], step }
    }

    /// The value at a point of the map.
    pub(crate) fn value(&self, [x, y]: [f64; 2]) -> f64 {
        let (column, row) = (self.kind.cell(x, self.width), self.kind.cell(y, self.height));
        let along =
            |x: f64, n: usize, cell: usize| (x * n as f64 + self.kind.offset() - cell as f64).clamp(0.0, 1.0);
        let corners = self.strip(column).corners(row);
        value(corners, along(x, self.width, column), along(y, self.height, row))
    }
}

impl Strip<'_> {
    /// The integral to a line of the grid, `t` of the way from left to right.
    ///
    /// It does not decrease from line to line, and not at all where there is no weight: products and the sum round alike.
    #[inline]
    pub(crate) fn sum(self, t: f64, line: usize) -> f64 {
        let [left, right] = self.sums.map(|sums| sums.get(line).copied().unwrap_or(0.0));
        mix(left, right, t)
    }

    /// The integrals to four lines from `line` on.
    #[inline]
    pub(crate) fn sums_from(self, t: f64, line: usize) -> Option<[f64; 4]> {
        let [left, right] = self.sums.map(|sums| sums.get(line..).and_then(|sums| sums.first_chunk::<4>()));
        let (left, right) = (left?, right?);
        Some([0, 1, 2, 3].map(|k| mix(left[k], right[k], t)))
    }

    /// The integrals to a line of the grid on both sides.
    pub(crate) fn sums(self, line: usize) -> [f64; 2] {
        self.sums.map(|sums| sums.get(line).copied().unwrap_or(0.0))
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

/// Fills in the integrals from `middle`, which counts cells, to each line.
fn integrate(sums: &mut [f64], begins: &[f32], ends: &[f32], middle: f64) {
    let cell = (middle as usize).min(sums.len().saturating_sub(2));
    // The middle of the map is on a line or in the middle of a cell.
    let below = middle - cell as f64;
    let above = 1.0 - below;
    let at = |values: &[f32]| values.get(cell).map_or(0.0, |&value| f64::from(value));
    let (a, b) = (at(begins), at(ends));
    let mut sum = Sum::default();
    sum.add(above * (0.5 * above * a + (1.0 - 0.5 * above) * b));
    let upper = begins.iter().zip(ends).skip(cell + 1);
    for (line, (&a, &b)) in sums.iter_mut().skip(cell + 1).zip(upper.chain([(&0.0, &0.0)])) {
        *line = sum.value();
        sum.add(0.5 * (f64::from(a) + f64::from(b)));
    }
    let mut sum = Sum::default();
    sum.add(-below * ((1.0 - 0.5 * below) * a + 0.5 * below * b));
    let lower = begins.iter().zip(ends).take(cell).rev();
    for (line, (&a, &b)) in sums.iter_mut().take(cell + 1).rev().zip(lower.chain([(&0.0, &0.0)])) {
        *line = sum.value();
        sum.add(-0.5 * (f64::from(a) + f64::from(b)));
    }
}
