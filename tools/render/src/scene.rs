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
        mesh_file::materials::MeshMaterials,
        ray::{Hit, Ray},
        shape::{Met, Shape},
    },
    light::{background, environments::Surroundings, lamps::Lamps},
    materials::Shaded,
};

/// A material that threads can share.
pub type Surface<'a> = dyn Material + Sync + 'a;

/// What an object is made of.
pub enum Finish<'a> {
    /// One material.
    Material(Box<Surface<'a>>),
    /// The materials of a mesh file, some of which may be transparent.
    Mesh(Arc<MeshMaterials>),
}

/// A shape with its material.
pub struct Object<'a> {
    pub shape: Arc<Shape>,
    pub finish: Finish<'a>,
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
        let (shape, finish) = (shape.into(), Finish::Material(Box::new(material)));
        Self { shape, finish, anchor: DVec3::ZERO, passes: 0.0, body: None }
    }

    /// Creates a mesh with the materials of its file.
    pub fn painted(shape: impl Into<Arc<Shape>>, materials: Arc<MeshMaterials>) -> Self {
        let (shape, finish) = (shape.into(), Finish::Mesh(materials));
        Self { shape, finish, anchor: DVec3::ZERO, passes: 0.0, body: None }
    }

    /// Returns the inside of the body whose surface a ray hits.
    pub fn inside(&self, hit: &Hit) -> Option<Absorption> {
        match &self.finish {
            Finish::Material(_) => self.body,
            Finish::Mesh(materials) => materials.body(hit),
        }
    }

    /// Returns the BSDF of a hit at its point.
    pub fn bsdf(&self, hit: &Hit, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        match &self.finish {
            Finish::Material(material) => material.bsdf(point, wo),
            Finish::Mesh(materials) => materials.bsdf(hit, point, wo),
        }
    }

    /// Whether a ray in this direction meets the object at a hit, instead of passing through.
    fn meets(&self, hit: &Hit, direction: Vec3) -> bool {
        match &self.finish {
            Finish::Material(_) => true,
            Finish::Mesh(materials) => materials.meets(hit, direction),
        }
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

/// Maximum number of transparent sheets along a ray.
const SHEETS: u32 = 64;

/// Returns the distance from which a ray continues behind a sheet at distance `t`.
fn past(t: f32) -> f32 {
    t + 1e-5 * t.max(1e-2)
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

    /// Returns the nearest intersection of a ray with an object that does not let it pass. The last
    /// of 64 sheets is opaque.
    pub fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<Meeting<'_, 'm>> {
        let mut passed = 0.0;
        for sheet in 1..=SHEETS {
            let probe = Probe::about(self.focus, origin + passed * direction, direction);
            let mut nearest: Option<(&Object<'m>, Met)> = None;
            for object in &self.objects {
                let farthest = nearest.as_ref().map_or(f32::INFINITY, |(_, met)| met.distance());
                if let Some(met) = object.shape.meets(&probe, farthest) {
                    nearest = Some((object, met));
                }
            }
            let (object, met) = nearest?;
            let hit = object.shape.hit(&probe, met)?;
            let hit = Hit { t: hit.t + passed, ..hit };
            if sheet == SHEETS || object.meets(&hit, direction) {
                return Some(Meeting { object, hit });
            }
            passed = past(hit.t);
        }
        None
    }

    /// Returns the fraction of the light from a direction that reaches a point.
    pub fn open(&self, origin: Vec3, direction: Vec3) -> Vec3 {
        let probe = Probe::about(self.focus, origin, direction);
        let hides = |object: &&Object<'_>| object.passes < 1.0 && object.shape.hides(&probe);
        let passes = |object: &Object<'_>| match &object.finish {
            Finish::Mesh(materials) if materials.let_light_through() => {
                self.through(&object.shape, materials, origin, direction)
            }
            _ => Vec3::splat(object.passes),
        };
        self.objects.iter().filter(hides).map(passes).product()
    }

    /// Returns the fraction of light that passes through all sheets of a mesh.
    fn through(&self, shape: &Shape, materials: &MeshMaterials, origin: Vec3, direction: Vec3) -> Vec3 {
        let (mut open, mut passed) = (Vec3::ONE, 0.0);
        for _ in 0..SHEETS {
            let probe = Probe::about(self.focus, origin + passed * direction, direction);
            let met = shape.meets(&probe, f32::INFINITY);
            let Some(hit) = met.and_then(|met| shape.hit(&probe, met)) else { return open };
            open *= materials.passes(&hit, direction);
            if open == Vec3::ZERO {
                break;
            }
            passed = past(hit.t + passed);
        }
        Vec3::ZERO
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

#[cfg(test)]
mod tests {
    use asperity_shading::StandardMaterialParameters;
    use glam::{Vec2, Vec4};

    use super::*;
    use crate::geometry::{
        mesh::{Mesh, TracedMesh},
        mesh_file::materials::{Coverage, Painted, TexturedMaterial, Textures},
    };

    /// Returns a scene of parallel invisible sheets at heights 0, −0.01, …
    fn invisible_sheets(count: u16) -> Scene<'static, 'static> {
        let mut mesh = Mesh::default();
        for k in 0..count {
            let corner = Vec3::new(-1.0, -1.0, -0.01 * f32::from(k));
            let sheet = Mesh::parallelogram(corner, [2.0 * Vec3::X, 2.0 * Vec3::Y]);
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend(sheet.vertices);
            mesh.triangles.extend(sheet.triangles.iter().map(|t| t.map(|i| first + i)));
        }
        let invisible = TexturedMaterial {
            parameters: StandardMaterialParameters::default(),
            alpha: 0.0,
            coverage: Coverage::Blend,
            double_sided: true,
            unlit: false,
            normal_scale: 1.0,
            absorption: Absorption::NONE,
            textures: Textures::default(),
        };
        let painted = Painted { uv: [Vec2::ZERO; 2], color: Vec4::ONE, material: 0 };
        let materials = MeshMaterials {
            materials: vec![invisible],
            triangles: mesh.triangles.clone(),
            corners: vec![painted; mesh.vertices.len()],
        };
        let object = Object::painted(Shape::Mesh(TracedMesh::new(mesh)), Arc::new(materials));
        Scene::new(vec![object], Light::Around(&Vec3::ONE), Backdrop::Light)
    }

    #[test]
    fn intersect_stops_at_the_last_of_64_sheets() {
        let from = Vec3::new(0.1, 0.2, 1.0);
        let met = |count| invisible_sheets(count).intersect(from, Vec3::NEG_Z).map(|met| met.hit.t);
        assert_eq!(met(63), None);
        assert!(met(80).is_some_and(|t| (t - 1.63).abs() < 1e-4), "{:?}", met(80));
    }
}
