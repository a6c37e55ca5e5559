//! A scene: shapes of materials, the light that falls on them, and what is behind them.

use std::sync::Arc;

use asperity_shading::{
    SurfacePoint,
    material::Material,
    reflectance::{Absorption, Bsdf},
};
use glam::{DVec3, Vec3};

use crate::{
    geometry::{
        mesh::Probe,
        ray::{Hit, Ray},
        shape::{Met, Shape},
    },
    light::{background, environments::Surroundings, lamps::Lamps},
    materials::Shaded,
};

/// A material that threads may share.
pub type Surface<'a> = dyn Material + Sync + 'a;

/// A shape with its material.
pub struct Object<'a> {
    pub shape: Arc<Shape>,
    pub material: Box<Surface<'a>>,
    /// The place that its material is told positions from.
    pub anchor: DVec3,
    /// The share of light that goes through it to what is in its shadow: of glass all, or some.
    pub passes: f32,
    /// The inside of a body that refracts; anything else is the same on both sides.
    pub body: Option<Absorption>,
}

impl<'a> Object<'a> {
    /// An object that casts a shadow, whose material is told positions in the world.
    pub fn new(shape: impl Into<Arc<Shape>>, material: impl Material + Sync + 'a) -> Self {
        let (shape, material) = (shape.into(), Box::new(material));
        Self { shape, material, anchor: DVec3::ZERO, passes: 0.0, body: None }
    }

    /// The object whose material is told positions from an anchor on, as sums of octaves are that are
    /// [anchored](asperity_noise::Octaves::anchored).
    pub fn anchored(self, anchor: DVec3) -> Self {
        Self { anchor, ..self }
    }

    /// An object whose BSDF a function gives.
    pub fn shaded(
        shape: impl Into<Arc<Shape>>,
        bsdf: impl Fn(&SurfacePoint, Vec3) -> Bsdf<'static> + Sync + 'a,
    ) -> Self {
        Self::new(shape, Shaded(bsdf))
    }
}

/// A hit on an object.
#[derive(Clone, Copy)]
pub struct Meeting<'s, 'm> {
    pub object: &'s Object<'m>,
    pub hit: Hit,
}

/// Light of a scene, which decides on the integrator.
pub enum Light<'a> {
    /// Lamps, by [`direct`](crate::integrator::direct), and the room that mirrors show.
    Lamps { lamps: Vec<Lamps>, room: &'a (dyn Fn(&Ray) -> Vec3 + Sync) },
    /// Light from all around, by [`path_tracer`](crate::integrator::path_tracer).
    Around(&'a dyn Surroundings),
}

impl Light<'_> {
    /// Lamps in a dark room.
    pub fn lamps(lamps: Vec<Lamps>) -> Self {
        Self::Lamps { lamps, room: &|_| Vec3::ZERO }
    }
}

/// Background of the camera.
#[derive(Clone, Copy)]
pub enum Backdrop {
    /// A gradient over the picture.
    Studio,
    /// A colour.
    Colour(Vec3),
    /// The light from all around, or the room.
    Light,
}

/// Shapes of materials in a light.
pub struct Scene<'m, 'l> {
    pub objects: Vec<Object<'m>>,
    pub light: Light<'l>,
    pub backdrop: Backdrop,
    /// The point that is looked at: rays and hits are told from it on, and near it they are exact at any zoom.
    pub focus: DVec3,
    /// Offset of rays from what they leave, over its distance from the eye.
    pub start: f32,
}

impl<'m, 'l> Scene<'m, 'l> {
    /// A scene about the origin, for rays that start three ten-thousandths of their length from what they leave.
    pub fn new(objects: Vec<Object<'m>>, light: Light<'l>, backdrop: Backdrop) -> Self {
        Self { objects, light, backdrop, focus: DVec3::ZERO, start: 3e-4 }
    }

    /// The scene about another point that is looked at.
    pub fn about(self, focus: DVec3) -> Self {
        Self { focus, ..self }
    }

    /// The nearest meeting of a ray with an object.
    pub fn first_hit(&self, origin: Vec3, direction: Vec3) -> Option<Meeting<'_, 'm>> {
        let probe = Probe::about(self.focus, origin, direction);
        let mut nearest: Option<(&Object<'m>, Met)> = None;
        for object in &self.objects {
            let farthest = nearest.as_ref().map_or(f32::INFINITY, |(_, met)| met.distance());
            if let Some(met) = object.shape.meets(&probe, farthest) {
                nearest = Some((object, met));
            }
        }
        let (object, met) = nearest?;
        object.shape.hit(&probe, met).map(|hit| Meeting { object, hit })
    }

    /// The share of the light from a direction that comes to a point.
    pub fn open(&self, origin: Vec3, direction: Vec3) -> f32 {
        let probe = Probe::about(self.focus, origin, direction);
        let hides = |object: &&Object<'_>| object.passes < 1.0 && object.shape.hides(&probe);
        self.objects.iter().filter(hides).map(|object| object.passes).product()
    }

    /// Radiance behind the objects: along a ray of the camera through a place of the picture, or along any other ray.
    pub fn behind(&self, ray: &Ray, place: Option<[f32; 2]>) -> Vec3 {
        match (self.backdrop, place, &self.light) {
            (Backdrop::Studio, Some([x, y]), _) => background(x, y),
            (Backdrop::Colour(colour), Some(_), _) => colour,
            (.., Light::Around(light)) => light.radiance(ray.direction),
            (.., Light::Lamps { room, .. }) => {
                room(&Ray { origin: (self.focus + ray.origin.as_dvec3()).as_vec3(), ..*ray })
            }
        }
    }
}
