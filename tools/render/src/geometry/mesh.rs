//! A triangle mesh and its nearest intersection with a ray.

use glam::{DVec3, Mat3, Vec2, Vec3};

use crate::geometry::{
    boxes::{Boxes, Line},
    ray::Hit,
};

/// A triangle corner with its shading frame.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    pub position: Vec3,
    /// Unit length, outward.
    pub normal: Vec3,
    /// Unit length, orthogonal to the normal.
    pub tangent: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
}

/// Triangles with shared vertices.
#[derive(Default)]
pub struct Mesh {
    pub vertices: Vec<Vertex>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Creates a parallelogram from a corner and two sides. Its texture coordinates are lengths
    /// along the sides.
    pub fn parallelogram(corner: Vec3, sides: [Vec3; 2]) -> Self {
        let [u, v] = sides;
        let normal = u.cross(v).normalize_or(Vec3::Z);
        Self::grid(1, 1, |row, column| {
            let (x, y) = (column as f32, row as f32);
            let uv = Vec2::new(x * u.length(), y * v.length());
            Vertex { position: corner + x * u + y * v, normal, tangent: u.normalize_or(Vec3::X), uv }
        })
    }

    /// Creates two triangles in every cell of a grid of vertices, from index 0 to `rows` and
    /// `columns` inclusive.
    pub fn grid(rows: usize, columns: usize, vertex: impl Fn(usize, usize) -> Vertex) -> Self {
        let stride = columns + 1;
        let vertices = (0..(rows + 1) * stride).map(|k| vertex(k / stride, k % stride)).collect();
        let mut mesh = Self { vertices, triangles: Vec::new() };
        for a in (0..rows * stride).filter(|a| a % stride < columns) {
            let [a, b, c, d] = [a, a + 1, a + stride, a + stride + 1].map(|i| i as u32);
            // Two corners coincide at the pole of a patch.
            mesh.triangles.extend([[a, b, d], [a, d, c]].into_iter().filter(|triangle| {
                let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize].position);
                a != b && b != c && c != a
            }));
        }
        mesh
    }

    /// Appends another mesh.
    pub fn append(&mut self, other: Self) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(other.vertices);
        self.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|i| first + i)));
    }
}

/// Coordinates of the three corners, one coordinate after the other; the fourth lane is unused.
type Places = [[f32; 4]; 3];

/// A mesh with its bounding volume hierarchy.
pub struct TracedMesh {
    mesh: Mesh,
    boxes: Boxes,
    /// Coordinates of the corners, in the leaf order of the hierarchy.
    places: Vec<Places>,
}

impl TracedMesh {
    pub fn new(mesh: Mesh) -> Self {
        let corners = |t: &[u32; 3]| t.map(|i| mesh.vertices[i as usize].position);
        let triangles: Vec<_> = mesh.triangles.iter().map(corners).collect();
        let boxes = Boxes::new(&triangles);
        let places = boxes.order().iter().map(|&id| by_axis(triangles[id as usize])).collect();
        Self { mesh, boxes, places }
    }

    /// Whether any triangle is in front of the probe's origin.
    pub fn hides(&self, probe: &Probe) -> bool {
        self.boxes.meets_any(&probe.line, |k| probe.shear.distance(&self.places[k]))
    }

    /// Returns distance and index of the nearest triangle hit by a probe, if nearer than
    /// `farthest`.
    pub fn meets(&self, probe: &Probe, farthest: f32) -> Option<(f32, u32)> {
        self.boxes.nearest(&probe.line, farthest, |k| probe.shear.distance(&self.places[k]))
    }

    /// Returns the nearest triangle in front of `origin`.
    pub fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<Hit> {
        self.nearest(&Probe::new(origin, direction))
    }

    /// Returns the nearest hit of a probe.
    pub fn nearest(&self, probe: &Probe) -> Option<Hit> {
        self.meets(probe, f32::INFINITY).and_then(|(_, triangle)| self.hit(probe, triangle))
    }

    /// Returns the hit of a probe on a triangle that [`meets`](Self::meets) returned: position on
    /// the triangle and interpolated frame.
    pub fn hit(&self, probe: &Probe, triangle: u32) -> Option<Hit> {
        let triangle = self.boxes.order()[triangle as usize];
        let corners = self.corners(triangle as usize);
        let (t, exact) = probe.shear.intersect(&by_axis(corners.map(|v| v.position)))?;
        let weights = exact.map(|w| w as f32);
        let blend = |f: fn(&Vertex) -> Vec3| -> Vec3 {
            corners.iter().zip(weights).fold(Vec3::ZERO, |sum, (v, w)| sum + f(v) * w)
        };
        let normal = blend(|v| v.normal).normalize_or_zero();
        let along = blend(|v| v.tangent);
        let tangent = (along - normal * normal.dot(along)).normalize_or_zero();
        let [a, b, c] = corners.map(|v| v.position);
        let flat = (b - a).cross(c - a).normalize_or(normal);
        let flat = if flat.dot(normal) < 0.0 { -flat } else { flat };
        let position = corners.iter().zip(exact).map(|(v, w)| v.position.as_dvec3() * w).sum::<DVec3>();
        // Move to the mean of the tangent planes at the corners, where the point is below them:
        // Hanika 2021, "Hacking the Shadow Terminator".
        let above = corners.map(|v| (v.position.as_dvec3() - position).as_vec3().dot(v.normal));
        let lift = [f32::max, f32::min].map(|outwards| {
            let weighted = corners.iter().zip(weights).zip(above);
            weighted.fold(Vec3::ZERO, |sum, ((v, w), above)| sum + v.normal * (w * outwards(above, 0.0)))
        });
        let slopes = slopes(corners.map(|v| v.position));
        // The gradient of a quantity with these values at the corners.
        let gradient = |values: [f32; 3]| {
            slopes.iter().zip(values).fold(Vec3::ZERO, |sum, (slope, value)| sum + *slope * value)
        };
        let [u, v] = [0, 1].map(|axis| gradient(corners.map(|corner| corner.uv[axis])));
        let [by_u, by_v] = inverse(u, v).unwrap_or([tangent, normal.cross(tangent)]);
        // The tangent of the vertices is the tangent of u without discontinuities between
        // triangles.
        let along_u = by_u.length();
        let by_u = if by_u.dot(tangent) > 0.9 * along_u { along_u * tangent } else { by_u };
        Some(Hit {
            t: t as f32,
            position: probe.place(position),
            normal,
            flat,
            lift,
            tangent,
            uv: corners.iter().zip(weights).fold(Vec2::ZERO, |sum, (v, w)| sum + v.uv * w),
            triangle: Some((triangle, weights)),
            tangents: [by_u, by_v],
            bend: Mat3::from_cols_array_2d(
                &[0, 1, 2].map(|axis| gradient(corners.map(|v| v.normal[axis])).to_array()),
            )
            .transpose(),
        })
    }

    /// Returns the corner of a triangle that is nearest to a point.
    pub fn nearest_corner(&self, point: Vec3) -> Vec3 {
        let corners = self.mesh.triangles.iter().flatten().map(|&i| self.mesh.vertices[i as usize].position);
        corners.min_by(|a, b| a.distance(point).total_cmp(&b.distance(point))).unwrap_or_default()
    }

    /// Returns the minimum height of all corners, or 0 for an empty mesh.
    pub fn bottom(&self) -> f32 {
        self.mesh.vertices.iter().map(|v| v.position.z).reduce(f32::min).unwrap_or(0.0)
    }

    fn corners(&self, triangle: usize) -> [Vertex; 3] {
        self.mesh.triangles[triangle].map(|i| self.mesh.vertices[i as usize])
    }
}

/// Returns the gradients of the barycentric weights on a triangle, or zero for a degenerate
/// triangle.
fn slopes([a, b, c]: [Vec3; 3]) -> [Vec3; 3] {
    let across = (b - a).cross(c - a);
    let square = across.length_squared();
    [c - b, a - c, b - a].map(|edge| if square > 0.0 { across.cross(edge) / square } else { Vec3::ZERO })
}

/// Returns ∂P/∂u and ∂P/∂v of a plane on which u and v have these gradients, or `None` if the
/// gradients are parallel.
fn inverse(u: Vec3, v: Vec3) -> Option<[Vec3; 2]> {
    let across = u.cross(v);
    let square = across.length_squared();
    let tangents = [v.cross(across) / square, across.cross(u) / square];
    tangents.iter().all(|t| t.is_finite()).then_some(tangents)
}

fn by_axis([a, b, c]: [Vec3; 3]) -> Places {
    [[a.x, b.x, c.x, 0.0], [a.y, b.y, c.y, 0.0], [a.z, b.z, c.z, 0.0]]
}

/// A ray prepared for the triangles of any mesh.
///
/// Its origin and its hits are relative to a focus. Near the focus `f32` is exact at any distance
/// from the world origin, because the rest is computed in `f64`.
pub struct Probe {
    focus: DVec3,
    origin: Vec3,
    line: Line,
    shear: Shear,
}

impl Probe {
    /// Creates the ray from `origin` in a unit direction.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self::about(DVec3::ZERO, origin, direction)
    }

    /// Creates the ray from `origin`, relative to a focus, in a unit direction.
    pub fn about(focus: DVec3, origin: Vec3, direction: Vec3) -> Self {
        let eye = focus + origin.as_dvec3();
        Self { focus, origin, line: Line::new(eye.as_vec3(), direction), shear: Shear::new(eye, direction) }
    }

    /// Returns the origin relative to the focus.
    pub const fn origin(&self) -> Vec3 {
        self.origin
    }

    /// Returns the unit direction.
    pub fn direction(&self) -> Vec3 {
        self.line.direction()
    }

    /// Returns the origin in world coordinates.
    pub fn eye(&self) -> DVec3 {
        self.focus + self.origin.as_dvec3()
    }

    /// Converts a world position to a position relative to the focus.
    pub fn place(&self, point: DVec3) -> Vec3 {
        (point - self.focus).as_vec3()
    }

    /// Converts a position relative to the focus to world coordinates.
    pub fn world(&self, place: Vec3) -> Vec3 {
        (self.focus + place.as_dvec3()).as_vec3()
    }
}

/// Coordinates in which the ray is the z axis. An edge shared by two triangles is evaluated with
/// the same rounding for both, so that no ray passes between them.
///
/// Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection"; in `f64` throughout instead of
/// the paper's fallback for zero edge functions.
struct Shear {
    axes: [usize; 3],
    origin: [f64; 3],
    scale: [f64; 3],
}

impl Shear {
    fn new(origin: DVec3, direction: Vec3) -> Self {
        let z = direction.abs().max_position();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            (x, y) = (y, x);
        }
        let d = [x, y, z].map(|k| f64::from(direction[k]));
        let origin = [x, y, z].map(|k| origin[k]);
        Self { axes: [x, y, z], origin, scale: [d[0] / d[2], d[1] / d[2], 1.0 / d[2]] }
    }

    /// Returns the ray parameter, or infinity if the ray misses.
    fn distance(&self, corners: &Places) -> f32 {
        self.intersect(corners).map_or(f32::INFINITY, |(t, _)| t as f32)
    }

    /// Returns ray parameter and barycentric weights, for rays from either side.
    #[inline(always)]
    fn intersect(&self, corners: &Places) -> Option<(f64, [f64; 3])> {
        let ([kx, ky, kz], [sx, sy, sz]) = (self.axes, self.scale);
        let (mut x, mut y, mut z) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        for k in 0..3 {
            // Both triangles at an edge use the same numbers.
            let up = f64::from(corners[kz][k]) - self.origin[2];
            x[k] = f64::from(corners[kx][k]) - self.origin[0] - sx * up;
            y[k] = f64::from(corners[ky][k]) - self.origin[1] - sy * up;
            z[k] = sz * up;
        }
        let u = x[2] * y[1] - y[2] * x[1];
        let v = x[0] * y[2] - y[0] * x[2];
        let w = x[1] * y[0] - y[1] * x[0];
        let outside = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);
        let det = u + v + w;
        if outside || det == 0.0 {
            return None;
        }
        let t = (u * z[0] + v * z[1] + w * z[2]) / det;
        (t > 0.0).then_some((t, [u / det, v / det, w / det]))
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use approx::assert_abs_diff_eq;

    use super::*;
    use crate::geometry::{revolution::revolved, teapot::teapot};

    #[test]
    fn rays_through_vertices_and_edges_hit() {
        let traced = TracedMesh::new(teapot());
        let inside = Vec3::new(0.01, -0.02, 1.0);
        let mut rays = 0;
        for triangle in 0..traced.mesh.triangles.len() {
            let [a, b, c] = traced.corners(triangle).map(|v| v.position);
            for target in [a, b, c, (a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5] {
                // The tubes have open ends. The pot itself, including lid and bottom, is closed.
                if target.x.abs() + target.y.abs() < 2.9 && target.z < 2.3 && target.y.abs() > 0.7 {
                    rays += 1;
                    assert!(traced.intersect(inside, (target - inside).normalize()).is_some(), "{target}");
                }
            }
        }
        assert!(rays > 10_000);
    }

    #[test]
    fn texture_coordinates_and_normal_bend_match_the_sphere() {
        let points: Vec<[f32; 2]> =
            (-16..=16).map(|k| (k as f32 / 32.0 * PI).sin_cos()).map(|(s, c)| [c, s]).collect();
        let traced = TracedMesh::new(revolved(&points));
        for (longitude, latitude) in [(0.3_f32, 0.2_f32), (2.5, -0.7), (6.27, 0.9)] {
            let (sin, cos) = longitude.sin_cos();
            let out = Vec3::new(latitude.cos() * cos, latitude.cos() * sin, latitude.sin());
            let hit = traced.intersect(3.0 * out, -out).unwrap();
            // Chords of 1/192 of the circle: 5e-4 of the radius.
            assert_abs_diff_eq!(hit.uv, Vec2::new(longitude, latitude + 0.5 * PI), epsilon = 1.4e-3);
            let east = Vec3::new(-sin, cos, 0.0) * latitude.cos();
            // Triangles are inclined by up to half of 1/192 of the circle: 0.0164.
            assert_abs_diff_eq!(hit.tangents[0], east, epsilon = 0.017);
            assert_abs_diff_eq!(hit.tangents[1], out.cross(hit.tangent), epsilon = 0.017);
            for along in hit.tangents {
                assert_abs_diff_eq!(hit.bend * along, along, epsilon = 0.017);
            }
        }
    }

    #[test]
    fn first_hit_is_the_nearest_triangle() {
        let traced = TracedMesh::new(teapot());
        let eye = Vec3::new(5.0, -6.0, 4.0);
        for i in 0..40_u8 {
            let target = Vec3::new(f32::from(i % 8) * 0.8 - 2.8, 0.3, f32::from(i / 8) * 0.7);
            let direction = (target - eye).normalize();
            let shear = Shear::new(eye.as_dvec3(), direction);
            let naive = (0..traced.mesh.triangles.len())
                .filter_map(|k| {
                    shear.intersect(&by_axis(traced.corners(k).map(|v| v.position))).map(|hit| hit.0 as f32)
                })
                .fold(f32::INFINITY, f32::min);
            let got = traced.intersect(eye, direction).map_or(f32::INFINITY, |hit| hit.t);
            assert_eq!(got, naive, "towards {target}");
        }
    }
}
