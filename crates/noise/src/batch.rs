//! Rows, grids and lists of points, evaluated in the lanes of a SIMD register.

use core::{error::Error, fmt, ops::Range};

use crate::{
    columns::POINTS,
    field::Field,
    kernel::{Row, put, put_sample},
    lanes::Lanes,
    level::Level,
    point::Point,
    scratch::Scratch,
};

/// Evaluates fields at many points at once, at one SIMD level.
///
/// Every value has the bits that [`Noise::sample`](crate::Noise::sample) and the sums' `sample` give at the same point, at
/// every level. A grid's points are origin + step·index, rounded after the product and after the sum.
///
/// ```
/// use asperity_noise::{Batch, Grid, Noise, Perlin2002, Seeded, glam::Vec2};
///
/// let noise = Perlin2002::default();
/// let grid = Grid { origin: Vec2::new(-3.0, 5.0), step: Vec2::splat(0.05), size: [100, 80] };
/// let (mut values, mut dx, mut dy) = ([0.0; 8000], [0.0; 8000], [0.0; 8000]);
/// Batch::new().fill_grid_with_gradients(&Seeded(noise, 1), &grid, &mut values, [&mut dx, &mut dy])?;
///
/// let sample = noise.sample(grid.point([7, 3]), 1);
/// assert_eq!((values[307], dx[307], dy[307]), (sample.value, sample.gradient.x, sample.gradient.y));
/// # Ok::<(), asperity_noise::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Batch {
    level: Level,
}

impl Default for Batch {
    fn default() -> Self {
        Self::new()
    }
}

impl Batch {
    /// A batch at the best level of this machine; without `std`, at the best level that the program was built for.
    #[must_use]
    pub fn new() -> Self {
        Self { level: Level::best() }
    }

    /// A batch at a level of choice.
    #[must_use]
    pub const fn with_level(level: Level) -> Self {
        Self { level }
    }

    /// The level.
    #[must_use]
    pub const fn level(&self) -> Level {
        self.level
    }

    /// The values at `values.len()` points from `origin` on, `step` apart along the first axis.
    pub fn fill_row<V: Point<N>, F: Field<N>, const N: usize>(
        &self,
        field: &F,
        origin: V,
        step: f32,
        values: &mut [f32],
    ) {
        struct Fill<'a, F, const N: usize>(&'a F, Row<N, false>, &'a mut [f32]);
        impl<F: Field<N>, const N: usize> Task for Fill<'_, F, N> {
            #[inline(always)]
            fn run<S: Lanes>(self, s: S) {
                let mut scratch = Scratch::EMPTY;
                for pass in 0..self.0.passes() {
                    self.0.pass_values(s, pass, &self.1, &mut scratch, self.2);
                }
            }
        }
        self.level.run(Fill(field, Row::new(origin.coordinates(), step, 0), values));
    }

    /// The values on a grid, the first axis running fastest.
    ///
    /// # Errors
    ///
    /// If `values` does not hold as many numbers as the grid has points.
    pub fn fill_grid<V: Point<N>, F: Field<N>, const N: usize>(
        &self,
        field: &F,
        grid: &Grid<V, N>,
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        struct Fill<'a, F, V, const N: usize>(&'a F, &'a Grid<V, N>, &'a mut [f32]);
        impl<V: Point<N>, F: Field<N>, const N: usize> Task for Fill<'_, F, V, N> {
            #[inline(always)]
            fn run<S: Lanes>(self, s: S) {
                let Self(field, grid, values) = self;
                let mut scratch = Scratch::EMPTY;
                for (pass, row, part) in grid.parts(field.passes()) {
                    let values = values.get_mut(part).unwrap_or_default();
                    field.pass_values(s, pass, &row, &mut scratch, values);
                }
            }
        }
        check(values.len(), grid.len())?;
        self.level.run(Fill(field, grid, values));
        Ok(())
    }

    /// Values and gradients on a grid, the first axis running fastest.
    ///
    /// # Errors
    ///
    /// If `values` or a component of `gradients` does not hold as many numbers as the grid has points.
    pub fn fill_grid_with_gradients<V: Point<N>, F: Field<N>, const N: usize>(
        &self,
        field: &F,
        grid: &Grid<V, N>,
        values: &mut [f32],
        gradients: [&mut [f32]; N],
    ) -> Result<(), BatchError> {
        struct Fill<'a, F, V, const N: usize>(&'a F, &'a Grid<V, N>, &'a mut [f32], [&'a mut [f32]; N]);
        impl<V: Point<N>, F: Field<N>, const N: usize> Task for Fill<'_, F, V, N> {
            #[inline(always)]
            fn run<S: Lanes>(self, s: S) {
                let Self(field, grid, values, mut gradients) = self;
                let mut scratch = Scratch::EMPTY;
                for (pass, row, part) in grid.parts(field.passes()) {
                    let values = values.get_mut(part.clone()).unwrap_or_default();
                    let mut slopes =
                        gradients.each_mut().map(|g| g.get_mut(part.clone()).unwrap_or_default());
                    field.pass_samples(s, pass, &row, &mut scratch, values, &mut slopes);
                }
            }
        }
        check(values.len(), grid.len())?;
        gradients.iter().try_for_each(|component| check(component.len(), grid.len()))?;
        self.level.run(Fill(field, grid, values, gradients));
        Ok(())
    }

    /// The values at points given by their coordinates.
    ///
    /// # Errors
    ///
    /// If a list of coordinates is not as long as `values`.
    pub fn fill_points<F: Field<N>, const N: usize>(
        &self,
        field: &F,
        points: [&[f32]; N],
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        struct Fill<'a, F, const N: usize>(&'a F, [&'a [f32]; N], &'a mut [f32]);
        impl<F: Field<N>, const N: usize> Task for Fill<'_, F, N> {
            #[inline(always)]
            fn run<S: Lanes>(self, s: S) {
                let Self(field, points, values) = self;
                for i in (0..values.len()).step_by(S::LEN) {
                    put(s, field.lane_values(s, load(s, &points, i)), values, i, values.len());
                }
            }
        }
        points.iter().try_for_each(|coordinates| check(coordinates.len(), values.len()))?;
        self.level.run(Fill(field, points, values));
        Ok(())
    }

    /// Values and gradients at points given by their coordinates.
    ///
    /// # Errors
    ///
    /// If a list of coordinates or a component of `gradients` is not as long as `values`.
    pub fn fill_points_with_gradients<F: Field<N>, const N: usize>(
        &self,
        field: &F,
        points: [&[f32]; N],
        values: &mut [f32],
        gradients: [&mut [f32]; N],
    ) -> Result<(), BatchError> {
        struct Fill<'a, F, const N: usize>(&'a F, [&'a [f32]; N], &'a mut [f32], [&'a mut [f32]; N]);
        impl<F: Field<N>, const N: usize> Task for Fill<'_, F, N> {
            #[inline(always)]
            fn run<S: Lanes>(self, s: S) {
                let Self(field, points, values, mut gradients) = self;
                for i in (0..values.len()).step_by(S::LEN) {
                    let sample = field.lane_samples(s, load(s, &points, i));
                    put_sample(s, sample, values, &mut gradients, i);
                }
            }
        }
        points.iter().try_for_each(|coordinates| check(coordinates.len(), values.len()))?;
        gradients.iter().try_for_each(|component| check(component.len(), values.len()))?;
        self.level.run(Fill(field, points, values, gradients));
        Ok(())
    }
}

/// As many points as there are lanes, from index `i` on.
#[inline(always)]
fn load<S: Lanes, const N: usize>(s: S, points: &[&[f32]; N], i: usize) -> [S::F; N] {
    let mut p = [s.float(0.0); N];
    for axis in 0..N {
        p[axis] = s.load_part(points[axis].get(i..).unwrap_or_default());
    }
    p
}

/// What is run at a level.
pub(crate) trait Task {
    fn run<S: Lanes>(self, s: S);
}

fn check(length: usize, points: usize) -> Result<(), BatchError> {
    if length == points { Ok(()) } else { Err(BatchError::LengthMismatch { length, points }) }
}

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

    /// The grid in parts of rows, in an order that keeps near what passes and rows share.
    #[inline(always)]
    fn parts(&self, passes: usize) -> Parts<'_, V, N> {
        let width = self.size[0];
        let rows = self.len().checked_div(width).unwrap_or(0);
        let block = (BLOCK / width.clamp(1, POINTS)).max(1);
        Parts { grid: self, passes, rows, block, first: 0, start: 0, pass: 0, row: 0 }
    }

    /// Row r, counted over all axes but the first.
    #[inline(always)]
    fn row(&self, mut r: usize) -> Row<N, false> {
        let mut index = [0; N];
        for (i, n) in index.iter_mut().zip(self.size).skip(1) {
            *i = r % n.max(1);
            r /= n.max(1);
        }
        Row::new(self.point(index).coordinates(), self.step.coordinates()[0], 0)
    }
}

/// Points that are gone through before the next pass: as many as a near cache holds.
const BLOCK: usize = 8192;

/// The parts of a grid's rows: in strips of [`POINTS`], in blocks of rows, in passes over a block.
struct Parts<'a, V, const N: usize> {
    grid: &'a Grid<V, N>,
    passes: usize,
    rows: usize,
    block: usize,
    /// The block's first row.
    first: usize,
    /// The strip's first point.
    start: usize,
    pass: usize,
    /// The row within the block.
    row: usize,
}

impl<V: Point<N>, const N: usize> Iterator for Parts<'_, V, N> {
    type Item = (usize, Row<N, false>, Range<usize>);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        let width = self.grid.size[0];
        if self.start >= width || self.first + self.row >= self.rows {
            return None;
        }
        let (r, end) = (self.first + self.row, width.min(self.start + POINTS));
        let part = r * width + self.start..r * width + end;
        let item = (self.pass, self.grid.row(r).after(self.start), part);
        self.row += 1;
        if self.row == self.block || self.first + self.row == self.rows {
            self.row = 0;
            self.pass += 1;
            if self.pass == self.passes {
                self.pass = 0;
                self.first += self.block;
                if self.first >= self.rows {
                    self.first = 0;
                    self.start = end;
                }
            }
        }
        Some(item)
    }
}

/// Why a batch was refused; nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BatchError {
    /// A slice does not hold one number per point.
    LengthMismatch {
        /// The slice's length.
        length: usize,
        /// The number of points.
        points: usize,
    },
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LengthMismatch { length, points } => {
                write!(f, "a slice of length {length} does not hold one number for each of {points} points")
            }
        }
    }
}

impl Error for BatchError {}
