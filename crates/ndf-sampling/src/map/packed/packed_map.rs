//! A map of normals in one borrowed array of `f32`.

use crate::error::NdfError;
use crate::map::packed::grid::Grid;
use crate::map::packed::layout::{HEADER, Layout};
use crate::map::packed::leaf::{Head, Leaf};
use crate::map::reconstruction::Reconstruction;

/// An NDF on the map, sampled and inverted in `f32` from one borrowed array.
///
/// The array can be in flash, a file or a `Vec`.
///
/// `NdfMap::array` (feature `alloc`) returns the array. The documentation of `NdfMap` applies here
/// too. The CDFs are rounded to `f32`, so details below 10⁻⁷ of the total weight are lost.
///
/// - **Accuracy:** `forward(sample(u)) = u` within 1e-6, plus the effect of rounding the
///   coordinates of the normal: 6e-8 times the marginal, or the conditional density, per `dn`. The
///   pieces of the marginal are those of the exact map.
/// - **Order:** `n_x` increases with `u₁` and `n_y` with `u₂`, to 1.2e-7.
/// - **Resolution:** that of `f32`; more than 2²² columns or rows are not distinguished.
/// - **Any input:** uniform numbers are clamped to `[0, 1 − 2⁻²⁴]`, NaN is read as 0; directions as
///   for [`Ndf`](crate::ndf::Ndf).
/// - An array with a valid header and modified numbers returns different normals, and never panics.
///
/// ```
/// # #[cfg(feature = "alloc")] {
/// use asperity_ndf_sampling::{Ggx, Ndf, NdfMap, PackedMapRef, Reconstruction, glam::Vec2};
///
/// let map = NdfMap::from_ndf(64, 64, Reconstruction::Bilinear, &Ggx::new(0.3, 0.5)?)?;
/// let packed = PackedMapRef::new(map.array())?;
/// let u = Vec2::new(0.2, 0.7);
/// let m = packed.sample(u);
/// assert!(packed.forward(m.truncate()).abs_diff_eq(u, 1e-6));
/// # }
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "gpu")]
#[doc(alias = "flash")]
pub struct PackedMapRef<'a> {
    pub(crate) layout: Layout,
    pub(crate) grid: Grid,
    /// The guides to the leaves by `M` and by `n_x`: a leaf, and the keys of the next three.
    pub(crate) by_weight: &'a [[f32; 4]],
    pub(crate) by_place: &'a [[f32; 4]],
    pub(crate) leaves: &'a [Leaf],
    pub(crate) heads: &'a [Head],
    /// For each line across a column the integral up to it and, in bilinear maps, the value on it.
    pub(crate) nodes: &'a [f32],
    /// `D` column by column.
    pub(crate) texels: &'a [f32],
    pub(crate) quantiles: &'a [f32],
}

impl<'a> PackedMapRef<'a> {
    /// Creates the map from an array that `NdfMap::array` returned.
    ///
    /// # Errors
    /// An array without the header of a packed map, with an invalid size in the header, or with a
    /// length that does not match these sizes.
    pub fn new(array: &'a [f32]) -> Result<Self, NdfError> {
        Ok(Self::of(Layout::read(array)?, array))
    }

    /// Creates the map from an array of the length of the layout.
    #[inline]
    pub(crate) fn of(layout: Layout, array: &'a [f32]) -> Self {
        let mut rest = array.get(HEADER..).unwrap_or_default();
        let mut parts = [&array[..0]; 7];
        for (part, length) in parts.iter_mut().zip(layout.parts()) {
            (*part, rest) = rest.split_at_checked(length.unwrap_or(0) as usize).unwrap_or((rest, &[]));
        }
        let [by_weight, by_place, leaves, heads, nodes, texels, quantiles] = parts;
        let [by_weight, by_place, heads] = [by_weight, by_place, heads].map(|part| part.as_chunks().0);
        let leaves = leaves.as_chunks().0.as_chunks().0;
        let grid = Grid::new(&layout);
        Self { layout, grid, by_weight, by_place, leaves, heads, nodes, texels, quantiles }
    }

    /// The number of texels along x.
    #[inline]
    #[must_use]
    pub const fn width(&self) -> usize {
        self.layout.width
    }

    /// The number of texels along y.
    #[inline]
    #[must_use]
    pub const fn height(&self) -> usize {
        self.layout.height
    }

    /// Reconstruction between the centers of texels.
    #[inline]
    #[must_use]
    pub const fn reconstruction(&self) -> Reconstruction {
        self.layout.kind
    }
}

#[cfg(test)]
mod tests {
    #[cfg(feature = "alloc")]
    #[test]
    fn part_offsets_match_the_array() {
        use super::*;
        use crate::{Measure, NdfMap, gpu::PackedMapUniform};

        for kind in [Reconstruction::Constant, Reconstruction::Bilinear] {
            let array = NdfMap::from_fn(24, 5, Measure::ProjectedSolidAngle, kind, |n| 1.0 + 0.5 * n.x)
                .unwrap()
                .into_array();
            let map = PackedMapRef::new(&array).unwrap();
            assert_eq!((map.width(), map.height(), map.reconstruction()), (24, 5, kind));
            let uniform = map.gpu();
            let [by_weight, by_place, heads] =
                [map.by_weight, map.by_place, map.heads].map(<[[f32; 4]]>::as_flattened);
            let leaves = map.leaves.as_flattened().as_flattened();
            let parts = [by_weight, by_place, leaves, heads, map.nodes, map.texels, map.quantiles];
            let mut end = HEADER;
            let PackedMapUniform { by_weight_at, by_place_at, leaves_at, heads_at, .. } = uniform;
            let PackedMapUniform { nodes_at, texels_at, quantiles_at, .. } = uniform;
            let begins = [by_weight_at, by_place_at, leaves_at, heads_at, nodes_at, texels_at, quantiles_at];
            for (begin, part) in begins.into_iter().zip(parts) {
                assert_eq!(begin as usize, end);
                assert_eq!(array[end..end + part.len()].as_ptr(), part.as_ptr());
                end += part.len();
            }
            assert_eq!((end, uniform.leaves as usize), (array.len(), map.leaves.len()));
            // Columns and rows per unit from −1 to 1; bilinear maps have one cell more, half a cell
            // earlier.
            let sides = if kind == Reconstruction::Bilinear { 2 } else { 1 };
            let more = if kind == Reconstruction::Bilinear { 1 } else { 0 };
            let half = 0.5 * more as f32;
            assert_eq!((uniform.density, uniform.size), ([12.0, 2.5], [2.0 / 24.0, 0.4]));
            assert_eq!(uniform.origin, [12.0 + half, 2.5 + half]);
            assert_eq!(uniform.last, [23.5 + more as f32, 4.5 + more as f32]);
            assert_eq!([uniform.last_row, uniform.sides], [4 + more, sides]);
        }
    }

    #[cfg(feature = "alloc")]
    #[test]
    fn new_rejects_arrays_of_wrong_length() {
        use super::*;
        use crate::{Measure, NdfMap};

        let array = NdfMap::from_fn(4, 4, Measure::ProjectedSolidAngle, Reconstruction::Constant, |n| n.z)
            .unwrap()
            .into_array();
        let expected = array.len();
        for got in [HEADER, array.len() - 1] {
            assert_eq!(
                PackedMapRef::new(&array[..got]),
                Err(NdfError::Length { parameter: "array", expected, got })
            );
        }
    }
}
