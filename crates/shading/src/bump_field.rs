//! A bump map in space: a Gaussian field, its scale, and what a pixel resolves of it.

use glam::Vec3;

use crate::{Coordinates, Footprint, FrequencyClamp, FrequencyClampError, GaussianField};

/// A Gaussian field laid into space with a given size of bumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BumpField<F> {
    field: F,
    clamp: FrequencyClamp,
}

impl<F: GaussianField> BumpField<F> {
    /// The field whose first octave has `frequency` lattice cells per unit of the surface's positions.
    ///
    /// Lacunarity and greatest count of octaves are the field's own.
    ///
    /// # Errors
    /// [`FrequencyClampError::Frequency`] unless `frequency` is finite and positive; the other two where the field
    /// breaks its promise.
    pub fn new(field: F, frequency: f32) -> Result<Self, FrequencyClampError> {
        let clamp = FrequencyClamp::new(frequency, field.lacunarity(), field.max_octaves())?;
        Ok(Self { field, clamp })
    }

    /// The field.
    #[must_use]
    pub const fn field(&self) -> &F {
        &self.field
    }

    /// How many octaves each footprint resolves.
    #[must_use]
    pub const fn clamp(&self) -> &FrequencyClamp {
        &self.clamp
    }

    /// The real number of octaves that a pixel of this footprint resolves; see [`FrequencyClamp`].
    #[must_use]
    pub fn octaves(&self, footprint: Footprint) -> f32 {
        self.clamp.octaves(footprint)
    }

    /// The coordinates of the bump map at the surface point `p`, as far as the footprint resolves them.
    ///
    /// Continuous in `p` and in the footprint, and [`Coordinates::FAR`] as soon as the pixel is wider than half a
    /// cell of the first octave.
    #[must_use]
    pub fn coordinates(&self, p: Vec3, footprint: Footprint) -> Coordinates {
        self.field.coordinates(p * self.clamp.frequency(), self.octaves(footprint))
    }
}
