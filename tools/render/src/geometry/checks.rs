//! Mesh properties, for tests.

use std::collections::HashMap;

use glam::Vec3;

use crate::geometry::mesh::{Mesh, Vertex};

/// Asserts that triangles have valid vertices, that each is oriented by its normals to within this
/// cosine, and that normals and tangents are orthonormal.
pub(crate) fn check(name: &str, mesh: &Mesh, least: f32) {
    assert!(!mesh.triangles.is_empty(), "{name}");
    for v in &mesh.vertices {
        let [normal, tangent] = [v.normal, v.tangent].map(Vec3::length);
        let deviations = Vec3::new(normal - 1.0, tangent - 1.0, v.normal.dot(v.tangent));
        assert!(deviations.abs().max_element() < 1e-5 && v.uv.is_finite(), "{name}: {v:?}");
    }
    for corners in triangles(mesh) {
        let [a, b, c] = corners.map(|v| v.position);
        let flat = (b - a).cross(c - a).normalize_or_zero();
        // Slivers at rounded corners have no direction.
        let sliver = (b - a).cross(c - a).length() < 1e-7;
        assert!(sliver || corners.iter().all(|v| flat.dot(v.normal) > least), "{name}: {flat}, {corners:?}");
    }
}

/// Returns the corners of each triangle.
pub(crate) fn triangles(mesh: &Mesh) -> impl Iterator<Item = [Vertex; 3]> {
    mesh.triangles.iter().map(|t| t.map(|i| mesh.vertices[i as usize]))
}

/// Returns the signed volume from tetrahedra over the origin: positive if triangles are
/// counterclockwise from outside.
pub(crate) fn volume(mesh: &Mesh) -> f32 {
    let six = triangles(mesh).map(|t| t.map(|v| v.position)).map(|[a, b, c]| a.dot(b.cross(c)));
    six.sum::<f32>() / 6.0
}

/// Returns the directed edges that belong to a single triangle. Asserts that no edge has more than
/// one triangle per side.
pub(crate) fn open_edges(mesh: &Mesh) -> Vec<[Vec3; 2]> {
    // Neighbors that evaluate a shared corner in different ways differ in the last bits.
    let key = |p: Vec3| (p * 1e4).round().as_ivec3();
    let mut edges = HashMap::new();
    for corners in triangles(mesh) {
        let [a, b, c] = corners.map(|v| v.position);
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let twin = edges.insert([key(from), key(to)], [from, to]);
            assert_eq!(twin, None, "two triangles on one side of an edge");
        }
    }
    edges.iter().filter(|([from, to], _)| !edges.contains_key(&[*to, *from])).map(|(_, edge)| *edge).collect()
}
