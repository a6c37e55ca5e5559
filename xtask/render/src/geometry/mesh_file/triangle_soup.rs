//! Triangles as a file has them, and the mesh that they make.

use std::collections::HashMap;

use asperity_shading::Frame;
use glam::{DVec3, Vec2, Vec3};

use crate::{
    geometry::mesh::{Mesh, Vertex},
    geometry::mesh_file::{
        error::{MOST_TRIANGLES, MeshFileError},
        polygon::triangulate,
    },
};

/// The axis that points up in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// That of glTF and of most others.
    Y,
    /// That of buildings and maps.
    Z,
}

/// A vertex as read; zero stands for what is not given.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corner {
    pub(super) position: DVec3,
    pub(super) normal: Vec3,
    pub(super) uv: Vec2,
}

/// Triangles over vertices, as read.
#[derive(Debug, Default)]
pub(super) struct TriangleSoup {
    pub(super) corners: Vec<Corner>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl TriangleSoup {
    /// Appends a triangle of vertices that exist.
    pub(super) fn push(&mut self, triangle: [u32; 3]) -> Result<(), MeshFileError> {
        triangle.iter().try_for_each(|&i| self.place(i).map(drop))?;
        if self.triangles.len() >= MOST_TRIANGLES {
            return Err(MeshFileError::TooLarge);
        }
        self.triangles.push(triangle);
        Ok(())
    }

    /// Appends the triangles of a polygon.
    pub(super) fn push_polygon(&mut self, corners: &[u32]) -> Result<(), MeshFileError> {
        if let &[a, b, c] = corners {
            return self.push([a, b, c]);
        }
        let places = corners.iter().map(|&i| self.place(i)).collect::<Result<Vec<_>, _>>()?;
        triangulate(&places)?.into_iter().try_for_each(|triangle| self.push(triangle.map(|k| corners[k])))
    }

    fn place(&self, index: u32) -> Result<DVec3, MeshFileError> {
        let (corner, count) = (self.corners.get(index as usize), self.corners.len());
        corner.map(|c| c.position).ok_or(MeshFileError::NoSuchVertex { index: index.into(), count })
    }

    /// The mesh, turned so that `up` is z, and into the unit ball.
    pub(super) fn into_mesh(self, up: Up) -> Result<Mesh, MeshFileError> {
        self.check_numbers()?;
        let (centre, radius) = self.ball().ok_or(MeshFileError::NoTriangles)?;
        let turned = |v: DVec3| match up {
            Up::Y => DVec3::new(v.x, -v.z, v.y),
            Up::Z => v,
        };
        let place = |i: u32| turned((self.corners[i as usize].position - centre) / radius).as_vec3();
        let mut mesh = Mesh::default();
        let mut own = vec![u32::MAX; self.corners.len()];
        for &triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| place(i).as_dvec3());
            if (b - a).cross(c - a) == DVec3::ZERO {
                continue;
            }
            mesh.triangles.push(triangle.map(|i| {
                let own = &mut own[i as usize];
                if *own == u32::MAX {
                    *own = mesh.vertices.len() as u32;
                    let Corner { normal, uv, .. } = self.corners[i as usize];
                    let normal = turned(normal.as_dvec3()).normalize_or_zero().as_vec3();
                    mesh.vertices.push(Vertex { position: place(i), normal, tangent: Vec3::ZERO, uv });
                }
                *own
            }));
        }
        if mesh.triangles.is_empty() {
            return Err(MeshFileError::NoTriangles);
        }
        complete_normals(&mut mesh);
        lay_tangents(&mut mesh);
        Ok(mesh)
    }

    fn check_numbers(&self) -> Result<(), MeshFileError> {
        let check = |what, finite: fn(&Corner) -> bool| {
            let first = self.corners.iter().position(|corner| !finite(corner));
            first.map_or(Ok(()), |index| Err(MeshFileError::NotFinite { what, index }))
        };
        check("vertex", |c| c.position.as_vec3().is_finite())?;
        check("normal", |c| c.normal.is_finite())?;
        check("texture coordinate", |c| c.uv.is_finite())
    }

    /// Centre of the box around all corners, and the distance of the farthest.
    fn ball(&self) -> Option<(DVec3, f64)> {
        let corners = || self.triangles.iter().flatten().map(|&i| self.corners[i as usize].position);
        let low = corners().reduce(DVec3::min)?;
        let high = corners().reduce(DVec3::max)?;
        let centre = 0.5 * (low + high);
        let radius = corners().map(|p| p.distance(centre)).fold(0.0, f64::max);
        (radius > 0.0).then_some((centre, radius))
    }
}

/// Hands out a vector of each triangle to its vertices, with the triangle's angle there.
fn at_vertices(mesh: &Mesh, of: impl Fn([Vertex; 3]) -> DVec3, mut add: impl FnMut(usize, DVec3, f64)) {
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| mesh.vertices[i as usize]);
        let vector = of(corners);
        let places = corners.map(|v| v.position.as_dvec3());
        for (k, &vertex) in triangle.iter().enumerate() {
            let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| places[k]);
            let angle = (b - a).cross(c - a).length().atan2((b - a).dot(c - a));
            add(vertex as usize, vector, angle);
        }
    }
}

/// Gives each vertex without a normal the mean of the triangles around its point, weighted by their angles there
/// (Thürmer and Wüthrich 1998, "Computing Vertex Normals from Polygonal Facets"); vertices at one point share it.
fn complete_normals(mesh: &mut Mesh) {
    if mesh.vertices.iter().all(|v| v.normal != Vec3::ZERO) {
        return;
    }
    // Plus zero: −0 is where 0 is.
    let point = |v: &Vertex| (v.position + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut sums: HashMap<[u32; 3], (DVec3, DVec3)> = HashMap::new();
    let normal = |corners: [Vertex; 3]| {
        let [a, b, c] = corners.map(|v| v.position.as_dvec3());
        (b - a).cross(c - a).normalize_or_zero()
    };
    at_vertices(mesh, normal, |i, normal, angle| {
        let (sum, first) = sums.entry(point(&mesh.vertices[i])).or_default();
        *sum += normal * angle;
        if *first == DVec3::ZERO {
            *first = normal;
        }
    });
    for v in mesh.vertices.iter_mut().filter(|v| v.normal == Vec3::ZERO) {
        let (sum, first) = sums.get(&point(v)).copied().unwrap_or_default();
        // Two faces of one sheet, back to back, cancel; then one of them it is.
        let normal = if sum.length() > 1e-6 { sum.normalize() } else { first };
        v.normal = normal.as_vec3();
    }
}

/// Tangents along ∂P/∂u of the triangles around each vertex, weighted by their angles; where texture coordinates do
/// not vary, those of the minimal rotation.
fn lay_tangents(mesh: &mut Mesh) {
    let mut sums = vec![DVec3::ZERO; mesh.vertices.len()];
    // ∂P/∂u times the determinant of the coordinates' differences.
    let along = |corners: [Vertex; 3]| {
        let [p, q, o] = corners.map(|v| v.position.as_dvec3());
        let [s, t, r] = corners.map(|v| v.uv.as_dvec2());
        let (b, c) = (t - s, r - s);
        let turn = b.perp_dot(c);
        if turn == 0.0 { DVec3::ZERO } else { ((q - p) * c.y - (o - p) * b.y) * turn.signum() }
    };
    at_vertices(
        mesh,
        |corners| along(corners).normalize_or_zero(),
        |i, along, angle| sums[i] += along * angle,
    );
    for (v, sum) in mesh.vertices.iter_mut().zip(sums) {
        // Unit to the last bit of f64, for the sum may be nearly along it.
        let normal = v.normal.as_dvec3().normalize();
        let across = sum - normal * normal.dot(sum);
        v.tangent = if across.length() > 1e-6 {
            across.normalize().as_vec3()
        } else {
            Frame::from_normal(v.normal).tangent
        };
    }
}
