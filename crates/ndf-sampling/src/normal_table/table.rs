//! Table L: tangent frames over a square of Gaussian coordinates, for normals by one lookup.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::ops::Deref;

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};

use crate::error::{NdfError, square};
use crate::frame::Frame;
#[cfg(feature = "alloc")]
use crate::ndf::Ndf;
use crate::normal_table::layout::{TableEntry, TableLayout};
#[cfg(feature = "alloc")]
use crate::normal_table::spacing::Spacing;
#[cfg(feature = "alloc")]
use crate::numeric::binary16::{MAX_HALF, to_half};
use crate::storage::Entries;

/// Lookup table `L` of an NDF: frames of the normals `T(z)` on a square grid of Gaussian
/// coordinates.
///
/// ```text
/// entries[k₂ size + k₁] = p(T(z_k₁, z_k₂)),   place(z_k) = (k + ½)/size,   k = 0 … size − 1
/// ```
///
/// The position of a coordinate is defined by the [`Spacing`], and the two numbers `p` of a normal
/// by the [`Chart`](crate::normal_table::Chart) of the layout. The table owns its
/// entries, or borrows floats or half floats in flash or in the bytes of a file.
///
/// - **Any input:** coordinates are clamped to the outermost entries, NaN is read as 0. Entries
///   outside the chart are clamped to it. Results are unit vectors with `n.z ≥ 0`.
/// - **Half a texel:** entries are at the centers of `size²` equal texels, as in a texture with the
///   coordinate `place(z)`. A table of even size has no entry at `z = 0`. Its entry nearest to the
///   flat bump map is tilted by half a texel.
/// - **Frames** are minimal rotations from (0, 0, 1), see [`Frame::from_normal`]. They have no
///   seam. Between two normals they turn at most √2 times as far as the normal.
///
/// Total variation between the normals of a table of 256² and GGX (0.2, 0.4) over 32 × 32 bins of
/// radius and azimuth, from 6.3·10⁶ points. The sampling error of the points is 0.00040. The
/// columns "tail" are the fraction of the steepest 0.1 % of the normals that the table keeps.
///
/// | spacing | chart | nearest | tail | bilinear | tail |
/// |---|---|---|---|---|---|
/// | coordinates | stereographic (default) | 0.039 | 0.99 | 0.00042 | 0.994 |
/// | coordinates | projected | 0.039 | 0.99 | 0.00042 | 0.992 |
/// | coordinates | slopes | 0.039 | 0.99 | 0.00042 | 0.996 |
/// | quantiles (the paper's) | stereographic | 0.013 | 0.18 | 0.00130 | 0.203 |
/// | quantiles | projected | 0.013 | 0.18 | 0.00089 | 0.183 |
/// | quantiles | slopes | 0.013 | 0.18 | 0.00182 | 0.220 |
/// | warped | stereographic | 0.020 | 1.00 | 0.00042 | 0.994 |
/// | warped | projected | 0.020 | 1.00 | 0.00041 | 0.990 |
/// | warped | slopes | 0.020 | 1.00 | 0.00042 | 0.998 |
///
/// Times per lookup in batches, one thread: 4 ns nearest, 8 ns bilinear, 10 ns warped, 15 ns from
/// half floats. Single lookups take 16 and 29 ns. The tail of the points is 0.994. In half floats
/// the 0.00042 of the default becomes 0.0006.
///
/// Kautz, Heidrich, Seidel 2001, section 4. The paper indexes by the noise value with G inside the
/// table, and does not specify values between entries. This table is indexed by `z`, so that one
/// table serves every noise, and interpolated. [`NormalLut::from_fn`] creates the table of the
/// paper.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, NormalLut, glam::Vec2};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let table = NormalLut::new(&ggx, 65)?;
/// assert!(table.nearest(Vec2::ZERO).normal.abs_diff_eq(ggx.warp_gaussian(Vec2::ZERO), 1e-6));
/// let z = Vec2::new(0.4, -1.1);
/// assert!(table.bilinear(z).normal.abs_diff_eq(ggx.warp_gaussian(z), 1e-3));
/// // The maximum error is 0.08°.
/// assert!(table.accuracy(&ggx).bilinear.largest < 0.0014);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// ```
/// use asperity_ndf_sampling::{NormalLut, glam::{Vec2, Vec3}, normal_table::TableLayout};
///
/// // Four entries in read-only memory, with n_x of 0.6, 0.0 and below −0.6.
/// static FLASH: [[f32; 2]; 4] = [[-0.5, 0.0], [0.5, 0.0], [-0.5, 0.0], [0.5, 0.0]];
/// let table = NormalLut::from_entries(2, TableLayout::default(), &FLASH)?;
/// assert_eq!(table.bilinear(Vec2::ZERO).normal, Vec3::Z);
/// assert_eq!(table.nearest(Vec2::ONE).normal, Vec3::new(0.8, 0.0, 0.6));
///
/// // The same entries as half floats.
/// static HALVES: [[u16; 2]; 4] = [[0xB800, 0], [0x3800, 0], [0xB800, 0], [0x3800, 0]];
/// let table = NormalLut::from_entries(2, TableLayout::default(), &HALVES)?;
/// assert_eq!(table.nearest(Vec2::ONE).normal, Vec3::new(0.8, 0.0, 0.6));
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// `as_chunks` converts a flat slice `&[f32]` or `&[u16]` to a slice of pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "lut")]
#[doc(alias = "texture")]
pub struct NormalLut<S = Entries<[f32; 2]>> {
    pub(crate) size: usize,
    pub(crate) layout: TableLayout,
    pub(crate) entries: S,
}

impl<'a, E> NormalLut<&'a [E]> {
    /// Creates the table from `size · size` entries.
    ///
    /// # Errors
    /// A `size` of 0 or above 4096; another number of entries.
    pub const fn from_entries(size: usize, layout: TableLayout, entries: &'a [E]) -> Result<Self, NdfError> {
        match square(size, Some(entries.len())) {
            Ok(()) => Ok(Self { size, layout, entries }),
            Err(error) => Err(error),
        }
    }

    /// The entries, row by row: `z₁` runs along a row, and the first row has the smallest `z₂`.
    #[inline]
    #[must_use]
    pub const fn entries(self) -> &'a [E] {
        self.entries
    }
}

impl<S> NormalLut<S> {
    /// The number of entries along a side.
    #[inline]
    #[must_use]
    pub const fn size(&self) -> usize {
        self.size
    }

    /// Index and entries of the table.
    #[inline]
    #[must_use]
    pub const fn layout(&self) -> TableLayout {
        self.layout
    }
}

impl<E: TableEntry, S: Deref<Target = [E]>> NormalLut<S> {
    /// The table in borrowed form.
    #[inline]
    #[must_use]
    pub fn view(&self) -> NormalLut<&[E]> {
        NormalLut { size: self.size, layout: self.layout, entries: &self.entries }
    }

    /// The frames of the entries, row by row.
    ///
    /// `z₁` runs along a row, and the first row has the smallest `z₂`.
    #[must_use]
    pub fn frames(&self) -> impl ExactSizeIterator<Item = Frame> + Clone {
        let chart = self.layout.chart;
        self.entries.iter().map(move |entry| Frame::from_normal(chart.to_normal(entry.point())))
    }

    /// The frame of the entry nearest to `z`.
    #[inline]
    #[must_use]
    pub fn nearest(&self, z: Vec2) -> Frame {
        Frame::from_normal(self.nearest_normal(z))
    }

    /// The frame of the normal interpolated between the four entries around `z`.
    #[inline]
    #[must_use]
    pub fn bilinear(&self, z: Vec2) -> Frame {
        Frame::from_normal(self.bilinear_normal(z))
    }

    /// The normal of the entry nearest to `z`.
    #[inline]
    #[must_use]
    pub fn nearest_normal(&self, z: Vec2) -> Vec3 {
        let [x, y] = [z.x, z.y].map(|z| self.position(self.layout.spacing.place(z)));
        self.layout.chart.to_normal(self.nearest_point(x, y))
    }

    /// The normal at the chart point interpolated bilinearly between the four entries around `z`.
    #[inline]
    #[must_use]
    pub fn bilinear_normal(&self, z: Vec2) -> Vec3 {
        let [x, y] = [z.x, z.y].map(|z| self.cell(self.position(self.layout.spacing.place(z))));
        self.layout.chart.to_normal(self.bilinear_point(x, y))
    }

    /// The position among the entries, in `0..=size − 1`, for a position in [0, 1].
    #[inline]
    pub(crate) fn position(&self, place: f32) -> f32 {
        // min and max rather than clamp: they need no case for NaN and vectorize.
        (place * self.size as f32 - 0.5).max(0.0).min((self.size - 1) as f32)
    }

    /// The entry nearest to the position.
    #[inline]
    pub(crate) fn nearest_point(&self, x: f32, y: f32) -> Vec2 {
        let index = (y + 0.5) as i32 as usize * self.size + (x + 0.5) as i32 as usize;
        self.entries.get(index).map_or(Vec2::ZERO, |entry| entry.point())
    }

    /// The cell between two entries that contains a position, and the offset in it.
    ///
    /// The last entry is the end of the last cell.
    #[inline]
    pub(crate) fn cell(&self, position: f32) -> (i32, f32) {
        let cell = (position as i32).min(self.size.saturating_sub(2) as i32);
        (cell, position - cell as f32)
    }

    /// The interpolated point between the four entries of a cell.
    #[inline]
    pub(crate) fn bilinear_point(&self, (column, right): (i32, f32), (row, up): (i32, f32)) -> Vec2 {
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

#[cfg(feature = "alloc")]
impl NormalLut<Vec<[f32; 2]>> {
    /// The usual size of a side.
    pub const SIZE: usize = 256;

    /// Creates the table of `ndf` with `size · size` entries in the default layout.
    ///
    /// # Errors
    /// A `size` of 0 or above 4096. At 4096 the table takes 128 MB.
    pub fn new<N: Ndf + ?Sized>(ndf: &N, size: usize) -> Result<Self, NdfError> {
        Self::with_layout(ndf, size, TableLayout::default())
    }

    /// Creates the table of `ndf` with `size · size` entries in this layout.
    ///
    /// # Errors
    /// See [`NormalLut::new`].
    pub fn with_layout<N: Ndf + ?Sized>(ndf: &N, size: usize, layout: TableLayout) -> Result<Self, NdfError> {
        Self::from_fn(size, layout, |z| ndf.warp_gaussian(z))
    }

    /// Creates the table of `ndf` of the usual size, 256 × 256, in the default layout.
    #[must_use]
    pub fn standard<N: Ndf + ?Sized>(ndf: &N) -> Self {
        Self::build(Self::SIZE, TableLayout::default(), |z| ndf.warp_gaussian(z))
    }

    /// Creates the table of any normals: `f` maps the coordinates of entries, row by row, to
    /// normals.
    ///
    /// With `f(r) = T(Φ⁻¹(G(σ r₁)), Φ⁻¹(G(σ r₂)))` it is the table of Kautz, Heidrich, Seidel 2001,
    /// which is indexed by the noise values in units of their standard deviation `σ`.
    ///
    /// # Errors
    /// See [`NormalLut::new`].
    pub fn from_fn(size: usize, layout: TableLayout, f: impl FnMut(Vec2) -> Vec3) -> Result<Self, NdfError> {
        square(size, None).map(|()| Self::build(size, layout, f))
    }

    fn build(size: usize, layout: TableLayout, mut f: impl FnMut(Vec2) -> Vec3) -> Self {
        let at: Vec<f32> = (0..size).map(|k| entry_coordinate(layout.spacing, k, size)).collect();
        let entries = at
            .iter()
            .flat_map(|&z2| at.iter().map(move |&z1| Vec2::new(z1, z2)))
            .map(|z| layout.chart.to_point(f(z)).to_array())
            .collect();
        Self { size, layout, entries }
    }

    /// The entries as pairs of half floats, e.g. for an interpolated texture of format RG16F.
    ///
    /// For lookups on the CPU pass the result to [`NormalLut::from_entries`]. Rounding rotates
    /// normals by at most 4.9e-4 rad in the default chart, and by 2⁻¹¹ of their tilt where it is
    /// small. In the projected chart it rotates them by 0.03 rad near the horizon. Slopes are
    /// clamped to 65504.
    #[must_use]
    pub fn halves(&self) -> Vec<[u16; 2]> {
        let half = |c: f32| to_half(c.clamp(-MAX_HALF, MAX_HALF));
        self.entries.iter().map(|entry| entry.map(half)).collect()
    }
}

/// The coordinate of entry `k`.
#[cfg(feature = "alloc")]
pub(crate) fn entry_coordinate(spacing: Spacing, k: usize, size: usize) -> f32 {
    spacing.coordinate(((2 * k + 1) as f64 / (2 * size) as f64) as f32)
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    extern crate std;
    use super::*;
    use crate::{Ggx, normal_table::Chart};
    use asperity_core::assert_abs_diff_eq;

    const LAYOUTS: [TableLayout; 5] = [
        TableLayout { spacing: Spacing::Coordinates, chart: Chart::Projected },
        TableLayout { spacing: Spacing::Coordinates, chart: Chart::Slopes },
        TableLayout { spacing: Spacing::Coordinates, chart: Chart::Stereographic },
        TableLayout { spacing: Spacing::Quantiles, chart: Chart::Stereographic },
        TableLayout { spacing: Spacing::Warped, chart: Chart::Stereographic },
    ];

    #[test]
    fn nearest_and_bilinear_agree_on_the_entries() {
        for layout in LAYOUTS {
            let table = NormalLut::with_layout(&Ggx::new(0.2, 0.6).unwrap(), 9, layout).unwrap();
            let at = |k| entry_coordinate(layout.spacing, k, 9);
            for (k, frame) in table.frames().enumerate() {
                let z = Vec2::new(at(k % 9), at(k / 9));
                assert_eq!(table.nearest(z), frame, "{layout:?} {z}");
                // √(1 − r²) of the projected chart magnifies the rounding of r, and the flat chord
                // of coarse slopes magnifies the rounding of z.
                let tolerance = if layout.chart == Chart::Projected { 2e-5 } else { 2e-6 };
                let found = table.bilinear(z).normal;
                assert_abs_diff_eq!(found, frame.normal, epsilon = tolerance, "{layout:?}");
            }
        }
    }

    #[test]
    fn even_table_tilts_the_nearest_flat_normal_by_half_a_texel() {
        let ggx = Ggx::isotropic(0.3).unwrap();
        let table = NormalLut::standard(&ggx);
        assert_abs_diff_eq!(table.bilinear(Vec2::ZERO).normal, Vec3::Z, epsilon = 1e-7);
        let half = Spacing::RANGE / 256.0;
        let expected = ggx.warp_gaussian(Vec2::splat(half));
        assert_abs_diff_eq!(table.nearest(Vec2::ZERO).normal, expected, epsilon = 1e-6);
    }

    #[test]
    fn half_floats_rotate_normals_by_their_rounding() {
        let table = NormalLut::new(&Ggx::new(0.2, 1.0).unwrap(), 64).unwrap();
        let halves = table.halves();
        for (half, frame) in halves.iter().zip(table.frames()) {
            let rounded = table.layout.chart.to_normal(half.point());
            assert_abs_diff_eq!((rounded - frame.normal).length(), 0.0, epsilon = 4.9e-4);
        }
    }

    #[test]
    fn table_is_const_constructible() {
        static FLASH: [[u16; 2]; 1] = [[0x3800, 0]];
        const TABLE: NormalLut<&[[u16; 2]]> = match NormalLut::from_entries(
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
    fn accepts_every_input() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38, -1e38, 1e-40, 0.0];
        let points = bad.map(|x| [x, 2.0]);
        for (chart, spacing) in [
            (Chart::Stereographic, Spacing::Coordinates),
            (Chart::Slopes, Spacing::Quantiles),
            (Chart::Projected, Spacing::Warped),
        ] {
            for size in [1, 2] {
                let entries = points.get(..size * size).unwrap();
                let table = NormalLut::from_entries(size, TableLayout { spacing, chart }, entries).unwrap();
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
