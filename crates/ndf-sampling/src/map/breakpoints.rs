//! Breakpoints of the marginal of a map: the boundaries between its formulas.

use alloc::vec::Vec;

use crate::map::disk::half_chord;
use crate::map::reconstruction::Reconstruction;

/// Breakpoints closer than this are merged.
const MERGED: f64 = 1e-12;

/// Cosine and sine of the longest piece of the rim, 2√3/1024.
///
/// Its chord is 1.43e-6 of the radius away from its arc.
const LONGEST: [f64; 2] = [0.999_994_277_959_558_5, 0.003_382_905_281_144_585_8];

/// The square of that chord: 2 − 2 cos.
const LONGEST_CHORD: f64 = 1.144_408_088_294_274_3e-5;

/// The positions, from 0 to 1, at which the rim of the disk is cut for a `width × height` map.
///
/// ```text
/// the grid's own lines;  ½ ± c(y) of its lines across;  ½;  and where these leave more, an angle of 2√3/1024 after another
/// ```
///
/// The breakpoints after ½ mirror those before it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Breakpoints {
    pub(crate) places: Vec<f64>,
    /// Half the disk's chord there.
    pub(crate) half_chords: Vec<f64>,
    /// The column of cells that contains the piece beginning there; no piece begins at the last.
    pub(crate) cells: Vec<u32>,
}

impl Breakpoints {
    pub(crate) fn new(width: usize, height: usize, kind: Reconstruction) -> Self {
        let (columns, rows) = (kind.cells(width), kind.cells(height));
        // An angle of π in pieces of maximum length, and one more for each line.
        let expected = columns + rows + 932;
        let [places, half_chords] = [(); 2].map(|()| Vec::with_capacity(expected));
        let mut breakpoints = Self { places, half_chords, cells: Vec::with_capacity(expected) };
        breakpoints.push(0.0, 0.0, 0);
        let mut across = (0..rows.div_ceil(2)).rev().map(|j| half_chord(kind.line(j, height).max(0.0)));
        let mut next_across = move || across.next().map_or(0.5, |c| 0.5 - c);
        let (mut y, mut passed) = (next_across(), 0);
        loop {
            let line = kind.line(passed + 1, width).min(0.5);
            // Breakpoints that differ by rounding alone would produce pieces without a width.
            while y < line - MERGED {
                if y > breakpoints.places.last().map_or(0.0, |&last| last + MERGED) {
                    breakpoints.extend_to(y, passed as u32);
                }
                y = next_across();
            }
            passed += usize::from(kind.line(passed + 1, width) <= 0.5);
            breakpoints.extend_to(line, passed as u32);
            if line >= 0.5 {
                break;
            }
        }
        breakpoints.mirror(width, kind);
        breakpoints
    }

    fn push(&mut self, place: f64, half_chord: f64, cell: u32) {
        self.places.push(place);
        self.half_chords.push(half_chord);
        self.cells.push(cell);
    }

    /// Adds breakpoints up to `place`, with as many in between as the rim needs.
    fn extend_to(&mut self, place: f64, cell: u32) {
        let (half_chord_there, before) = (half_chord(place), self.cells.last().copied().unwrap_or(0));
        let from = self.places.last().zip(self.half_chords.last());
        let [mut cos, mut sin] = from.map_or([1.0, 0.0], |(place, c)| [1.0 - 2.0 * place, 2.0 * c]);
        loop {
            let (dx, dy) = (cos - (1.0 - 2.0 * place), sin - 2.0 * half_chord_there);
            [cos, sin] = [cos * LONGEST[0] - sin * LONGEST[1], sin * LONGEST[0] + cos * LONGEST[1]];
            let next = 0.5 - 0.5 * cos;
            if dx * dx + dy * dy <= LONGEST_CHORD || next >= place - MERGED {
                break;
            }
            self.push(next, half_chord(next), before);
        }
        self.push(place, half_chord_there, cell);
    }

    /// Continues breakpoints that end at ½.
    fn mirror(&mut self, width: usize, kind: Reconstruction) {
        let (count, cells) = (self.places.len(), kind.cells(width));
        for k in (1..count).rev() {
            let at = [k - 1, k].map(|k| self.cells.get(k).copied().unwrap_or(0) as usize);
            // Where a column begins, the mirrored one ends.
            let before = self.places.get(k - 1).copied().unwrap_or(0.0);
            let is_line = k >= 2 && self.cells.get(k - 2).is_some_and(|&cell| (cell as usize) < at[0]);
            let place = if is_line { kind.line(cells - at[0], width) } else { 1.0 - before };
            if let Some(cell) = self.cells.get_mut(self.places.len() - 1) {
                *cell = (cells - 1 - at[0]) as u32;
            }
            let half_chord = self.half_chords.get(k - 1).copied().unwrap_or(0.0);
            self.push(place, half_chord, 0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    const KINDS: [Reconstruction; 2] = [Reconstruction::Constant, Reconstruction::Bilinear];

    #[test]
    fn breakpoints_increase_with_bounded_spacing() {
        for (width, height) in [(1, 1), (2, 2), (10, 7), (64, 256), (5, 5), (256, 256)] {
            for kind in KINDS {
                let Breakpoints { places, half_chords, .. } = Breakpoints::new(width, height, kind);
                assert_eq!((places.first(), places.last()), (Some(&0.0), Some(&1.0)));
                for (x, c) in places.windows(2).zip(half_chords.windows(2)) {
                    let (dx, dy) = (x[1] - x[0], c[1] - c[0]);
                    // The distance from chord to arc of a circle of radius ½, per radius.
                    let distance = (dx * dx + dy * dy) / 2.0;
                    assert!(dx > 0.0 && distance < 1.4306e-6, "{width} × {height}: {x:?} {distance:e}");
                }
                for (&x, &c) in places.iter().zip(&half_chords) {
                    assert_abs_diff_eq!(half_chord(x), c, epsilon = 1e-13, "{width} × {height}");
                }
            }
        }
    }

    #[test]
    fn pieces_lie_in_one_column_and_one_row_of_chord_ends() {
        for (width, height) in [(1, 1), (2, 3), (10, 7), (64, 256), (93, 49), (256, 256)] {
            for kind in KINDS {
                let Breakpoints { places, half_chords, cells } = Breakpoints::new(width, height, kind);
                for k in 1..places.len() {
                    let cell = kind.cell(places[k - 1], width);
                    assert_eq!(cells[k - 1] as usize, cell, "{width} × {height} {k}");
                    let line = kind.line(cell + 1, width);
                    assert!(places[k] <= line, "{width} × {height}: {line} after {}", places[k - 1]);
                    // Ends of chords on a line, to rounding.
                    let ends = [half_chords[k - 1], half_chords[k]]
                        .map(|c| c * height as f64 + 0.5 * kind.cells(height) as f64);
                    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                    assert!(high <= (low + 1e-6).floor() + 1.0 + 1e-6, "{width} × {height}: {ends:?}");
                }
            }
        }
    }
}
