//! Rows, grids and lists of points, evaluated in the lanes of a SIMD register.

use core::{error::Error, fmt};

use crate::{
    batch::grid::Grid,
    contract::field::Field,
    contract::kernel::{Row, put, put_sample},
    contract::point::Point,
    row::scratch::Scratch,
    simd::lanes::Lanes,
    simd::level::Level,
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
                let mut scratch = Scratch::empty();
                for pass in 0..self.0.passes() {
                    self.0.pass_values(s, pass, &self.1, &mut scratch, self.2);
                }
            }
        }
        let row = Row::new(origin.coordinates(), step, 0);
        if values.len() < FEW_POINTS {
            let points = list(|i| row.point(i), values.len());
            self.level.run(Points(field, points.each_ref().map(|x| &x[..values.len()]), values));
        } else {
            self.level.run(Fill(field, row, values));
        }
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
                let mut scratch = Scratch::empty();
                for (pass, row, part) in grid.parts(field.passes()) {
                    let values = values.get_mut(part).unwrap_or_default();
                    field.pass_values(s, pass, &row, &mut scratch, values);
                }
            }
        }
        check(values.len(), grid.len())?;
        if values.len() < FEW_POINTS {
            let points = list(|i| grid.numbered(i), values.len());
            self.level.run(Points(field, points.each_ref().map(|x| &x[..values.len()]), values));
        } else {
            self.level.run(Fill(field, grid, values));
        }
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
                let mut scratch = Scratch::empty();
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
        if values.len() < FEW_POINTS {
            let points = list(|i| grid.numbered(i), values.len());
            let points = points.each_ref().map(|x| &x[..values.len()]);
            self.level.run(PointsWithGradients(field, points, values, gradients));
        } else {
            self.level.run(Fill(field, grid, values, gradients));
        }
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
        points.iter().try_for_each(|coordinates| check(coordinates.len(), values.len()))?;
        self.level.run(Points(field, points, values));
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
        points.iter().try_for_each(|coordinates| check(coordinates.len(), values.len()))?;
        gradients.iter().try_for_each(|component| check(component.len(), values.len()))?;
        self.level.run(PointsWithGradients(field, points, values, gradients));
        Ok(())
    }
}

/// From so many points on they share enough to pay for the room that it takes.
const FEW_POINTS: usize = 256;

/// The coordinates of fewer points than that, one list per axis.
fn list<const N: usize>(point: impl Fn(usize) -> [f32; N], count: usize) -> [[f32; FEW_POINTS]; N] {
    let mut points = [[0.0; FEW_POINTS]; N];
    for i in 0..count.min(FEW_POINTS) {
        for (x, list) in point(i).into_iter().zip(&mut points) {
            list[i] = x;
        }
    }
    points
}

/// A field's values at points.
struct Points<'a, F, const N: usize>(&'a F, [&'a [f32]; N], &'a mut [f32]);

impl<F: Field<N>, const N: usize> Task for Points<'_, F, N> {
    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self(field, points, values) = self;
        for i in (0..values.len()).step_by(S::LEN) {
            put(s, field.lane_values(s, load(s, &points, i)), values, i, values.len());
        }
    }
}

/// A field's values and gradients at points.
struct PointsWithGradients<'a, F, const N: usize>(&'a F, [&'a [f32]; N], &'a mut [f32], [&'a mut [f32]; N]);

impl<F: Field<N>, const N: usize> Task for PointsWithGradients<'_, F, N> {
    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self(field, points, values, mut gradients) = self;
        for i in (0..values.len()).step_by(S::LEN) {
            let sample = field.lane_samples(s, load(s, &points, i));
            put_sample(s, sample, values, &mut gradients, i);
        }
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
