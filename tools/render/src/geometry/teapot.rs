//! The Utah teapot, tessellated from its 32 bicubic Bézier patches.
//!
//! The control points are M. Newell's of 1975 with F. Crow's bottom, in the form of the Standard
//! Procedural Databases. The numbers come from three.js' `TeapotGeometry` (MIT). The lid is widened
//! by 14/13, so that its border at radius 1.3 meets the rim at 1.4. With the original numbers a gap
//! into the pot is visible.

use glam::{DVec2, DVec3};
use serde::Deserialize;

use crate::geometry::mesh::{Mesh, Vertex};

/// Cells per patch around the axis (or around the tube of handle and spout) and along the profile.
///
/// 32 patches of 16 × 17 cells of two triangles, less one per pair at the poles of lid and bottom:
/// 17,280 triangles.
const CELLS: (usize, usize) = (16, 17);

/// The patches of the handle and the spout, whose tangents follow the tube. All others go around
/// the axis.
const TUBES: std::ops::Range<usize> = 12..20;

const LID: std::ops::Range<usize> = 20..28;

#[derive(Deserialize)]
struct Data {
    patches_16_indices: Vec<[usize; 16]>,
    vertices_xyz_z_up: Vec<[f64; 3]>,
}

/// Returns the triangles of the teapot: z up, the body's axis on the z axis, spout toward +x,
/// bottom at z = 0, top of the knob at z = 3.15.
///
/// Handle, spout and body interpenetrate. The only open borders are the two ends of the handle and
/// of the spout (its base inside the body, its mouth). Everywhere else each edge has two triangles.
pub fn teapot() -> Mesh {
    let Ok(data) = serde_json::from_str::<Data>(include_str!("../../data/teapot.json")) else {
        return Mesh::default();
    };
    let mut mesh = Mesh::default();
    for (index, patch) in data.patches_16_indices.iter().enumerate() {
        let widen = if LID.contains(&index) { DVec3::new(14.0 / 13.0, 14.0 / 13.0, 1.0) } else { DVec3::ONE };
        let control =
            patch.map(|i| data.vertices_xyz_z_up.get(i).map_or(DVec3::ZERO, |&p| DVec3::from(p) * widen));
        // Control points are stored by rows; u runs along a row, v across rows.
        mesh.append(Mesh::grid(CELLS.1, CELLS.0, |j, i| {
            let (u, v) = (i as f64 / CELLS.0 as f64, j as f64 / CELLS.1 as f64);
            vertex(&control, u, v, TUBES.contains(&index))
        }));
    }
    mesh
}

/// Returns position, normal and tangent from the analytic derivatives.
///
/// At a pole `∂P/∂u = 0`, and the tangent is its limit, the direction of `∂²P/∂u∂v`.
fn vertex(control: &[DVec3; 16], u: f64, v: f64, tube: bool) -> Vertex {
    let (bu, bv) = (bernstein(u), bernstein(v));
    let (du, dv) = (bernstein_slope(u), bernstein_slope(v));
    let p = tensor(control, bu, bv);
    let p_v = tensor(control, bu, dv);
    let mut p_u = tensor(control, du, bv);
    if p_u.length() < 1e-9 {
        p_u = tensor(control, du, dv);
    }
    // The same orientation all around the axis, although the bottom's patches are reversed.
    let sense = DVec3::new(-p.y - p_v.y, p.x + p_v.x, 0.0).dot(p_u).signum();
    let (tangent, uv) = if tube { (p_v, DVec2::new(v, u)) } else { (p_u * sense, DVec2::new(u * sense, v)) };
    Vertex {
        // The two patches at an edge evaluate it in opposite order. Differences in the last bits of
        // f64 give the same f32.
        position: p.as_vec3(),
        normal: p_u.cross(p_v).normalize_or_zero().as_vec3(),
        tangent: tangent.normalize_or_zero().as_vec3(),
        uv: uv.as_vec2(),
    }
}

fn tensor(control: &[DVec3; 16], u: [f64; 4], v: [f64; 4]) -> DVec3 {
    control.iter().enumerate().fold(DVec3::ZERO, |sum, (k, &c)| sum + c * (u[k % 4] * v[k / 4]))
}

fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

fn bernstein_slope(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use glam::Vec3;

    use super::*;
    use crate::geometry::checks::{check, open_edges, volume};

    #[test]
    fn teapot_is_closed_except_tube_ends() {
        let mesh = teapot();
        assert_eq!(mesh.triangles.len(), 32 * 2 * 16 * 17 - 8 * 16);
        // Measured minimum cosine 0.75, where the spout's lip curves.
        check("teapot", &mesh, 0.7);
        // The pot with its tubes has a volume of slightly over 30.
        assert!((25.0..35.0).contains(&volume(&mesh)), "volume {}", volume(&mesh));
        let open = open_edges(&mesh);
        // Two tubes with two ends of two patch edges each.
        assert_eq!(open.len(), 2 * 2 * 2 * CELLS.0);
        for Vec3 { x, y, z } in open.into_iter().flatten() {
            let handle = x < -1.49 && x > -2.01 && y.abs() < 0.31;
            let spout = (x - 1.7).abs() < 1e-4 && y.abs() < 0.67 || (z - 2.4).abs() < 1e-4 && x > 2.79;
            assert!(handle || spout, "open at ({x}, {y}, {z})");
        }
    }

    #[test]
    fn tangents_agree_across_patches() {
        let mesh = teapot();
        let mut at: HashMap<[u32; 3], Vec<Vertex>> = HashMap::new();
        for v in &mesh.vertices {
            at.entry(v.position.to_array().map(f32::to_bits)).or_default().push(*v);
        }
        let poles = |p: Vec3| p.x.abs() + p.y.abs() < 1e-3;
        for group in at.values().filter(|g| !poles(g[0].position)) {
            // Where the handle's end touches the body, normals differ. The crease between lid and
            // rim is the same case.
            for v in group.iter().filter(|v| v.normal.dot(group[0].normal) > 0.5) {
                assert!(v.tangent.dot(group[0].tangent) > 0.95, "{v:?} against {:?}", group[0]);
            }
        }
    }
}
