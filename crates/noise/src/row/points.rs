//! The points of a batch, and the destination of values and gradients.

use core::{array, ops::Range};

use crate::{
    lanes::level::Instructions,
    point::Point,
    row::{cells::POINTS, grid::Grid, row::Row},
};

/// The points of a batch, an opaque argument of [`Field::fill`](crate::Field::fill).
#[expect(missing_debug_implementations, reason = "opaque")]
pub struct Points<'a, V: Point>(pub(crate) Source<'a, V>);

/// Lists of coordinates, or part of a grid.
pub(crate) enum Source<'a, V: Point> {
    Lists(V::Array<&'a [f32]>),
    Window(Window<'a, V>),
}

/// Some columns of some rows of a grid.
pub(crate) struct Window<'a, V: Point> {
    grid: &'a Grid<V>,
    columns: Range<usize>,
    rows: Range<usize>,
}

impl<V: Point> Window<'_, V> {
    /// The rows in the coordinates of kinds, each with its number in the window.
    #[inline(always)]
    pub(crate) fn rows<const N: usize>(&self, part: Range<usize>) -> impl Iterator<Item = (usize, Row<N>)>
    where
        V: Point<Coordinates = [f32; N]>,
    {
        let (first, step) = (self.rows.start, self.grid.step.coordinates()[0]);
        part.map(move |row| {
            let origin = self.grid.point(self.grid.index(0, first + row)).coordinates();
            (row, Row::new(origin, step, self.columns.start))
        })
    }
}

/// Columns and rows of points that are evaluated at once.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub(crate) columns: Range<usize>,
    pub(crate) rows: Range<usize>,
}

impl Block {
    pub(crate) fn width(&self) -> usize {
        self.columns.len()
    }

    pub(crate) fn len(&self) -> usize {
        self.columns.len() * self.rows.len()
    }
}

/// Parts of at most `limit` points: strips of [`POINTS`] columns, divided into blocks of rows.
pub(crate) fn blocks(width: usize, rows: usize, limit: usize) -> impl Iterator<Item = Block> {
    let strip = width.clamp(1, POINTS.min(limit));
    let height = (limit / strip).max(1);
    (0..width).step_by(strip).flat_map(move |column| {
        (0..rows).step_by(height).map(move |row| Block {
            columns: column..width.min(column + strip),
            rows: row..rows.min(row + height),
        })
    })
}

impl<'a, V: Point> Points<'a, V> {
    pub(crate) fn of_rows(grid: &'a Grid<V>, rows: Range<usize>) -> Self {
        Self(Source::Window(Window { grid, columns: 0..grid.width(), rows }))
    }

    pub(crate) fn lists(lists: V::Array<&'a [f32]>) -> Self {
        Self(Source::Lists(lists))
    }

    /// The first points of buffers.
    pub(crate) fn buffered<const M: usize>(buffers: &'a V::Array<[f32; M]>, count: usize) -> Self {
        let list = |axis| buffers.as_ref().get(axis).and_then(|x: &[f32; M]| x.get(..count));
        Self::lists(V::array(|axis| list(axis).unwrap_or_default()))
    }

    /// The number of points of a row.
    pub(crate) fn width(&self) -> usize {
        match &self.0 {
            Source::Lists(lists) => lists.as_ref().first().map_or(0, |x| x.len()),
            Source::Window(window) => window.columns.len(),
        }
    }

    pub(crate) fn rows(&self) -> usize {
        match &self.0 {
            Source::Lists(_) => 1,
            Source::Window(window) => window.rows.len(),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.width().saturating_mul(self.rows())
    }

    /// Parts of at most `limit` points.
    pub(crate) fn blocks(&self, limit: usize) -> impl Iterator<Item = Block> + use<V> {
        blocks(self.width(), self.rows(), limit)
    }

    pub(crate) fn part(&self, block: &Block) -> Points<'_, V> {
        Points(match &self.0 {
            Source::Lists(lists) => {
                let list =
                    |axis| lists.as_ref().get(axis).and_then(|x: &&[f32]| x.get(block.columns.clone()));
                Source::Lists(V::array(|axis| list(axis).unwrap_or_default()))
            }
            Source::Window(Window { grid, columns, rows }) => {
                let moved = |range: &Range<usize>, by: usize| range.start + by..range.end + by;
                let (columns, rows) = (moved(&block.columns, columns.start), moved(&block.rows, rows.start));
                Source::Window(Window { grid, columns, rows })
            }
        })
    }

    pub(crate) fn point(&self, row: usize, column: usize) -> V {
        match &self.0 {
            Source::Lists(lists) => {
                V::from_axes(|axis| lists.as_ref()[axis].get(column).copied().unwrap_or(0.0))
            }
            Source::Window(Window { grid, columns, rows }) => {
                grid.point(grid.index(columns.start + column, rows.start + row))
            }
        }
    }

    /// Writes the coordinates of up to M points, row by row.
    pub(crate) fn write<const M: usize>(&self, lists: &mut [[f32; M]]) {
        let width = self.width().max(1);
        for row in 0..self.rows().min(M / width) {
            let p = self.point(row, 0).coordinates();
            for (axis, list) in lists.iter_mut().enumerate() {
                let list = &mut list[row * width..(row + 1) * width];
                match &self.0 {
                    Source::Lists(lists) => list.copy_from_slice(&lists.as_ref()[axis][..width]),
                    Source::Window(window) if axis == 0 => {
                        for (x, column) in list.iter_mut().zip(window.columns.clone()) {
                            *x = window.grid.x(column);
                        }
                    }
                    Source::Window(_) => list.fill(p.as_ref()[axis]),
                }
            }
        }
    }
}

/// Space for one list of coordinates per axis.
pub(crate) fn buffers<V: Point, const M: usize>() -> V::Array<[f32; M]> {
    V::array(|_| [0.0; M])
}

/// The destination of the values of a batch, and of the gradients if wanted.
///
/// An opaque argument of [`Field::fill`](crate::Field::fill).
#[expect(missing_debug_implementations, reason = "opaque")]
pub struct Target<'a, V: Point> {
    pub(crate) instructions: Instructions,
    pub(crate) values: &'a mut [f32],
    /// One slice per axis, as long as `values`.
    pub(crate) gradients: Option<V::Array<&'a mut [f32]>>,
    /// The distance from row to row.
    pub(crate) stride: usize,
}

impl<V: Point> Target<'_, V> {
    /// The destination for a part of the points.
    pub(crate) fn part(&mut self, block: &Block) -> Target<'_, V> {
        self.after(block.rows.start * self.stride + block.columns.start)
    }

    /// The destination for the points from an index on.
    pub(crate) fn after(&mut self, start: usize) -> Target<'_, V> {
        Target {
            instructions: self.instructions,
            values: self.values.get_mut(start..).unwrap_or_default(),
            gradients: self
                .gradients
                .as_mut()
                .map(|gradients| each::<V, _, _>(gradients, |g| g.get_mut(start..).unwrap_or_default())),
            stride: self.stride,
        }
    }

    /// The destination for `width` points of a row, with as many gradients as values.
    #[inline(always)]
    pub(crate) fn row(&mut self, row: usize, width: usize) -> (&mut [f32], Option<V::Array<&mut [f32]>>) {
        let part = row * self.stride..row * self.stride + width;
        let values = self.values.get_mut(part.clone()).unwrap_or_default();
        let gradients = self
            .gradients
            .as_mut()
            .map(|gradients| each::<V, _, _>(gradients, |g| g.get_mut(part.clone()).unwrap_or_default()));
        (values, gradients)
    }
}

/// Maps one value per axis.
#[inline(always)]
fn each<'a, V: Point, T: 'a, U: Default>(
    things: &'a mut V::Array<T>,
    mut make: impl FnMut(&'a mut T) -> U,
) -> V::Array<U> {
    let mut things = things.as_mut().iter_mut();
    V::array(|_| things.next().map(&mut make).unwrap_or_default())
}

/// Buffers of values and gradients, as an array of N if the dimension is a number.
#[inline(always)]
pub(crate) fn by_axes<V: Point, const N: usize>(mut slices: V::Array<&mut [f32]>) -> [&mut [f32]; N] {
    let mut slices = slices.as_mut().iter_mut();
    array::from_fn(|_| slices.next().map(core::mem::take).unwrap_or_default())
}

/// Space for the values and gradients of up to M points.
pub(crate) struct Buffer<V: Point, const M: usize> {
    pub(crate) values: [f32; M],
    pub(crate) gradients: V::Array<[f32; M]>,
}

impl<V: Point, const M: usize> Buffer<V, M> {
    #[inline(always)]
    pub(crate) fn empty() -> Self {
        Self { values: [0.0; M], gradients: buffers::<V, M>() }
    }

    /// The buffer as a destination for rows of a width.
    pub(crate) fn target(
        &mut self,
        instructions: Instructions,
        width: usize,
        gradients: bool,
    ) -> Target<'_, V> {
        let gradients = gradients.then(|| each::<V, _, _>(&mut self.gradients, |g| &mut g[..]));
        Target { instructions, values: &mut self.values, gradients, stride: width }
    }
}
