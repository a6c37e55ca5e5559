//! Batches at a chosen SIMD level.

use asperity_core::BatchError;

use crate::{
    contract::field::Field, contract::many, lanes::level::Level, point::Point, row::grid::Grid,
    sample::Sample,
};

/// Evaluates fields at a chosen SIMD level, for tests and benchmarks.
///
/// The methods of [`Field`] use the best level of the machine. The bits are the same at every
/// level.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec2, simd::{Batch, Level}};
///
/// let (noise, points) = (Perlin::new(1), [Vec2::new(0.3, 1.7), Vec2::new(-2.4, 0.1)]);
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
    /// Creates a batch evaluator at the best SIMD level of this machine.
    ///
    /// Without `std` it uses the best level that the program was compiled for.
    #[must_use]
    pub fn new() -> Self {
        Self { level: Level::best() }
    }

    /// Creates a batch evaluator at the given level.
    #[must_use]
    pub const fn with_level(level: Level) -> Self {
        Self { level }
    }

    /// Returns the SIMD level.
    #[must_use]
    pub const fn level(&self) -> Level {
        self.level
    }

    /// Evaluates [`Field::values`] at the level.
    ///
    /// # Errors
    ///
    /// If the lengths of `values` and `points` differ.
    pub fn values<V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        points: &[V],
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        many::values(self.level, &|points, target| field.fill(points, target), points, values)
    }

    /// Evaluates [`Field::samples`] at the level.
    ///
    /// # Errors
    ///
    /// If the lengths of `samples` and `points` differ.
    pub fn samples<V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        points: &[V],
        samples: &mut [Sample<V>],
    ) -> Result<(), BatchError> {
        many::samples(self.level, &|points, target| field.fill(points, target), points, samples)
    }

    /// Evaluates [`Field::grid_values`] at the level.
    ///
    /// # Errors
    ///
    /// If the length of `values` is not the number of grid points.
    pub fn grid_values<V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        grid: &Grid<V>,
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        many::grid(self.level, &|points, target| field.fill(points, target), grid, values, None)
    }

    /// Evaluates [`Field::grid_samples`] at the level.
    ///
    /// # Errors
    ///
    /// If the length of `values` or of a component of `gradients` is not the number of grid points.
    pub fn grid_samples<'a, V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        grid: &Grid<V>,
        values: &'a mut [f32],
        gradients: V::Array<&'a mut [f32]>,
    ) -> Result<(), BatchError> {
        many::grid(self.level, &|points, target| field.fill(points, target), grid, values, Some(gradients))
    }

    /// Evaluates values at points given by one list of coordinates per axis.
    ///
    /// # Errors
    ///
    /// If the lengths of `values` and the lists differ.
    pub fn list_values<V: Point, F: Field<V> + ?Sized>(
        &self,
        field: &F,
        points: V::Array<&[f32]>,
        values: &mut [f32],
    ) -> Result<(), BatchError> {
        many::lists(self.level, &|points, target| field.fill(points, target), points, values, None)
    }

    /// Evaluates values and gradients at points given by one list of coordinates per axis.
    ///
    /// # Errors
    ///
    /// If the lengths of `values`, the components of `gradients` and the lists differ.
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
