//! A surface given by a function of radius and angle, as a mesh with smooth normals.

use std::f32::consts::TAU;

use glam::Vec3;

use crate::geometry::mesh::{Mesh, Vertex};

/// Rings and spokes.
const CELLS: (usize, usize) = (160, 240);

/// The surface `point(t, φ)` for `t` in `[0, 1]`, one point at `t = 0`, and `φ` once around counter-clockwise.
pub fn relief(point: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let (rings, spokes) = CELLS;
    Mesh::grid(rings, spokes, |ring, spoke| {
        // The last spoke is the first one, to the last bit.
        let (t, phi) = (ring as f32 / rings as f32, (spoke % spokes) as f32 / spokes as f32 * TAU);
        let position = point(t, phi);
        let [outward, around] = differences(&point, [t, phi], 1e-3);
        let normal = outward.cross(around).try_normalize().unwrap_or(Vec3::Z);
        Vertex { position, normal, tangent: normal.any_orthonormal_vector(), uv: position.truncate() }
    })
}

/// Differences of a surface along `t` in `[0, 1]` and around `φ`, by a step that is wide enough for `f32` and narrow against a cell.
pub(super) fn differences(point: impl Fn(f32, f32) -> Vec3, [t, phi]: [f32; 2], step: f32) -> [Vec3; 2] {
    let along = point((t + step).min(1.0), phi) - point((t - step).max(0.0), phi);
    [along, point(t, phi + step) - point(t, phi - step)]
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn a_hemisphere_has_its_own_points_as_normals() {
        let mesh = relief(|t, phi| {
            let (sin, cos) = (t * 1.5).sin_cos();
            Vec3::new(sin * phi.cos(), sin * phi.sin(), cos)
        });
        assert_eq!(mesh.triangles.len(), 160 * 240 * 2 - 240);
        for v in &mesh.vertices {
            // The pole itself has no direction around; differences of f32 over 1e-3 near it: measured 4e-3.
            assert_abs_diff_eq!(v.normal, v.position, epsilon = 7e-3);
        }
    }
}
