//! Regular grids of points, and the order that a batch goes through them in.

use core::ops::Range;

use crate::{contract::kernel::Row, contract::point::Point, row::cells::POINTS};

/// A regular grid of points: origin + step·index along every axis.
///
/// ```
/// use asperity_noise::{Grid, glam::Vec3};
///
/// let grid = Grid { origin: Vec3::ZERO, step: Vec3::new(0.5, 1.0, 2.0), size: [4, 3, 2] };
/// assert_eq!(grid.len(), 24);
/// assert_eq!(grid.point([3, 2, 1]), Vec3::new(1.5, 2.0, 2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<V, const N: usize> {
    /// The point of index 0.
    pub origin: V,
    /// The distance of neighbours along each axis; may be 0 or negative.
    pub step: V,
    /// The number of points along each axis.
    pub size: [usize; N],
}

impl<V: Point<N>, const N: usize> Grid<V, N> {
    /// The number of points, `usize::MAX` if it is larger than that.
    #[must_use]
    pub fn len(&self) -> usize {
        self.size.iter().fold(1_usize, |product, &n| product.saturating_mul(n))
    }

    /// Whether there are no points.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The point of an index, inside the grid or outside.
    #[must_use]
    pub fn point(&self, index: [usize; N]) -> V {
        let (origin, step) = (self.origin.coordinates(), self.step.coordinates());
        let mut axis = 0;
        V::from_coordinates(index.map(|i| {
            axis += 1;
            (origin[axis - 1] + 0.0) + step[axis - 1] * (i as i32 as f32)
        }))
    }

    /// The coordinates of point i, counted with the first axis running fastest.
    pub(crate) fn numbered(&self, mut i: usize) -> [f32; N] {
        self.point(self.size.map(|n| {
            let index = i % n.max(1);
            i /= n.max(1);
            index
        }))
        .coordinates()
    }

    /// The grid in parts of rows, in an order that keeps near what passes and rows share.
    #[inline(always)]
    pub(crate) fn parts(&self, passes: usize) -> Parts<'_, V, N> {
        let width = self.size[0];
        let rows = self.len().checked_div(width).unwrap_or(0);
        let block = (BLOCK / width.clamp(1, POINTS)).max(1);
        let start = Place { row: 0, index: [0; N] };
        Parts {
            grid: self,
            passes: passes.max(1),
            rows,
            block,
            first: start,
            start: 0,
            pass: 0,
            place: start,
        }
    }
}

/// Points that are gone through before the next pass: as many as a near cache holds.
const BLOCK: usize = 8192;

/// A row of a grid: its number, counted over all axes but the first, and its index along them.
#[derive(Clone, Copy)]
struct Place<const N: usize> {
    row: usize,
    index: [usize; N],
}

impl<const N: usize> Place<N> {
    /// The next row, of a grid of this size.
    #[inline(always)]
    fn next(mut self, size: &[usize; N]) -> Self {
        self.row += 1;
        for (i, &n) in self.index.iter_mut().zip(size).skip(1) {
            *i += 1;
            if *i < n {
                break;
            }
            *i = 0;
        }
        self
    }
}

/// The parts of a grid's rows: in strips of [`POINTS`], in blocks of rows, in passes over a block.
pub(crate) struct Parts<'a, V, const N: usize> {
    grid: &'a Grid<V, N>,
    passes: usize,
    rows: usize,
    block: usize,
    /// The block's first row.
    first: Place<N>,
    /// The strip's first point.
    start: usize,
    pass: usize,
    place: Place<N>,
}

impl<V: Point<N>, const N: usize> Iterator for Parts<'_, V, N> {
    type Item = (usize, Row<N, false>, Range<usize>);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        let width = self.grid.size[0];
        if self.start >= width || self.place.row >= self.rows {
            return None;
        }
        let (r, end) = (self.place.row, width.min(self.start + POINTS));
        let part = r * width + self.start..r * width + end;
        let step = self.grid.step.coordinates()[0];
        let row = Row::new(self.grid.point(self.place.index).coordinates(), step, self.start);
        let item = (self.pass, row, part);
        self.place = self.place.next(&self.grid.size);
        if self.place.row == self.first.row + self.block || self.place.row == self.rows {
            self.pass += 1;
            if self.pass == self.passes {
                self.pass = 0;
                self.first = self.place;
                if self.place.row == self.rows {
                    self.first = Place { row: 0, index: [0; N] };
                    self.start = end;
                }
            }
            self.place = self.first;
        }
        Some(item)
    }
}
