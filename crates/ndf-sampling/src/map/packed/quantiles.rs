//! Rows of conditional quantiles, the starting points of searches.

use alloc::vec;

use crate::map::disk::half_chord;
use crate::map::packed::layout::Layout;

/// Rows of a column that share an entry.
pub(crate) const ROWS: usize = 2;

/// 2²³: from here on the lowest bits of a float are an integer.
const SHIFT: f32 = 8_388_608.0;

/// Stores, for each column of cells, the rows of evenly spaced quantiles in the middle of the
/// column.
///
/// They are guesses, because other positions in the column have other quantiles. Each result is
/// checked.
pub(crate) fn fill(layout: &Layout, nodes: &[f32], quantiles: &mut [f32]) {
    let Layout { width, height, kind, quantiles: parts, .. } = *layout;
    let (rows, sides, stride) = (kind.cells(height), kind.sides(), layout.stride());
    let [mut lines, mut places, mut steps] = [(); 3].map(|()| vec![0.0_f32; rows + 1]);
    let mut firsts = vec![0; rows + 1];
    let columns = nodes.chunks_exact(stride).zip(nodes.chunks_exact(stride).skip(sides - 1));
    for (cell, ((left, right), quantiles)) in columns.zip(quantiles.chunks_exact_mut(parts + 1)).enumerate() {
        match sides {
            1 => lines.iter_mut().zip(left).for_each(|(line, sum)| *line = *sum),
            _ => {
                let nodes = left.as_chunks::<2>().0.iter().zip(right.as_chunks::<2>().0);
                lines
                    .iter_mut()
                    .zip(nodes)
                    .for_each(|(line, (left, right))| *line = 0.5 * (left[0] + right[0]));
            }
        }
        // The ends of the chord in rows, and the integrals up to them.
        let chord = height as f64 * half_chord((kind.line(cell, width) + 0.5 / width as f64).clamp(0.0, 1.0));
        let ends = [-chord, chord].map(|c| (0.5 * height as f64 + kind.offset() + c) as f32);
        let [from, to] = ends.map(|end| {
            let row = (end as usize).min(rows - 1);
            lines[row] + (lines[row + 1] - lines[row]) * (end - row as f32)
        });
        if to <= from {
            continue;
        }
        to_quantiles(&mut lines, from, parts as f32 / (to - from), parts as f32);
        find_firsts(&lines, &mut firsts, &mut places, &mut steps);
        quantiles.fill(ends[1]);
        let rows = firsts.array_windows().zip(places.iter().zip(&steps));
        for (&[first, next], (&place, &step)) in rows {
            let (first, next) = (first as usize, next as usize);
            // Writes without checking the count, because later rows overwrite the entries.
            if let Some([a, b]) = quantiles.get_mut(first..first + 2).and_then(|two| two.as_mut_array()) {
                (*a, *b) = (place, place + step);
            }
            if next > first + 2 {
                let mut place = place + step;
                for quantile in quantiles.get_mut(first + 2..next.min(parts)).unwrap_or_default() {
                    place += step;
                    *quantile = place;
                }
            }
        }
        for quantile in quantiles {
            *quantile = if *quantile < ends[1] { *quantile } else { ends[1] };
        }
    }
}

/// Converts integrals up to lines to quantiles, clamping those before the first and after the last.
fn to_quantiles(lines: &mut [f32], from: f32, scale: f32, last: f32) {
    for line in lines {
        let quantile = (*line - from) * scale;
        let quantile = if quantile > 0.0 { quantile } else { 0.0 };
        *line = if quantile < last { quantile } else { last };
    }
}

/// For each row the first quantile at or after it, its position, and the step to the next, in rows.
fn find_firsts(lines: &[f32], firsts: &mut [u32], places: &mut [f32], steps: &mut [f32]) {
    let rows = lines.iter().zip(lines.get(1..).unwrap_or_default()).zip(0_i32..);
    let results = firsts.iter_mut().zip(places).zip(steps);
    for (((first, place), step), ((&begin, &end), row)) in results.zip(rows) {
        let shifted = begin + 0.5 + SHIFT;
        *first = shifted.to_bits() - SHIFT.to_bits();
        *step = 1.0 / (end - begin);
        *place = row as f32 + (shifted - SHIFT - begin) * *step;
    }
}
