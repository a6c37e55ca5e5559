//! A surface given as a function of radius and angle, as a mesh with smooth normals.

use std::f32::consts::TAU;

use glam::Vec3;

use crate::geometry::mesh::{Mesh, Vertex};

/// Rings and spokes.
const CELLS: (usize, usize) = (160, 240);

/// Creates the surface `point(t, φ)` for `t` in `[0, 1]`, a single point at `t = 0`, with `φ` once
/// around counterclockwise.
pub fn relief(point: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let (rings, spokes) = CELLS;
    Mesh::grid(rings, spokes, |ring, spoke| {
        // The last spoke equals the first bit for bit.
        let (t, phi) = (ring as f32 / rings as f32, (spoke % spokes) as f32 / spokes as f32 * TAU);
        let position = point(t, phi);
        let [outward, around] = differences(&point, [t, phi], 1e-3);
        let normal = outward.cross(around).try_normalize().unwrap_or(Vec3::Z);
        Vertex { position, normal, tangent: normal.any_orthonormal_vector(), uv: position.truncate() }
    })
}

/// Returns finite differences along `t` in `[0, 1]` and around `φ`. The step is wide enough for
/// `f32` and narrow compared with a cell.
pub(super) fn differences(point: impl Fn(f32, f32) -> Vec3, [t, phi]: [f32; 2], step: f32) -> [Vec3; 2] {
    let along = point((t + step).min(1.0), phi) - point((t - step).max(0.0), phi);
    [along, point(t, phi + step) - point(t, phi - step)]
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn hemisphere_normals_equal_points() {
        let mesh = relief(|t, phi| {
            let (sin, cos) = (t * 1.5).sin_cos();
            Vec3::new(sin * phi.cos(), sin * phi.sin(), cos)
        });
        assert_eq!(mesh.triangles.len(), 160 * 240 * 2 - 240);
        for v in &mesh.vertices {
            // The pole has no azimuthal direction; differences of f32 over 1e-3 near it: measured
            // 4e-3.
            assert_abs_diff_eq!(v.normal, v.position, epsilon = 7e-3);
        }
    }
}
