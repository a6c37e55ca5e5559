//! Ray-traced shapes: a sphere, a plane, a mesh or a fractal surface.

use std::sync::Arc;

use glam::{DVec3, Mat3, Vec2, Vec3};

use crate::geometry::fractal::Fractal;
use crate::geometry::mesh::{Mesh, Probe, TracedMesh};
use crate::geometry::ray::Hit;

/// A shape in local coordinates, z up.
pub enum Shape {
    /// Radius 1 about the origin. Tangents point east around the z axis, and texture coordinates
    /// are longitude and latitude.
    Sphere,
    /// z = 0, visible from above. Tangents point along x, and texture coordinates are x and y.
    Plane,
    /// Triangles.
    Mesh(TracedMesh),
    /// Triangles on the unit disk of the plane z = 0.
    MeshOnDisk(TracedMesh),
    /// A fractal height field.
    Fractal(Fractal),
}

impl From<Mesh> for Arc<Shape> {
    fn from(mesh: Mesh) -> Self {
        Self::new(Shape::Mesh(TracedMesh::new(mesh)))
    }
}

impl Shape {
    /// Returns the first hit in front of `origin`; `direction` is a unit vector.
    pub fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<Hit> {
        let probe = Probe::new(origin, direction);
        self.meets(&probe, f32::INFINITY).and_then(|met| self.hit(&probe, met))
    }

    /// Returns the first intersection of a probe, if it is nearer than `farthest`.
    pub fn meets(&self, probe: &Probe, farthest: f32) -> Option<Met> {
        let world = |hit: &Hit| probe.world(hit.position);
        let hit = match self {
            Self::Sphere => sphere(probe),
            Self::Plane => plane(probe),
            Self::Mesh(mesh) => {
                return mesh.meets(probe, farthest).map(|(t, triangle)| Met::Triangle { t, triangle });
            }
            Self::MeshOnDisk(mesh) => mesh
                .nearest(probe)
                .filter(|hit| world(hit).z > 0.0)
                .or_else(|| plane(probe).filter(|hit| world(hit).length_squared() < 1.0)),
            Self::Fractal(fractal) => fractal.intersect(probe),
        };
        hit.filter(|hit| hit.t < farthest).map(Met::Whole)
    }

    /// Returns the hit of an intersection with this shape.
    pub fn hit(&self, probe: &Probe, met: Met) -> Option<Hit> {
        match (self, met) {
            (Self::Mesh(mesh), Met::Triangle { triangle, .. }) => mesh.hit(probe, triangle),
            (_, Met::Whole(hit)) => Some(hit),
            (_, Met::Triangle { .. }) => None,
        }
    }

    /// Whether anything is in front of a probe, for shadows.
    pub fn hides(&self, probe: &Probe) -> bool {
        match self {
            Self::Mesh(mesh) => mesh.hides(probe),
            Self::Fractal(fractal) => fractal.hides(probe),
            _ => self.meets(probe, f32::INFINITY).is_some(),
        }
    }
}

/// The first intersection of a ray. Its hit is computed only if nothing else is nearer.
pub enum Met {
    /// A triangle.
    Triangle { t: f32, triangle: u32 },
    /// Any other shape.
    Whole(Hit),
}

impl Met {
    /// Returns the distance.
    pub const fn distance(&self) -> f32 {
        match self {
            Self::Triangle { t, .. } => *t,
            Self::Whole(hit) => hit.t,
        }
    }
}

/// In `f64`, because close to the surface the two roots nearly cancel.
fn sphere(probe: &Probe) -> Option<Hit> {
    let (o, d) = (probe.eye(), probe.direction().as_dvec3().normalize());
    let half = o.dot(d);
    let discriminant = half * half - (o.length_squared() - 1.0);
    if discriminant < 0.0 {
        return None;
    }
    let t = [-half - discriminant.sqrt(), -half + discriminant.sqrt()].into_iter().find(|&t| t > 1e-9)?;
    let exact = (o + d * t).normalize();
    let p = exact.as_vec3();
    let east = Vec3::new(-p.y, p.x, 0.0);
    let tangent = if east.length_squared() > 0.0 { east.normalize() } else { Vec3::Y };
    let north = p.cross(tangent);
    Some(Hit {
        t: t as f32,
        position: probe.place(exact),
        normal: p,
        flat: p,
        lift: [Vec3::ZERO; 2],
        tangent,
        uv: Vec2::new(p.y.atan2(p.x), p.z.clamp(-1.0, 1.0).asin()),
        triangle: None,
        tangents: [east, north],
        bend: Mat3::IDENTITY,
    })
}

fn plane(probe: &Probe) -> Option<Hit> {
    let t = (-probe.eye().z / f64::from(probe.direction().z)) as f32;
    let position = probe.origin() + probe.direction() * t;
    (t > 0.0 && t.is_finite()).then_some(Hit {
        t,
        position: position.with_z(probe.place(DVec3::ZERO).z),
        normal: Vec3::Z,
        flat: Vec3::Z,
        lift: [Vec3::ZERO; 2],
        tangent: Vec3::X,
        uv: probe.world(position).truncate(),
        triangle: None,
        tangents: [Vec3::X, Vec3::Y],
        bend: Mat3::ZERO,
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn sphere_is_hit_on_its_near_side() {
        let hit = Shape::Sphere.intersect(Vec3::new(4.0, 0.1, 0.2), Vec3::NEG_X).unwrap();
        assert_abs_diff_eq!(hit.position.length(), 1.0, epsilon = 1e-6);
        assert!(hit.position.x > 0.9, "{hit:?}");
        assert_abs_diff_eq!(hit.t, 4.0 - (1.0_f32 - 0.05).sqrt(), epsilon = 1e-5);
        assert_abs_diff_eq!(hit.normal.dot(hit.tangent), 0.0, epsilon = 1e-6);
        assert!(Shape::Sphere.intersect(Vec3::new(4.0, 0.0, 0.0), Vec3::X).is_none());
        assert!(Shape::Sphere.intersect(Vec3::new(4.0, 1.1, 0.0), Vec3::NEG_X).is_none());
    }

    #[test]
    fn plane_is_hit_from_above_and_not_along_it() {
        let hit = Shape::Plane.intersect(Vec3::new(1.0, 2.0, 3.0), Vec3::NEG_Z).unwrap();
        assert_eq!((hit.t, hit.position), (3.0, Vec3::new(1.0, 2.0, 0.0)));
        assert!(Shape::Plane.intersect(Vec3::Z, Vec3::X).is_none());
        assert!(Shape::Plane.intersect(Vec3::Z, Vec3::Z).is_none());
    }
}
