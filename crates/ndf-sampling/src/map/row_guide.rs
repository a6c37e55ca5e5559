//! A guide table to the rows of a map's conditional quantiles.

use alloc::vec;
use alloc::vec::Vec;

use crate::map::columns::Columns;
use crate::map::disk::half_chord;
use crate::map::prefix_sums::WINDOW;

/// For each column of cells and each of equal parts of [0, 1] a line of the grid from which to look for the conditional's quantile.
///
/// In the middle of the column the quantile is in one of the next lines, O(1) windows of them on average. The column's other
/// places have other quantiles, so what is found is checked.
///
/// Chen and Asau 1974, "On Generating Random Variates from an Empirical Distribution", over every sixteenth line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RowGuide {
    /// Parts of a column.
    parts: usize,
    /// Which window of lines; one more for what is beyond the chord.
    windows: Vec<u32>,
}

impl RowGuide {
    pub(crate) fn new(columns: &Columns) -> Self {
        let (width, kind) = (columns.width, columns.kind);
        let parts = 2 * kind.cells(columns.height).div_ceil(WINDOW);
        let mut windows = vec![0; kind.cells(width) * (parts + 1)];
        for (cell, windows) in windows.chunks_exact_mut(parts + 1).enumerate() {
            let ends = [cell, cell + 1].map(|line| kind.line(line, width).clamp(0.0, 1.0));
            let [(_, from), (_, to)] = columns.chord(cell, half_chord(0.5 * (ends[0] + ends[1])));
            if to <= from {
                continue;
            }
            let scale = parts as f64 / (to - from);
            let [left, right] = columns.landmarks(cell);
            for (left, right) in left.iter().zip(right).skip(1) {
                // The first part that begins after the line; what is before the chord is before every part.
                let part = (0.5 * (left + right) - from) * scale + 1.0;
                if let Some(count) = windows.get_mut((part as u32 as usize).min(parts)) {
                    *count += 1;
                }
            }
            let mut passed = 0;
            for count in windows {
                passed += *count;
                *count = passed;
            }
        }
        Self { parts, windows }
    }

    /// The line from which to look for the quantile `u` of a column.
    #[inline]
    pub(crate) fn line(&self, cell: usize, u: f64) -> usize {
        let part = (u * self.parts as f64) as usize;
        self.windows.get(cell * (self.parts + 1) + part).map_or(0, |&window| window as usize * WINDOW)
    }
}

/// The last of the rows from `first` to `last` whose beginning is `below` the target, looked for from `guess` on.
#[inline]
pub(crate) fn row_of(below: impl Fn(usize) -> bool, [first, last]: [usize; 2], guess: usize) -> usize {
    // Row `low` begins below, row `high` does not.
    let (mut low, mut high, mut row) = (first, last + 1, guess.clamp(first, last));
    for _ in 0..4 {
        if row > low && !below(row) {
            high = row;
            row -= 1;
        } else if row + 1 < high && below(row + 1) {
            low = row + 1;
            row += 1;
        } else {
            return row;
        }
    }
    while high - low > 1 {
        let middle = low.midpoint(high);
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::reconstruction::Reconstruction;
    use crate::map::texels::{Measure, columns_of_texels};

    #[test]
    fn quantiles_of_a_column_are_found_in_two_windows_on_average() {
        let steep = |i: usize, j: usize| (0.02 * i as f32 - 0.1 * j as f32).exp2();
        let islands = |_: usize, j: usize| f32::from(j % 100 == 40);
        let images: [&dyn Fn(usize, usize) -> f32; 3] = [&|_, _| 1.0, &steep, &islands];
        let (width, height) = (5, 300);
        let kinds = [Reconstruction::Constant, Reconstruction::Bilinear];
        for (image, kind) in images.iter().flat_map(|image| kinds.map(|kind| (image, kind))) {
            let texels: Vec<f32> = (0..width * height).map(|k| image(k % width, k / width)).collect();
            let columns = columns_of_texels(width, height, &texels, Measure::Normals, kind).unwrap();
            let guide = RowGuide::new(&columns);
            for cell in 0..kind.cells(width) {
                let strip = columns.strip(cell);
                let sides = [cell, cell + 1].map(|line| kind.line(line, width).clamp(0.0, 1.0));
                let c = half_chord(0.5 * (sides[0] + sides[1]));
                let [(_, from), (_, to)] = columns.chord(cell, c);
                let (mut windows, draws) = (0, 1000);
                for k in 0..draws {
                    let u = (f64::from(k) + 0.5) / f64::from(draws);
                    let line = guide.line(cell, u);
                    let target = from + (to - from) * u;
                    let row = (0..kind.cells(height)).rfind(|&row| strip.sum(0.5, row) <= target).unwrap();
                    assert!(line <= row, "{cell} {u}: {line} is beyond {row}");
                    windows += 1 + (row - line) / WINDOW;
                }
                assert!(windows <= 2 * draws as usize || to <= from, "{cell}: {windows}");
            }
        }
    }
}
