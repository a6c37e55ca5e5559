//! Look-ups in a table of normals that somebody else owns.

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};

use crate::frame::Frame;
use crate::normal_table::error::NormalTableError;
use crate::normal_table::layout::{TableEntry, TableLayout};

/// A table `L` in borrowed storage, of floats or half floats: in flash, in a file's bytes, or a
/// [`NormalTable`](crate::NormalTable)'s own.
///
/// ```text
/// entries[k₂ size + k₁] = p(T(z_k₁, z_k₂)),   place(z_k) = (k + ½)/size,   k = 0 … size − 1
/// ```
///
/// with the place of a coordinate from the [`Spacing`](crate::normal_table::Spacing) and the point of a normal from the
/// [`Chart`](crate::normal_table::Chart) of the layout.
///
/// - **Total:** coordinates beyond the outermost entries give those, NaN counts as 0; entries that are no points of the chart
///   count as the nearest that is one. Results are unit vectors with `n.z ≥ 0`.
/// - **Half a texel:** entries are at the centres of `size²` equal texels, as in a texture with the coordinate `place(z)`. A
///   table of even size has no entry at `z = 0`: the nearest to the flat bump map is tilted by half a texel.
/// - **Frames** are minimal rotations from (0, 0, 1), see [`Frame::from_normal`]: without a seam, and between two normals they
///   turn at most √2 times as far as the normal does.
///
/// ```
/// use asperity_ndf_sampling::{NormalTableRef, glam::{Vec2, Vec3}, normal_table::{TableLayout, to_half}};
///
/// // Four entries in read-only memory: the x-coordinate of the normal is 0.6, 0.0 and below −0.6.
/// static FLASH: [[f32; 2]; 4] = [[-0.5, 0.0], [0.5, 0.0], [-0.5, 0.0], [0.5, 0.0]];
/// let table = NormalTableRef::new(2, TableLayout::default(), &FLASH)?;
/// assert_eq!(table.bilinear(Vec2::ZERO).normal, Vec3::Z);
/// assert_eq!(table.nearest(Vec2::ONE).normal, Vec3::new(0.8, 0.0, 0.6));
///
/// let halves = FLASH.map(|p| p.map(to_half));
/// let table = NormalTableRef::new(2, TableLayout::default(), &halves)?;
/// assert_eq!(table.nearest(Vec2::ONE).normal, Vec3::new(0.8, 0.0, 0.6));
/// # Ok::<(), asperity_ndf_sampling::NormalTableError>(())
/// ```
///
/// A flat slice `&[f32]` or `&[u16]` is such a slice of pairs by `as_chunks`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalTableRef<'a, E = [f32; 2]> {
    pub(crate) size: usize,
    pub(crate) layout: TableLayout,
    pub(crate) entries: &'a [E],
}

impl<'a, E> NormalTableRef<'a, E> {
    /// The table of `size · size` entries.
    ///
    /// # Errors
    /// A `size` of 0 or above 4096; another number of entries.
    pub const fn new(size: usize, layout: TableLayout, entries: &'a [E]) -> Result<Self, NormalTableError> {
        match NormalTableError::check(size, Some(entries.len())) {
            Ok(()) => Ok(Self { size, layout, entries }),
            Err(error) => Err(error),
        }
    }

    /// The number of entries along a side.
    #[inline]
    #[must_use]
    pub const fn size(self) -> usize {
        self.size
    }

    /// Index and entries of the table.
    #[inline]
    #[must_use]
    pub const fn layout(self) -> TableLayout {
        self.layout
    }

    /// The entries, row by row: `z₁` runs along a row, and the first row has the least `z₂`.
    #[inline]
    #[must_use]
    pub const fn entries(self) -> &'a [E] {
        self.entries
    }
}

impl<E: TableEntry> NormalTableRef<'_, E> {
    /// The frame of the entry nearest to `z`.
    #[inline]
    #[must_use]
    pub fn nearest(self, z: Vec2) -> Frame {
        Frame::from_normal(self.nearest_normal(z))
    }

    /// The frame of the normal that is interpolated between the four entries around `z`.
    #[inline]
    #[must_use]
    pub fn bilinear(self, z: Vec2) -> Frame {
        Frame::from_normal(self.bilinear_normal(z))
    }

    /// The normal of the entry nearest to `z`.
    #[inline]
    #[must_use]
    pub fn nearest_normal(self, z: Vec2) -> Vec3 {
        let [x, y] = [z.x, z.y].map(|z| self.position(self.layout.spacing.place(z)));
        self.layout.chart.to_normal(self.nearest_point(x, y))
    }

    /// The normal whose point of the chart is interpolated bilinearly between the four entries around `z`.
    #[inline]
    #[must_use]
    pub fn bilinear_normal(self, z: Vec2) -> Vec3 {
        let [x, y] = [z.x, z.y].map(|z| self.cell(self.position(self.layout.spacing.place(z))));
        self.layout.chart.to_normal(self.bilinear_point(x, y))
    }

    /// The position among the entries, in `0..=size − 1`, of what has this place in [0, 1].
    #[inline]
    pub(crate) fn position(self, place: f32) -> f32 {
        // min and max rather than clamp: no case of NaN, and vector code has them.
        (place * self.size as f32 - 0.5).max(0.0).min((self.size - 1) as f32)
    }

    /// The entry nearest to the position.
    #[inline]
    pub(crate) fn nearest_point(self, x: f32, y: f32) -> Vec2 {
        let index = (y + 0.5) as i32 as usize * self.size + (x + 0.5) as i32 as usize;
        self.entries.get(index).map_or(Vec2::ZERO, |entry| entry.point())
    }

    /// The cell between two entries in which a position lies, and how far: the last entry is the end of the last cell.
    #[inline]
    pub(crate) fn cell(self, position: f32) -> (i32, f32) {
        let cell = (position as i32).min(self.size.saturating_sub(2) as i32);
        (cell, position - cell as f32)
    }

    /// The point between the four entries around a cell.
    #[inline]
    pub(crate) fn bilinear_point(self, (column, right): (i32, f32), (row, up): (i32, f32)) -> Vec2 {
        let (below, size) = (row as usize * self.size + column as usize, self.size);
        let (Some(&[a, b, ..]), Some(&[c, d, ..])) =
            (self.entries.get(below..), self.entries.get(below + size..))
        else {
            // A table of one entry.
            return self.entries.first().map_or(Vec2::ZERO, |entry| entry.point());
        };
        // Along the columns first: two entries of a row are four numbers, one vector.
        let pair = |a: E, b: E| {
            let (a, b) = (a.point(), b.point());
            Vec4::new(a.x, a.y, b.x, b.y)
        };
        let (low, high) = (pair(a, b), pair(c, d));
        let between = low + (high - low) * up;
        let (a, b) = (between.xy(), between.zw());
        a + (b - a) * right
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::normal_table::{Chart, Spacing};
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn can_be_a_constant() {
        static FLASH: [[u16; 2]; 1] = [[0x3800, 0]];
        const TABLE: NormalTableRef<'static, [u16; 2]> = match NormalTableRef::new(
            1,
            TableLayout { spacing: Spacing::Warped, chart: Chart::Projected },
            &FLASH,
        ) {
            Ok(table) => table,
            Err(_) => panic!("one entry"),
        };
        let n = TABLE.bilinear(Vec2::new(3.0, f32::NAN)).normal;
        assert_abs_diff_eq!(n, Vec3::new(0.5, 0.0, 0.75_f32.sqrt()), epsilon = 1e-7);
    }

    #[test]
    fn total_on_every_input() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38, -1e38, 1e-40, 0.0];
        let points = bad.map(|x| [x, 2.0]);
        for (chart, spacing) in [
            (Chart::Stereographic, Spacing::Coordinates),
            (Chart::Slopes, Spacing::Quantiles),
            (Chart::Projected, Spacing::Warped),
        ] {
            for size in [1, 2] {
                let entries = points.get(..size * size).unwrap();
                let table = NormalTableRef::new(size, TableLayout { spacing, chart }, entries).unwrap();
                for (x, y) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))) {
                    for n in [table.nearest_normal(Vec2::new(x, y)), table.bilinear_normal(Vec2::new(x, y))] {
                        assert_abs_diff_eq!(n.length(), 1.0, epsilon = 1e-6, "{chart:?} {size} {x} {y}");
                        assert!(n.z >= 0.0, "{chart:?} {size} {x} {y}");
                    }
                }
            }
        }
    }
}
