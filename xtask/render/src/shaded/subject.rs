//! A surface with its reflectance.

use asperity_shading::glam::Vec3;

use crate::shaded::{light::Sky, pixel::Pixel};

type Radiance = dyn Fn(&Pixel, &Sky) -> Vec3 + Send + Sync;

/// A surface, and how it is looked at.
pub struct Subject {
    /// Its name.
    pub name: &'static str,
    /// The width of a pixel that sees nothing of its details.
    pub width: f32,
    radiance: Box<Radiance>,
}

impl Subject {
    /// A surface with this radiance, in positions of its own unit.
    pub fn new(
        name: &'static str,
        width: f32,
        radiance: impl Fn(&Pixel, &Sky) -> Vec3 + Send + Sync + 'static,
    ) -> Self {
        Self { name, width, radiance: Box::new(radiance) }
    }

    /// Radiance of a sample under a sky.
    #[must_use]
    pub fn radiance(&self, pixel: &Pixel, sky: &Sky) -> Vec3 {
        (self.radiance)(pixel, sky)
    }
}
