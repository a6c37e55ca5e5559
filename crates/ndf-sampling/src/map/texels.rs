//! From the texels of an image to the columns of a map: validated, weighted and extended beyond the
//! disk.

use alloc::borrow::Cow;
use alloc::vec;
use alloc::vec::Vec;

use crate::error::{IS_DENSITY, NdfError};
use crate::map::columns::Columns;
use crate::map::disk::{mean_secant, meets, to_normal};
use crate::map::prefix_sums::{Image, PrefixSums};
use crate::map::reconstruction::Reconstruction;

/// The measure over which texel values are densities: projected normals or solid angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Measure {
    /// Over the projected normal, per `dn_x dn_y`. The value is `D` itself, as obtained by counting
    /// the normals of a bump map that is sampled uniformly over the macro surface.
    ProjectedSolidAngle,
    /// Over solid angle, per `dω = dn_x dn_y/cos θ`. `D` is the value over `cos θ`, so a constant
    /// image has normals uniform on the hemisphere. The weight of each texel is kept exactly; `D`
    /// is its mean over the texel.
    SolidAngle,
}

/// The columns of the texels of an image.
///
/// Texels that do not overlap the disk are ignored. Constant columns have 0 there. Bilinear columns
/// have the value of the nearest texel of the column that overlaps the disk, so that texels outside
/// do not affect the inside.
pub(crate) fn columns_of_texels(
    width: usize,
    height: usize,
    texels: &[f32],
    measure: Measure,
    kind: Reconstruction,
) -> Result<Columns, NdfError> {
    let inside = rows_inside(width, height);
    let counted = match measure {
        Measure::ProjectedSolidAngle => Cow::Borrowed(texels),
        Measure::SolidAngle => Cow::Owned(weighed(width, height, texels)),
    };
    let image = Image { width, height, texels: &counted, inside: &inside };
    match PrefixSums::new(image, kind) {
        Some(integrals) => Ok(Columns { width, height, kind, integrals }),
        None => Err(first_invalid(width, texels, &inside)),
    }
}

/// Converts texels over solid angle to texels over projected normals; invalid ones are unchanged.
fn weighed(width: usize, height: usize, texels: &[f32]) -> Vec<f32> {
    let secant = |k: usize| mean_secant(texel_edges(k % width, width), texel_edges(k / width, height));
    let weigh = |(k, &value): (usize, &f32)| {
        if is_density(value) { ((f64::from(value) * secant(k)) as f32).min(f32::MAX) } else { value }
    };
    texels.iter().enumerate().map(weigh).collect()
}

fn is_density(value: f32) -> bool {
    (0.0..f32::INFINITY).contains(&value)
}

/// The first texel inside the disk that is not finite or negative.
fn first_invalid(width: usize, texels: &[f32], inside: &[[u32; 2]]) -> NdfError {
    let rows = texels.chunks_exact(width).enumerate();
    let mut counted = rows.flat_map(|(j, row)| {
        let counts = move |rows: &[u32; 2]| (rows[0]..rows[1]).contains(&(j as u32));
        let places = row.iter().zip(inside).enumerate().filter(move |(_, (_, rows))| counts(rows));
        places.map(move |(i, (&value, _))| (j * width + i, value))
    });
    match counted.find(|&(_, value)| !is_density(value)) {
        Some((index, value)) => NdfError::Element { parameter: "texels", index, value, rule: IS_DENSITY },
        None => NdfError::NoWeight { parameter: "texels" },
    }
}

/// For each column the first row that overlaps the disk, and the one after the last.
pub(crate) fn rows_inside(width: usize, height: usize) -> Vec<[u32; 2]> {
    let mut inside = vec![[0, height as u32]; width];
    let (left, right) = inside.split_at_mut(width / 2);
    let middle = left.len();
    narrow(right.iter_mut().enumerate().map(|(k, rows)| (texel_edges(middle + k, width), rows)), height);
    narrow(left.iter_mut().enumerate().map(|(k, rows)| (texel_edges(k, width), rows)).rev(), height);
    inside
}

/// Narrows the rows of columns from the middle outward: each has at most as many as the one before.
fn narrow<'a>(columns: impl Iterator<Item = ([f64; 2], &'a mut [u32; 2])>, height: usize) {
    let mut end = height;
    for (column, rows) in columns {
        // Half of them; the others mirror these.
        while end > height / 2 + 1 && !meets(column, texel_edges(end - 1, height)) {
            end -= 1;
        }
        *rows = [(height - end) as u32, end as u32];
    }
}

/// Whether the texel overlaps the disk.
pub(crate) fn texel_meets(column: usize, width: usize, row: usize, height: usize) -> bool {
    meets(texel_edges(column, width), texel_edges(row, height))
}

/// The normal coordinates of the two edges of a texel along one axis.
pub(crate) fn texel_edges(index: usize, count: usize) -> [f64; 2] {
    [index, index + 1].map(|k| to_normal(k as f64 / count as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_inside_matches_texel_meets() {
        for (width, height) in [(1, 1), (2, 3), (10, 10), (7, 64), (33, 5), (20, 4), (5, 1)] {
            for (i, rows) in rows_inside(width, height).into_iter().enumerate() {
                for j in 0..height {
                    let expected = texel_meets(i, width, j, height);
                    let found = (rows[0]..rows[1]).contains(&(j as u32));
                    assert_eq!(found, expected, "{j} in column {i} of {width} × {height}");
                }
            }
        }
    }

    #[test]
    fn texels_outside_disk_are_ignored() {
        let mut texels = [1.0; 100];
        for corner in [0, 9, 90, 99] {
            texels[corner] = f32::NAN;
        }
        let columns =
            columns_of_texels(10, 10, &texels, Measure::ProjectedSolidAngle, Reconstruction::Bilinear)
                .unwrap();
        for column in 0..10 {
            assert!(columns.values(column).iter().all(|&value| value == 1.0));
        }
    }
}
