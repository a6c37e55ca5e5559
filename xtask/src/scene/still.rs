//! Still lifes: a few objects on a table under the studio's lights, each surface with a reflectance of its own.

use std::f32::consts::PI;

use asperity_shading::{Brdf, Frame, SurfacePoint};
use glam::Vec3;

use super::{camera::Camera, lights::Light, material::sky, mesh::TracedMesh, render::hash, shape::Hit};

/// What a surface is at a point: its shading normal and what it does to light.
pub(crate) struct Surface {
    pub(crate) normal: Vec3,
    pub(crate) brdf: Box<dyn Brdf>,
    /// What it does to light from all around.
    pub(crate) albedo: Vec3,
}

/// The surface at a point.
pub(crate) type Finish<'a> = dyn Fn(&SurfacePoint) -> Surface + Sync + 'a;

/// Objects and lights.
pub(crate) struct Still<'a> {
    pub(crate) objects: Vec<(TracedMesh, Box<Finish<'a>>)>,
    pub(crate) lights: Vec<Light>,
}

impl Still<'_> {
    /// The nearest object in front of `origin`, and which it is.
    pub(crate) fn first_hit(&self, origin: Vec3, direction: Vec3) -> Option<(usize, Hit)> {
        self.objects
            .iter()
            .enumerate()
            .filter_map(|(k, (mesh, _))| Some((k, mesh.first_hit(origin, direction)?)))
            .min_by(|a, b| a.1.t.total_cmp(&b.1.t))
    }

    /// The radiance of what a ray of the camera meets, with the distance to it.
    pub(crate) fn radiance(&self, camera: &Camera, direction: Vec3) -> Option<(Vec3, f32)> {
        let (object, hit) = self.first_hit(camera.eye(), direction)?;
        let hit = hit.facing(direction);
        let (_, finish) = self.objects.get(object)?;
        let surface = finish(&hit.point(camera.footprint(direction, &hit)));
        Some((self.shade(&hit, -direction, &surface), hit.t))
    }

    /// Light of lamps that nothing hides, and of the room; every other lamp, now these and now those.
    fn shade(&self, hit: &Hit, wo: Vec3, surface: &Surface) -> Vec3 {
        let frame = Frame::from_normal_tangent(surface.normal, hit.tangent);
        let local = frame.to_local(wo);
        let start = hit.position + 1e-3 * hit.normal;
        let turn = hash(hit.position.x.to_bits() ^ hash(hit.position.y.to_bits())) as usize % SHARE;
        let lights = self.lights.iter().skip(turn).step_by(SHARE);
        lights.fold(surface.albedo * sky(surface.normal) * 0.35, |sum, light| {
            let wi = frame.to_local(light.direction);
            if wi.z <= 0.0
                || light.direction.dot(hit.normal) <= 0.0
                || self.first_hit(start, light.direction).is_some()
            {
                return sum;
            }
            sum + light.colour * (SHARE as f32 * PI) * surface.brdf.value(wi, local) * wi.z
        })
    }
}

/// One of so many lamps shines on a ray.
const SHARE: usize = 2;
