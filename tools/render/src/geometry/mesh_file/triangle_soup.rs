//! Triangles as stored in a file, and their conversion to a mesh.

use std::collections::HashMap;

use asperity_shading::Frame;
use glam::{DVec3, Vec2, Vec3};

use crate::{
    geometry::mesh::{Mesh, Vertex},
    geometry::mesh_file::{
        error::{MOST_TRIANGLES, MeshFileError},
        materials::{MeshMaterials, Painted, TexturedMaterial},
        polygon::triangulate,
    },
};

/// The up axis of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// The convention of glTF and most other formats.
    Y,
    /// The convention of architecture and maps.
    Z,
}

/// Conventions that files do not specify.
#[derive(Clone, Copy, Debug)]
pub struct MeshReading {
    pub up: Up,
    /// The minimum angle in degrees between triangles at which an edge stays sharp, for files
    /// without normals.
    pub crease: f32,
    /// Whether to read the materials of a glTF.
    pub materials: bool,
}

/// A mesh from a file.
pub struct MeshFile {
    pub mesh: Mesh,
    /// Whether every vertex has a normal in the file.
    pub normals: bool,
    /// Whether nine tenths of the surface have texture coordinates.
    pub uv: bool,
    /// Whether the file also has points or lines, which are not rendered.
    pub thin: bool,
    /// Whether some triangles are not rendered, because the file is incomplete or their corners do
    /// not exist.
    pub left_out: bool,
    /// The materials of the file, if they are wanted and it has some.
    pub materials: Option<MeshMaterials>,
    /// Features of these materials that are not rendered.
    pub ignored: Vec<String>,
    /// The place of the mesh in its file.
    pub place: Placement,
}

/// The place of a mesh in its file.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    center: DVec3,
    radius: f64,
    up: Up,
}

impl Placement {
    /// Returns a point of the file in the coordinates of the mesh: in the unit ball, z up.
    pub fn apply(&self, point: DVec3) -> DVec3 {
        let v = (point - self.center) / self.radius;
        match self.up {
            Up::Y => DVec3::new(v.x, -v.z, v.y),
            Up::Z => v,
        }
    }
}

/// A vertex as read; missing values are zero.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corner {
    pub(super) position: DVec3,
    pub(super) normal: Vec3,
    pub(super) uv: Vec2,
}

/// Triangles as read.
#[derive(Default)]
pub(super) struct TriangleSoup {
    pub(super) corners: Vec<Corner>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Whether the file also has points or lines.
    pub(super) thin: bool,
    /// Whether the file has invalid triangles.
    pub(super) left_out: bool,
    /// The materials, if they are wanted and the file has some.
    pub(super) materials: Option<Vec<TexturedMaterial>>,
    /// Features of the materials that are not rendered.
    pub(super) ignored: Vec<String>,
    /// What materials read, for each corner; empty without materials.
    pub(super) painted: Vec<Painted>,
}

impl TriangleSoup {
    /// Appends a triangle of existing vertices.
    pub(super) fn push(&mut self, triangle: [u32; 3]) -> Result<(), MeshFileError> {
        triangle.iter().try_for_each(|&i| self.corner(i).map(drop))?;
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
        let places = corners.iter().map(|&i| Ok(self.corner(i)?.position)).collect::<Result<Vec<_>, _>>()?;
        triangulate(&places)?.into_iter().try_for_each(|triangle| self.push(triangle.map(|k| corners[k])))
    }

    pub(super) fn corner(&self, index: u32) -> Result<&Corner, MeshFileError> {
        let count = self.corners.len();
        self.corners.get(index as usize).ok_or(MeshFileError::NoSuchVertex { index: index.into(), count })
    }

    /// Converts to a mesh, rotated so that `up` is z, and scaled into the unit ball.
    pub(super) fn into_mesh(mut self, reading: MeshReading) -> Result<MeshFile, MeshFileError> {
        self.check_places()?;
        // Only patterns need texture coordinates.
        self.corners
            .iter_mut()
            .filter(|corner| !corner.uv.is_finite())
            .for_each(|corner| corner.uv = Vec2::ZERO);
        let nothing = match self.thin {
            true => MeshFileError::OnlyPointsAndLines,
            false if self.triangles.is_empty() => MeshFileError::Nothing,
            false => MeshFileError::NoTriangles,
        };
        let corners = &self.corners;
        self.triangles.retain(|triangle| !is_line(triangle.map(|i| corners[i as usize].position)));
        let Some((center, radius)) = self.ball() else { return Err(nothing) };
        let turned = |v: DVec3| match reading.up {
            Up::Y => DVec3::new(v.x, -v.z, v.y),
            Up::Z => v,
        };
        let placement = Placement { center, radius, up: reading.up };
        let place = |i: u32| placement.apply(self.corners[i as usize].position).as_vec3();
        let mut mesh = Mesh::default();
        let mut own = vec![u32::MAX; self.corners.len()];
        let mut kept = Vec::new();
        for &triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| place(i).as_dvec3());
            if (b - a).cross(c - a) == DVec3::ZERO {
                continue;
            }
            if self.materials.is_some() {
                kept.push(triangle);
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
            return Err(nothing);
        }
        let normals = mesh.vertices.iter().all(|v| v.normal != Vec3::ZERO);
        if !normals {
            complete_normals(&mut mesh, reading.crease);
        }
        let uv = scale_uv(&mut mesh);
        lay_tangents(&mut mesh);
        let materials = self.materials.map(|materials| {
            let materials = materials.into_iter().map(|m| m.in_units_of(radius as f32)).collect();
            MeshMaterials { materials, triangles: kept, corners: self.painted }
        });
        let Self { thin, left_out, ignored, .. } = self;
        Ok(MeshFile { mesh, normals, uv, thin, left_out, materials, ignored, place: placement })
    }

    /// Returns an error for non-finite positions of triangle corners. Unused vertices may have any
    /// position.
    fn check_places(&self) -> Result<(), MeshFileError> {
        let mut used = self.triangles.iter().flatten().map(|&i| i as usize);
        let broken = used.find(|&i| !self.corners[i].position.as_vec3().is_finite());
        broken.map_or(Ok(()), |index| Err(MeshFileError::NotFinite { index }))
    }

    /// Returns the center of the bounding box of all triangles, and the distance of the farthest
    /// corner.
    fn ball(&self) -> Option<(DVec3, f64)> {
        let corners = || self.triangles.iter().flatten().map(|&i| self.corners[i as usize].position);
        let low = corners().reduce(DVec3::min)?;
        let high = corners().reduce(DVec3::max)?;
        let center = 0.5 * (low + high);
        let radius = corners().map(|p| p.distance(center)).fold(0.0, f64::max);
        (radius > 0.0).then_some((center, radius))
    }
}

/// Whether the corners are collinear within the rounding of `f32` coordinates. Modeling programs
/// hide parts by scaling them to 0.
fn is_line([a, b, c]: [DVec3; 3]) -> bool {
    let edges = [b - a, c - b, a - c];
    let scale = edges.iter().map(|edge| edge.abs().max_element()).fold(0.0, f64::max);
    // A part scaled to a point elsewhere, within the rounding of transforms.
    if scale <= 1e-11 * a.abs().max_element() {
        return true;
    }
    let edges = edges.map(|edge| edge / scale);
    let longest = edges.iter().map(|edge| edge.length_squared()).fold(0.0, f64::max);
    let height = edges[0].cross(edges[2]).length() / longest;
    // All three coincide: NaN.
    height.is_nan() || height <= f64::from(f32::EPSILON)
}

/// Returns the angle at the first of three points.
fn angle([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).cross(c - a).length().atan2((b - a).dot(c - a))
}

/// Computes missing normals. Each corner gets the angle-weighted mean of the triangles around its
/// point that are within `crease` degrees of its own triangle (Thürmer and Wüthrich 1998,
/// "Computing Vertex Normals from Polygonal Facets"). Vertices with differing corners are split.
fn complete_normals(mesh: &mut Mesh, crease: f32) {
    /// Every pair of triangles is compared. With more triangles, the mean is over all of them.
    const MOST_AROUND: usize = 256;
    // Adding zero turns −0 into 0.
    let bits = |v: Vec3| (v + Vec3::ZERO).to_array().map(f32::to_bits);
    let places = |t: [u32; 3], vertices: &[Vertex]| t.map(|i| vertices[i as usize].position.as_dvec3());
    let flat = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).normalize_or_zero();
    let mut around: HashMap<[u32; 3], Vec<(DVec3, f64)>> = HashMap::new();
    for &triangle in &mesh.triangles {
        let [a, b, c] = places(triangle, &mesh.vertices);
        for corner in [[a, b, c], [b, c, a], [c, a, b]] {
            around.entry(bits(corner[0].as_vec3())).or_default().push((flat(corner), angle(corner)));
        }
    }
    let least = f64::from(crease.to_radians()).cos() - 1e-9;
    let mut split: HashMap<(u32, [u32; 3]), u32> = HashMap::new();
    for triangle in &mut mesh.triangles {
        let own = flat(places(*triangle, &mesh.vertices));
        for index in triangle {
            let vertex = mesh.vertices[*index as usize];
            if vertex.normal != Vec3::ZERO && !split.contains_key(&(*index, bits(vertex.normal))) {
                continue;
            }
            let faces = around.get(&bits(vertex.position)).map_or(&[][..], Vec::as_slice);
            let one_sheet = |face: &&(DVec3, f64)| faces.len() > MOST_AROUND || face.0.dot(own) >= least;
            let sum: DVec3 = faces.iter().filter(one_sheet).map(|&(normal, angle)| normal * angle).sum();
            // Two opposite faces of one sheet cancel.
            let normal = if sum.length() > 1e-6 { sum.normalize() } else { own }.as_vec3();
            let unset = mesh.vertices[*index as usize].normal == Vec3::ZERO;
            *index = *split.entry((*index, bits(normal))).or_insert_with(|| {
                if unset {
                    mesh.vertices[*index as usize].normal = normal;
                    return *index;
                }
                mesh.vertices.push(Vertex { normal, ..vertex });
                mesh.vertices.len() as u32 - 1
            });
        }
    }
}

/// Scales texture coordinates to a unit of length, averaged over the surface. Returns false if more
/// than a tenth of the surface has none.
fn scale_uv(mesh: &mut Mesh) -> bool {
    let (mut all, mut covered, mut flat) = (0.0, 0.0, 0.0);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
        let [p, q] = [b, c].map(|v| (v.position - a.position).as_dvec3());
        let [s, t] = [b, c].map(|v| (v.uv - a.uv).as_dvec2());
        let (area, own) = (p.cross(q).length(), s.perp_dot(t).abs());
        all += area;
        if own > 0.0 {
            (covered, flat) = (covered + area, flat + own);
        }
    }
    let scale = (covered / flat).sqrt() as f32;
    let uv = covered > 0.9 * all && scale.is_finite() && scale > 0.0;
    let largest = mesh.vertices.iter().map(|v| v.uv.abs().max_element()).fold(0.0, f32::max);
    if uv && (scale * largest).is_finite() {
        mesh.vertices.iter_mut().for_each(|v| v.uv *= scale);
    }
    uv
}

/// Computes tangents along ∂P/∂u, as angle-weighted means of the triangles around each vertex.
/// Where texture coordinates are constant, the tangents follow from the minimal rotation.
fn lay_tangents(mesh: &mut Mesh) {
    let mut sums = vec![DVec3::ZERO; mesh.vertices.len()];
    // ∂P/∂u times the determinant of the coordinate differences.
    let along = |corners: [Vertex; 3]| {
        let [p, q, o] = corners.map(|v| v.position.as_dvec3());
        let [s, t, r] = corners.map(|v| v.uv.as_dvec2());
        let (b, c) = (t - s, r - s);
        let turn = b.perp_dot(c);
        if turn == 0.0 { DVec3::ZERO } else { ((q - p) * c.y - (o - p) * b.y) * turn.signum() }
    };
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| mesh.vertices[i as usize]);
        let (along, places) = (along(corners).normalize_or_zero(), corners.map(|v| v.position.as_dvec3()));
        for (k, &vertex) in triangle.iter().enumerate() {
            sums[vertex as usize] += along * angle([0, 1, 2].map(|i| places[(k + i) % 3]));
        }
    }
    for (v, sum) in mesh.vertices.iter_mut().zip(sums) {
        // Normalized in f64, because the sum may be nearly parallel to the normal.
        let normal = v.normal.as_dvec3().normalize();
        let across = sum - normal * normal.dot(sum);
        v.tangent = if across.length() > 1e-6 {
            across.normalize().as_vec3()
        } else {
            Frame::from_normal(v.normal).tangent
        };
    }
}
