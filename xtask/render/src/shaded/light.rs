//! A lamp and a soft sky, and what a surface sends of them to the eye.

use std::f32::consts::PI;

use asperity_shading::glam::Vec3;
use asperity_shading::reflectance::Bsdf;

/// A distant lamp.
#[derive(Clone, Copy, Debug)]
pub(super) struct Light {
    /// The unit direction to it.
    pub(super) direction: Vec3,
    /// Radiance of a white Lambertian surface that faces it.
    pub(super) radiance: f32,
}

/// A lamp, and a soft sky of three more.
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    /// The lamp, then the sky.
    pub(super) lights: [Light; 4],
}

impl Sky {
    /// A sky about a lamp in this direction; half as bright as the lamp, straight up.
    #[must_use]
    pub fn about(lamp: Vec3) -> Self {
        let sky = |k: u8, z: f32| {
            let (turn, r) = (2.1 * f32::from(k), (1.0 - z * z).sqrt());
            Light { direction: Vec3::new(r * turn.cos(), r * turn.sin(), z), radiance: 0.25 }
        };
        let lamp = Light { direction: lamp.normalize(), radiance: 1.0 };
        Self { lights: [lamp, sky(1, 0.5), sky(2, 0.87), sky(3, 0.5)] }
    }

    /// Radiance of a surface of this BSDF along `view`.
    pub(super) fn on(&self, bsdf: &Bsdf<'_>, view: Vec3) -> Vec3 {
        self.lights.iter().fold(bsdf.emitted(), |sum, light| {
            sum + PI * light.radiance * bsdf.scattered(light.direction, view)
        })
    }
}
