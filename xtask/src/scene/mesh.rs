//! A triangle mesh and the first triangle that a ray meets.

use std::time::Duration;

use glam::{Vec3, Vec3A};
use obvhs::{
    Boundable, BvhBuildParams,
    aabb::Aabb,
    cwbvh::{CwBvh, builder::build_cwbvh},
    ray::{Ray, RayHit},
};

use super::shape::Hit;

/// A corner of triangles with its shading frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    pub(crate) position: Vec3,
    /// Unit, outwards.
    pub(crate) normal: Vec3,
    /// Unit, orthogonal to the normal.
    pub(crate) tangent: Vec3,
}

/// Triangles over shared vertices.
#[derive(Default)]
pub(crate) struct Mesh {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Appends a triangle unless two of its corners coincide, as they do at the pole of a patch.
    pub(crate) fn push_unless_degenerate(&mut self, triangle: [u32; 3]) {
        let [a, b, c] = triangle.map(|i| self.vertices.get(i as usize).map(|v| v.position));
        if a != b && b != c && c != a {
            self.triangles.push(triangle);
        }
    }
}

/// A mesh with its bounding volume hierarchy.
pub(crate) struct TracedMesh {
    mesh: Mesh,
    bvh: CwBvh,
}

impl TracedMesh {
    pub(crate) fn new(mesh: Mesh) -> Self {
        let boxes: Vec<Padded> = mesh
            .triangles
            .iter()
            .map(|t| Padded(t.map(|i| Vec3A::from(mesh.vertices[i as usize].position))))
            .collect();
        let bvh = build_cwbvh(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
        Self { mesh, bvh }
    }

    /// The nearest triangle in front of `origin`, with position on the triangle and interpolated frame.
    pub(crate) fn first_hit(&self, origin: Vec3, direction: Vec3) -> Option<Hit> {
        let shear = Shear::new(origin, direction);
        let mut hit = RayHit::none();
        let ray = Ray::new_inf(origin.into(), direction.into());
        let found = self.bvh.ray_traverse(ray, &mut hit, |ray, id| {
            let corners = self.corners(self.bvh.primitive_indices[id] as usize);
            match shear.intersect(corners.map(|v| v.position)) {
                Some((t, _)) if t >= ray.tmin && t <= ray.tmax => t,
                _ => f32::INFINITY,
            }
        });
        if !found {
            return None;
        }
        let corners = self.corners(self.bvh.primitive_indices[hit.primitive_id as usize] as usize);
        let (t, weights) = shear.intersect(corners.map(|v| v.position))?;
        let blend = |f: fn(&Vertex) -> Vec3| -> Vec3 {
            corners.iter().zip(weights).fold(Vec3::ZERO, |sum, (v, w)| sum + f(v) * w)
        };
        let normal = blend(|v| v.normal).normalize_or_zero();
        let along = blend(|v| v.tangent);
        Some(Hit {
            t,
            position: blend(|v| v.position),
            normal,
            tangent: (along - normal * normal.dot(along)).normalize_or_zero(),
        })
    }

    fn corners(&self, triangle: usize) -> [Vertex; 3] {
        self.mesh.triangles[triangle].map(|i| self.mesh.vertices[i as usize])
    }
}

/// A triangle whose box is widened by 2⁻¹⁸ of its distance from the origin: the hierarchy's box test rounds, and a ray
/// along a face of a box would slip past the triangle in it.
struct Padded([Vec3A; 3]);

impl Boundable for Padded {
    fn aabb(&self) -> Aabb {
        let exact = Aabb::from_points(&self.0);
        let pad = (exact.min.abs().max(exact.max.abs())).max_element() / 262_144.0;
        Aabb { min: exact.min - Vec3A::splat(pad), max: exact.max + Vec3A::splat(pad) }
    }
}

/// The ray's own coordinates, in which it is the z axis: edges that two triangles share are judged by the same
/// rounding for both, so that no ray slips between them.
///
/// Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection"; in `f64` throughout instead of the paper's
/// fallback for edge functions that vanish.
struct Shear {
    origin: Vec3,
    axes: [usize; 3],
    scale: [f64; 3],
}

impl Shear {
    fn new(origin: Vec3, direction: Vec3) -> Self {
        let z = direction.abs().max_position();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            (x, y) = (y, x);
        }
        let d = [x, y, z].map(|k| f64::from(direction[k]));
        Self { origin, axes: [x, y, z], scale: [d[0] / d[2], d[1] / d[2], 1.0 / d[2]] }
    }

    /// Ray parameter and barycentric weights, whichever side the ray comes from.
    fn intersect(&self, corners: [Vec3; 3]) -> Option<(f32, [f32; 3])> {
        let [kx, ky, kz] = self.axes;
        let [sx, sy, sz] = self.scale;
        let [a, b, c] = corners.map(|p| {
            // Differences of f32 are exact in f64 here, so both triangles at an edge see the same numbers.
            let d = [kx, ky, kz].map(|k| f64::from(p[k]) - f64::from(self.origin[k]));
            [d[0] - sx * d[2], d[1] - sy * d[2], sz * d[2]]
        });
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let outside = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);
        let det = u + v + w;
        if outside || det == 0.0 {
            return None;
        }
        let t = (u * a[2] + v * b[2] + w * c[2]) / det;
        (t > 0.0).then(|| (t as f32, [u, v, w].map(|e| (e / det) as f32)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::teapot::teapot;

    #[test]
    fn no_ray_through_a_vertex_or_an_edge_of_the_belly_misses() {
        let traced = TracedMesh::new(teapot());
        let inside = Vec3::new(0.01, -0.02, 1.0);
        let mut rays = 0;
        for triangle in 0..traced.mesh.triangles.len() {
            let [a, b, c] = traced.corners(triangle).map(|v| v.position);
            for target in [a, b, c, (a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5] {
                // The tubes have open ends; the pot itself, lid and bottom included, is closed.
                if target.x.abs() + target.y.abs() < 2.9 && target.z < 2.3 && target.y.abs() > 0.7 {
                    rays += 1;
                    assert!(traced.first_hit(inside, (target - inside).normalize()).is_some(), "{target}");
                }
            }
        }
        assert!(rays > 10_000);
    }

    #[test]
    fn the_first_hit_is_the_nearest_of_all_triangles() {
        let traced = TracedMesh::new(teapot());
        let eye = Vec3::new(5.0, -6.0, 4.0);
        for i in 0..40_u8 {
            let target = Vec3::new(f32::from(i % 8) * 0.8 - 2.8, 0.3, f32::from(i / 8) * 0.7);
            let direction = (target - eye).normalize();
            let shear = Shear::new(eye, direction);
            let naive = (0..traced.mesh.triangles.len())
                .filter_map(|k| shear.intersect(traced.corners(k).map(|v| v.position)).map(|hit| hit.0))
                .fold(f32::INFINITY, f32::min);
            let got = traced.first_hit(eye, direction).map_or(f32::INFINITY, |hit| hit.t);
            assert_eq!(got, naive, "towards {target}");
        }
    }
}
