//! A scene: shapes with materials, lights, and the background.

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

/// A material that threads can share.
pub type Surface<'a> = dyn Material + Sync + 'a;

/// A shape with its material.
pub struct Object<'a> {
    pub shape: Arc<Shape>,
    pub material: Box<Surface<'a>>,
    /// The origin of the positions passed to its material.
    pub anchor: DVec3,
    /// The fraction of light that passes through the object into its shadow: for glass all of it,
    /// or a part.
    pub passes: f32,
    /// The inside of a refracting body. Other objects are the same on both sides.
    pub body: Option<Absorption>,
}

impl<'a> Object<'a> {
    /// Creates an object that casts a shadow, whose material receives world positions.
    pub fn new(shape: impl Into<Arc<Shape>>, material: impl Material + Sync + 'a) -> Self {
        let (shape, material) = (shape.into(), Box::new(material));
        Self { shape, material, anchor: DVec3::ZERO, passes: 0.0, body: None }
    }

    /// Returns the object with material positions relative to an anchor, as for sums of octaves
    /// that are [anchored](asperity_noise::Fbm::anchored).
    pub fn anchored(self, anchor: DVec3) -> Self {
        Self { anchor, ..self }
    }

    /// Creates an object whose BSDF is computed by a function.
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

/// Light of a scene, which selects the integrator.
pub enum Light<'a> {
    /// Lamps, rendered by [`direct`](crate::integrator::direct), and the room visible in mirrors.
    Lamps { lamps: Vec<Lamps>, room: &'a (dyn Fn(&Ray) -> Vec3 + Sync) },
    /// An environment, rendered by [`path_tracer`](crate::integrator::path_tracer).
    Around(&'a dyn Surroundings),
}

impl Light<'_> {
    /// Creates lamps in a dark room.
    pub fn lamps(lamps: Vec<Lamps>) -> Self {
        Self::Lamps { lamps, room: &|_| Vec3::ZERO }
    }
}

/// Background of the camera.
#[derive(Clone, Copy)]
pub enum Backdrop {
    /// A gradient over the image.
    Studio,
    /// A constant color.
    Color(Vec3),
    /// The environment, or the room.
    Light,
}

/// Objects in a light.
pub struct Scene<'m, 'l> {
    pub objects: Vec<Object<'m>>,
    pub light: Light<'l>,
    pub backdrop: Backdrop,
    /// The focus: rays and hits are relative to it, and exact near it at any zoom.
    pub focus: DVec3,
    /// Offset of rays from the surface they leave, relative to its distance from the viewer.
    pub start: f32,
}

impl<'m, 'l> Scene<'m, 'l> {
    /// Creates a scene about the origin, with a ray offset of 3e-4.
    pub fn new(objects: Vec<Object<'m>>, light: Light<'l>, backdrop: Backdrop) -> Self {
        Self { objects, light, backdrop, focus: DVec3::ZERO, start: 3e-4 }
    }

    /// Returns the scene about another focus.
    pub fn about(self, focus: DVec3) -> Self {
        Self { focus, ..self }
    }

    /// Returns the nearest intersection of a ray with an object.
    pub fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<Meeting<'_, 'm>> {
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

    /// Returns the fraction of the light from a direction that reaches a point.
    pub fn open(&self, origin: Vec3, direction: Vec3) -> f32 {
        let probe = Probe::about(self.focus, origin, direction);
        let hides = |object: &&Object<'_>| object.passes < 1.0 && object.shape.hides(&probe);
        self.objects.iter().filter(hides).map(|object| object.passes).product()
    }

    /// Returns the radiance behind the objects: for a camera ray through a position of the image,
    /// or for any other ray.
    pub fn behind(&self, ray: &Ray, place: Option<[f32; 2]>) -> Vec3 {
        match (self.backdrop, place, &self.light) {
            (Backdrop::Studio, Some([x, y]), _) => background(x, y),
            (Backdrop::Color(color), Some(_), _) => color,
            (.., Light::Around(light)) => light.radiance(ray.direction),
            (.., Light::Lamps { room, .. }) => {
                room(&Ray { origin: (self.focus + ray.origin.as_dvec3()).as_vec3(), ..*ray })
            }
        }
    }
}
