//! Surfaces with their reflectance, in the light of a lamp and a soft sky.

use std::f32::consts::PI;

use asperity_shading::{SurfacePoint, material::Material, reflectance::Bsdf};
use glam::Vec3;

use crate::{light::lamps::Lamp, shaded::pixel::Pixel};

/// A lamp, and a soft sky of three more.
#[derive(Clone, Copy, Debug)]
pub struct Sky([Lamp; 4]);

impl Sky {
    /// A sky about a lamp in this direction; half as bright as the lamp, straight up.
    #[must_use]
    pub fn about(lamp: Vec3) -> Self {
        let sky = |k: u8, z: f32| {
            let (turn, r) = (2.1 * f32::from(k), (1.0 - z * z).sqrt());
            Lamp { direction: Vec3::new(r * turn.cos(), r * turn.sin(), z), colour: Vec3::splat(0.25) }
        };
        let lamp = Lamp { direction: lamp.normalize(), colour: Vec3::ONE };
        Self([lamp, sky(1, 0.5), sky(2, 0.87), sky(3, 0.5)])
    }

    /// Radiance of a surface of this BSDF along `view`.
    pub(super) fn on(&self, bsdf: &Bsdf<'_>, view: Vec3) -> Vec3 {
        self.0
            .iter()
            .fold(bsdf.emitted(), |sum, lamp| sum + PI * lamp.colour * bsdf.scattered(lamp.direction, view))
    }
}

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
    pub(super) fn new(
        name: &'static str,
        width: f32,
        radiance: impl Fn(&Pixel, &Sky) -> Vec3 + Send + Sync + 'static,
    ) -> Self {
        Self { name, width, radiance: Box::new(radiance) }
    }

    /// A surface of this material at points moved by a function: the mean over the taps of a pixel.
    pub(super) fn of(
        name: &'static str,
        width: f32,
        material: impl Material + Send + Sync + 'static,
        point: fn(SurfacePoint) -> SurfacePoint,
    ) -> Self {
        Self::new(name, width, move |pixel, sky| {
            pixel.over(|tap, view| sky.on(&material.bsdf(&point(tap), view), view))
        })
    }

    /// The surface whose details come up one octave after another: every pixel is as wide as the next power of two.
    #[must_use]
    pub fn in_steps(self) -> Self {
        Self::new(self.name, self.width, move |pixel, sky| {
            let width = pixel.point.footprint().width();
            let ellipse = pixel.point.pixel.scaled(width.log2().ceil().exp2() / width);
            self.radiance(&Pixel { point: SurfacePoint { pixel: ellipse, ..pixel.point }, ..*pixel }, sky)
        })
    }

    /// Radiance of a sample under a sky.
    pub(super) fn radiance(&self, pixel: &Pixel, sky: &Sky) -> Vec3 {
        (self.radiance)(pixel, sky)
    }
}
