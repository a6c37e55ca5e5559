//! From the texels of an image to the columns of a map: checked, weighed and continued beyond the disk.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use crate::columns::Columns;
use crate::disk::{mean_secant, meets, to_normal};
use crate::map::{Measure, NdfMapError};
use crate::reconstruction::Reconstruction;

/// Columns that are copied together: a cache line of texels.
const BLOCK: usize = 16;

/// The columns of an image's texels.
///
/// Texels without a part inside the disk are not read. Constant columns have 0 there; bilinear ones have the value of the
/// column's nearest texel with a part inside, so that what is outside does not show within.
pub(crate) fn columns_of_texels(
    width: usize,
    height: usize,
    texels: &[f32],
    measure: Measure,
    kind: Reconstruction,
) -> Result<Vec<f32>, NdfMapError> {
    let stride = Columns::stride(kind, height);
    let first = (stride - height) / 2;
    let inside: Vec<Range<usize>> = (0..height).map(|j| meeting(j, height, width)).collect();
    let mut columns = vec![0.0_f32; width * stride];
    let mut sound = true;
    for (block, columns) in columns.chunks_mut(BLOCK * stride).enumerate() {
        let from = block * BLOCK;
        for (j, (row, inside)) in texels.chunks_exact(width).zip(&inside).enumerate() {
            let (begin, end) = (inside.start.max(from), inside.end.min(from + BLOCK));
            let row = row.get(begin..end).unwrap_or_default();
            let targets =
                columns.get_mut((begin.max(from) - from) * stride + first + j..).unwrap_or_default();
            for (to, &value) in targets.iter_mut().step_by(stride).zip(row) {
                sound &= (0.0..f32::INFINITY).contains(&value);
                *to = value;
            }
        }
    }
    if !sound {
        return Err(culprit(width, texels, &inside));
    }
    if measure == Measure::SolidAngle {
        for (i, column) in columns.chunks_exact_mut(stride).enumerate() {
            for (j, value) in column.iter_mut().skip(first).take(height).enumerate() {
                let secant = mean_secant(texel_edges(i, width), texel_edges(j, height));
                *value = ((f64::from(*value) * secant) as f32).min(f32::MAX);
            }
        }
    }
    if kind == Reconstruction::Bilinear {
        for (i, column) in columns.chunks_exact_mut(stride).enumerate() {
            let inside = meeting(i, width, height);
            extend(column, inside.start + first..inside.end + first);
        }
    }
    Ok(columns)
}

/// The first texel inside the disk that is not finite or negative.
fn culprit(width: usize, texels: &[f32], inside: &[Range<usize>]) -> NdfMapError {
    let rows = texels.chunks_exact(width).zip(inside).enumerate();
    let mut all = rows.flat_map(|(j, (row, inside))| {
        row.iter()
            .enumerate()
            .take(inside.end)
            .skip(inside.start)
            .map(move |(i, &value)| (j * width + i, value))
    });
    match all.find(|(_, value)| !(*value >= 0.0 && value.is_finite())) {
        Some((index, value)) if value.is_finite() => NdfMapError::Negative { index, value },
        Some((index, value)) => NdfMapError::NotFinite { index, value },
        None => NdfMapError::AllBlack { width, height: inside.len() },
    }
}

/// Continues a column's values inside the disk to its ends.
fn extend(column: &mut [f32], inside: Range<usize>) {
    let at = |k: usize| column.get(k).copied().unwrap_or(0.0);
    let (first, last) = (at(inside.start), at(inside.end.saturating_sub(1)));
    column.iter_mut().take(inside.start).for_each(|value| *value = first);
    column.iter_mut().skip(inside.end).for_each(|value| *value = last);
}

/// Which of the `count` texels of a line, the `index`th of `lines`, have a part inside the disk.
fn meeting(index: usize, lines: usize, count: usize) -> Range<usize> {
    let edges = texel_edges(index, lines);
    let meets = |k: usize| meets(edges, texel_edges(k, count));
    // Half of them, the others mirror these: those from the middle outward to the last that meets.
    let (mut low, mut high) = (count / 2, count);
    while low < high {
        let middle = low.midpoint(high);
        if meets(middle) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    count - low..low
}

/// Whether the texel has a part inside the disk.
pub(crate) fn texel_meets(column: usize, width: usize, row: usize, height: usize) -> bool {
    meets(texel_edges(column, width), texel_edges(row, height))
}

/// The normal coordinates of a texel's two edges along one axis.
pub(crate) fn texel_edges(index: usize, count: usize) -> [f64; 2] {
    [index, index + 1].map(|k| to_normal(k as f64 / count as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_of_a_line_are_those_that_meet() {
        for (lines, count) in [(1, 1), (2, 3), (10, 10), (7, 64), (33, 5)] {
            for index in 0..lines {
                let found = meeting(index, lines, count);
                for k in 0..count {
                    let expected = texel_meets(k, count, index, lines);
                    assert_eq!(found.contains(&k), expected, "{index} of {lines}, {k} of {count}");
                }
            }
        }
    }

    #[test]
    fn what_is_outside_does_not_show_within() {
        let mut texels = [1.0; 100];
        for corner in [0, 9, 90, 99] {
            texels[corner] = f32::NAN;
        }
        let columns = columns_of_texels(10, 10, &texels, Measure::Normals, Reconstruction::Bilinear).unwrap();
        assert!(columns.iter().all(|&value| value == 1.0));
    }
}
