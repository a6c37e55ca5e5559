//! Fields at many points: lists and grids, checked and handed on at one SIMD level.

use core::{error::Error, fmt};

use crate::{
    contract::field::Field,
    lanes::level::Level,
    point::Point,
    row::grid::Grid,
    row::points::{Buffer, Points, Target, buffers},
    sample::Sample,
};

/// Evaluates fields at a SIMD level of choice, for tests and benchmarks.
///
/// The methods of [`Field`] do the same at the best level of the machine, and the bits are the same at every level.
///
/// ```
/// use asperity_noise::{Field, Perlin2002, glam::Vec2, simd::{Batch, Level}};
///
/// let (noise, points) = (Perlin2002::new(1), [Vec2::new(0.3, 1.7), Vec2::new(-2.4, 0.1)]);
/// let mut values = [0.0; 2];
/// Batch::with_level(Level::Scalar).values(&noise, &points, &mut values)?;
/// assert_eq!(values, points.map(|p| noise.value(p)));
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

/// Points that are gone through at once where their coordinates lie point by point.
const LIST: usize = 128;

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

    /// [`Field::values`] at the level.
    ///
    /// # Errors
    ///
    /// If `values` is not as long as `points`.
    pub fn values<V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        points: &[V],
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        check("values", points.len(), values.len())?;
        let instructions = self.level.instructions();
        let mut lists = buffers::<V, LIST>();
        for (points, values) in points.chunks(LIST).zip(values.chunks_mut(LIST)) {
            write::<V>(points, &mut lists);
            let stride = points.len();
            let points = Points::buffered(&lists, stride);
            field.fill(&points, Target { instructions, values, gradients: None, stride });
        }
        Ok(())
    }

    /// [`Field::samples`] at the level.
    ///
    /// # Errors
    ///
    /// If `samples` is not as long as `points`.
    pub fn samples<V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        points: &[V],
        samples: &mut [Sample<V>],
    ) -> Result<(), BatchError> {
        check("samples", points.len(), samples.len())?;
        let instructions = self.level.instructions();
        let (mut lists, mut buffer) = (buffers::<V, LIST>(), Buffer::<V, LIST>::empty());
        for (points, samples) in points.chunks(LIST).zip(samples.chunks_mut(LIST)) {
            write::<V>(points, &mut lists);
            let points = Points::buffered(&lists, points.len());
            field.fill(&points, buffer.target(instructions, samples.len(), true));
            for (i, sample) in samples.iter_mut().enumerate() {
                let gradient = V::from_axes(|axis| buffer.gradients.as_ref()[axis][i]);
                *sample = Sample { value: buffer.values[i], gradient };
            }
        }
        Ok(())
    }

    /// [`Field::grid_values`] at the level.
    ///
    /// # Errors
    ///
    /// If `values` does not hold as many numbers as the grid has points.
    pub fn grid_values<V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        grid: &Grid<V>,
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        check("values", grid.len(), values.len())?;
        let instructions = self.level.instructions();
        field.fill(
            &Points::of_grid(grid),
            Target { instructions, values, gradients: None, stride: grid.width() },
        );
        Ok(())
    }

    /// [`Field::grid_samples`] at the level.
    ///
    /// # Errors
    ///
    /// If `values` or a component of `gradients` does not hold as many numbers as the grid has points.
    pub fn grid_samples<'a, V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        grid: &Grid<V>,
        values: &'a mut [f32],
        gradients: V::Array<&'a mut [f32]>,
    ) -> Result<(), BatchError> {
        check("values", grid.len(), values.len())?;
        gradients
            .as_ref()
            .iter()
            .try_for_each(|component| check("gradients", grid.len(), component.len()))?;
        let (instructions, stride) = (self.level.instructions(), grid.width());
        field.fill(
            &Points::of_grid(grid),
            Target { instructions, values, gradients: Some(gradients), stride },
        );
        Ok(())
    }

    /// The values at points given by lists of their coordinates, one for each axis.
    ///
    /// # Errors
    ///
    /// If `values` is not as long as each list.
    pub fn list_values<V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        points: V::Array<&[f32]>,
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        points.as_ref().iter().try_for_each(|list| check("values", list.len(), values.len()))?;
        let (instructions, stride) = (self.level.instructions(), values.len());
        field.fill(&Points::lists(points), Target { instructions, values, gradients: None, stride });
        Ok(())
    }

    /// Values and gradients at points given by lists of their coordinates, one for each axis.
    ///
    /// # Errors
    ///
    /// If `values` or a component of `gradients` is not as long as each list.
    pub fn list_samples<'a, V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        points: V::Array<&[f32]>,
        values: &'a mut [f32],
        gradients: V::Array<&'a mut [f32]>,
    ) -> Result<(), BatchError> {
        points.as_ref().iter().try_for_each(|list| check("values", list.len(), values.len()))?;
        gradients.as_ref().iter().try_for_each(|list| check("gradients", values.len(), list.len()))?;
        let (instructions, stride) = (self.level.instructions(), values.len());
        field.fill(
            &Points::lists(points),
            Target { instructions, values, gradients: Some(gradients), stride },
        );
        Ok(())
    }
}

/// The coordinates of points as one list for each axis.
#[inline]
fn write<V: Point>(points: &[V], lists: &mut V::Array<[f32; LIST]>) {
    for (i, p) in points.iter().take(LIST).enumerate() {
        for (list, x) in lists.as_mut().iter_mut().zip(p.coordinates().as_ref()) {
            list[i] = *x;
        }
    }
}

fn check(parameter: &'static str, expected: usize, got: usize) -> Result<(), BatchError> {
    if got == expected { Ok(()) } else { Err(BatchError { parameter, expected, got }) }
}

/// A slice that does not hold one element for each point; nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BatchError {
    /// The name of the slice.
    pub parameter: &'static str,
    /// The number of points.
    pub expected: usize,
    /// The slice's length.
    pub got: usize,
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { parameter, expected, got } = self;
        write!(f, "`{parameter}` must have {expected} elements, got {got}")
    }
}

impl Error for BatchError {}
