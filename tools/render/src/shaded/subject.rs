//! Surfaces with their reflectance, under a lamp and a soft sky.

use std::f32::consts::PI;

use asperity_shading::{SurfacePoint, material::Material, reflectance::Bsdf};
use glam::Vec3;

use crate::{light::lamps::Lamp, shaded::pixel::Pixel};

/// A lamp, and a soft sky of three lamps.
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    lamp: Lamp,
    soft: [Lamp; 3],
}

impl Sky {
    /// Creates a sky about a lamp in this direction. Straight up it is half as bright as the lamp.
    #[must_use]
    pub fn about(lamp: Vec3) -> Self {
        let sky = |k: u8, z: f32| {
            let (turn, r) = (2.1 * f32::from(k), (1.0 - z * z).sqrt());
            Lamp { direction: Vec3::new(r * turn.cos(), r * turn.sin(), z), color: Vec3::splat(0.25) }
        };
        let lamp = Lamp { direction: lamp.normalize(), color: Vec3::ONE };
        Self { lamp, soft: [sky(1, 0.5), sky(2, 0.87), sky(3, 0.5)] }
    }

    /// Adds the radiances of a BSDF along `view`, one per sky. The soft part is the same for all.
    pub(super) fn add(skies: &[Self], bsdf: &Bsdf<'_>, view: Vec3, radiances: &mut [Vec3]) {
        let scattered = |lamp: &Lamp| PI * lamp.color * bsdf.eval_cos(view, lamp.direction);
        let soft = skies.first().map(|sky| sky.soft.each_ref().map(scattered)).unwrap_or_default();
        for (radiance, sky) in radiances.iter_mut().zip(skies) {
            *radiance += soft.iter().fold(bsdf.emitted() + scattered(&sky.lamp), |sum, soft| sum + soft);
        }
    }
}

/// Writes the radiances of a sample, one per sky.
type Radiance = dyn Fn(&Pixel, &[Sky], &mut [Vec3]) + Send + Sync;

/// A surface and its viewing parameters.
pub struct Subject {
    /// Its name.
    pub name: &'static str,
    /// The width of a pixel that resolves no detail.
    pub width: f32,
    radiance: Box<Radiance>,
}

impl Subject {
    /// Creates a surface from a function that writes radiances, one per sky, at positions in the
    /// surface's unit.
    pub(super) fn new(
        name: &'static str,
        width: f32,
        radiance: impl Fn(&Pixel, &[Sky], &mut [Vec3]) + Send + Sync + 'static,
    ) -> Self {
        Self { name, width, radiance: Box::new(radiance) }
    }

    /// Creates a surface of this material at transformed points, averaged over the taps of a pixel.
    pub(super) fn of(
        name: &'static str,
        width: f32,
        material: impl Material + Send + Sync + 'static,
        point: fn(SurfacePoint) -> SurfacePoint,
    ) -> Self {
        Self::new(name, width, move |pixel, skies, radiances| {
            pixel.over(radiances, |tap, view, sums| {
                Sky::add(skies, &material.bsdf(&point(tap), view), view, sums);
            });
        })
    }

    /// Returns the surface with octaves that appear one after another: pixel widths are rounded up
    /// to powers of two.
    #[must_use]
    pub fn in_steps(self) -> Self {
        Self::new(self.name, self.width, move |pixel, skies, radiances| {
            let width = pixel.point.footprint().width();
            let ellipse = pixel.point.pixel.scaled(width.log2().ceil().exp2() / width);
            let point = SurfacePoint { pixel: ellipse, ..pixel.point };
            (self.radiance)(&Pixel { point, ..*pixel }, skies, radiances);
        })
    }

    /// Returns the radiances of a sample under these skies.
    pub(super) fn radiances<const K: usize>(&self, pixel: &Pixel, skies: &[Sky; K]) -> [Vec3; K] {
        let mut radiances = [Vec3::ZERO; K];
        (self.radiance)(pixel, skies, &mut radiances);
        radiances
    }
}
