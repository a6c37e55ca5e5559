//! Batches at a SIMD level of choice.

use asperity_core::BatchError;

use crate::{
    contract::field::Field, contract::many, lanes::level::Level, point::Point, row::grid::Grid,
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
        many::values(self.level, &|points, target| field.fill(points, target), points, values)
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
        many::samples(self.level, &|points, target| field.fill(points, target), points, samples)
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
        many::grid(self.level, &|points, target| field.fill(points, target), grid, values, None)
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
        many::grid(self.level, &|points, target| field.fill(points, target), grid, values, Some(gradients))
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
        many::lists(self.level, &|points, target| field.fill(points, target), points, values, None)
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
        many::lists(self.level, &|points, target| field.fill(points, target), points, values, Some(gradients))
    }
}
