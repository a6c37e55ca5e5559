//! Regular grids of points.

use crate::point::Point;

/// A regular grid of points: origin + step·index along every axis, with the first axis fastest.
///
/// Rounding happens after the product and after the sum.
///
/// ```
/// use asperity_noise::{Grid, glam::Vec3};
///
/// let grid = Grid { origin: Vec3::ZERO, step: Vec3::new(0.5, 1.0, 2.0), size: [4, 3, 2] };
/// assert_eq!(grid.len(), 24);
/// assert_eq!(grid.point([3, 2, 1]), Vec3::new(1.5, 2.0, 2.0));
/// ```
#[doc(alias = "heightmap")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "V: serde::Serialize, V::Array<usize>: serde::Serialize",
        deserialize = "V: serde::Deserialize<'de>, V::Array<usize>: serde::Deserialize<'de>",
    ))
)]
pub struct Grid<V: Point> {
    /// The point of index 0.
    pub origin: V,
    /// The distance of neighbors along each axis; may be 0 or negative.
    pub step: V,
    /// The number of points along each axis.
    pub size: V::Array<usize>,
}

impl<V: Point> Grid<V> {
    /// Returns the number of points, saturated to `usize::MAX`.
    #[must_use]
    pub fn len(&self) -> usize {
        self.size.as_ref().iter().fold(1_usize, |product, &n| product.saturating_mul(n))
    }

    /// Returns whether the grid has no points.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the point of an index, inside or outside the grid.
    #[must_use]
    #[expect(clippy::needless_pass_by_value, reason = "an index is as small as a point")]
    pub fn point(&self, index: V::Array<usize>) -> V {
        let (origin, step) = (self.origin.coordinates(), self.step.coordinates());
        V::from_axes(|axis| {
            let i = index.as_ref()[axis];
            (origin.as_ref()[axis] + 0.0) + step.as_ref()[axis] * (i as i32 as f32)
        })
    }

    /// The first coordinate of a column's points.
    #[inline(always)]
    pub(crate) fn x(&self, column: usize) -> f32 {
        let (origin, step) = (self.origin.coordinates(), self.step.coordinates());
        (origin.as_ref()[0] + 0.0) + step.as_ref()[0] * (column as i32 as f32)
    }

    /// The number of points of a row.
    #[inline(always)]
    pub(crate) fn width(&self) -> usize {
        self.size.as_ref().first().copied().unwrap_or(0)
    }

    /// Returns the number of rows along the first axis, counted over all other axes.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.len().checked_div(self.width()).unwrap_or(0)
    }

    /// The index of a point in a row, with rows counted over all axes but the first.
    #[inline(always)]
    pub(crate) fn index(&self, column: usize, mut row: usize) -> V::Array<usize> {
        V::array(|axis| {
            if axis == 0 {
                return column;
            }
            let n = self.size.as_ref()[axis].max(1);
            let index = row % n;
            row /= n;
            index
        })
    }
}
