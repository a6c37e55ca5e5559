//! Rows of conditional quantiles, from which a search begins.

use alloc::vec::Vec;

use crate::map::columns::Columns;
use crate::map::disk::half_chord;

/// Rows of a column that share an entry.
const ROWS: usize = 4;

/// For each column of cells the rows of even quantiles of the conditional in the column's middle.
///
/// They are guesses: the column's other places have other quantiles, and what is found with them is checked.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Quantiles {
    /// Entries of a column, less one.
    pub(crate) parts: usize,
    /// A column's after another's.
    pub(crate) rows: Vec<f32>,
}

impl Quantiles {
    pub(crate) fn new(columns: &Columns) -> Self {
        let (width, height, kind) = (columns.width, columns.height, columns.kind);
        let (cells, last) = (kind.cells(width), kind.cells(height) - 1);
        let parts = height.div_ceil(ROWS);
        let mut rows = Vec::with_capacity(cells * (parts + 1));
        for column in 0..cells {
            let strip = columns.strip(column);
            let c = half_chord((kind.line(column, width) + 0.5 / width as f64).clamp(0.0, 1.0));
            let [(first, from), (end, to)] = columns.chord(column, c);
            let chord = [first, end].map(|end| (end as usize).min(last));
            for part in 0..=parts {
                let target = from + (to - from) * (part as f64 / parts as f64);
                // A column is much like the one before it.
                let before = rows.len().checked_sub(parts + 1).and_then(|k| rows.get(k));
                let guess = before.map_or(0, |&row: &f32| row as usize);
                let row = row_of(|row| strip.sum(0.5, row) <= target, chord, guess);
                let [begin, next] = [row, row + 1].map(|line| strip.sum(0.5, line));
                let within =
                    if next > begin { ((target - begin) / (next - begin)).clamp(0.0, 1.0) } else { 0.0 };
                rows.push((row as f64 + within).min(end) as f32);
            }
        }
        Self { parts, rows }
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
