//! A lamp and a soft sky, and what a surface sends of them to the eye.

use std::f32::consts::PI;

use asperity_shading::glam::Vec3;
use asperity_shading::{Brdf, Frame, facing};

/// A distant lamp.
#[derive(Clone, Copy, Debug)]
pub(super) struct Light {
    /// The unit direction to it.
    pub(super) direction: Vec3,
    /// What a white Lambertian surface that faces it sends to the eye.
    pub(super) radiance: f32,
}

impl Light {
    /// What it sends along `view` from a flat surface, for a reflectance of 1.
    pub(super) fn on_flat(&self) -> f32 {
        PI * self.radiance * self.direction.z.max(0.0)
    }
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

    /// What a surface of this reflectance and normal sends along `view`.
    pub(super) fn on(&self, brdf: &(impl Brdf + ?Sized), normal: Vec3, view: Vec3) -> Vec3 {
        let frame = Frame::from_normal_tangent(facing(Vec3::Z, normal, view), Vec3::X);
        let wo = frame.to_local(view);
        self.lights.iter().fold(Vec3::ZERO, |sum, light| {
            let wi = frame.to_local(light.direction);
            sum + PI * light.radiance * wi.z.max(0.0) * brdf.value(wi, wo)
        })
    }
}

/// What the facets of a surface send along `view`: the mean over them.
pub(super) fn on_facets(
    sky: &Sky,
    brdf: &impl Brdf,
    facets: impl Iterator<Item = (f32, Vec3)>,
    view: Vec3,
) -> Vec3 {
    facets.fold(Vec3::ZERO, |sum, (share, normal)| sum + share * sky.on(brdf, normal, view))
}

/// Two reflectances of one surface.
pub(super) struct Both<A, B>(pub(super) A, pub(super) B);

impl<A: Brdf, B: Brdf> Brdf for Both<A, B> {
    fn value(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        self.0.value(wi, wo) + self.1.value(wi, wo)
    }
}
