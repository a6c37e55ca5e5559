//! Surfaces of revolution about the z axis, and rings for handles.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::{
    geometry::mesh::{Mesh, Vertex},
    interpolation::catmull_rom,
};

/// Steps between consecutive profile points.
const STEPS: usize = 16;

/// Steps around the axis.
const AROUND: usize = 192;

/// Revolves the smooth profile through points `(radius, height)` about the z axis. The outside is
/// to the right of the profile's direction.
///
/// Texture coordinates are the angle and the length along the profile.
pub fn revolved(points: &[[f32; 2]]) -> Mesh {
    let profile = smooth(points);
    // The last column coincides with the first, with separate texture coordinates.
    Mesh::grid(profile.len() - 1, AROUND, |row, column| {
        let angle = TAU * (AROUND - column) as f32 / AROUND as f32;
        let (sin, cos) = angle.sin_cos();
        let (p, along, length) = profile[row];
        let out = Vec2::new(along.y, -along.x);
        Vertex {
            position: Vec3::new(p.x * cos, p.x * sin, p.y),
            normal: Vec3::new(out.x * cos, out.x * sin, out.y),
            tangent: Vec3::new(-sin, cos, 0.0),
            uv: Vec2::new(angle, length),
        }
    })
}

/// Creates a torus of radius `ring` about `center` in the x–z plane, with tube radius `tube`.
pub fn ring(center: Vec3, ring: f32, tube: f32) -> Mesh {
    let (columns, rows) = (AROUND / 2, AROUND / 4);
    Mesh::grid(rows, columns, |row, column| {
        let (a, b) = (TAU * (columns - column) as f32 / columns as f32, TAU * row as f32 / rows as f32);
        let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
        let out = Vec3::new(cb * ca, sb, cb * sa);
        Vertex {
            position: center + ring * Vec3::new(ca, 0.0, sa) + tube * out,
            normal: out,
            tangent: Vec3::new(-sa, 0.0, ca),
            uv: Vec2::new(ring * a, tube * b),
        }
    })
}

/// Samples the Catmull–Rom spline through the given points: positions, unit directions and arc
/// lengths.
fn smooth(points: &[[f32; 2]]) -> Vec<(Vec2, Vec2, f32)> {
    let point = |k: isize| Vec2::from(points[k.clamp(0, points.len() as isize - 1) as usize]);
    let mut out: Vec<(Vec2, Vec2, f32)> = Vec::new();
    for k in 0..points.len() as isize - 1 {
        let around = [-1, 0, 1, 2].map(|by| point(k + by));
        let last = usize::from(k == points.len() as isize - 2);
        for step in 0..STEPS + last {
            let [place, along] = catmull_rom(around, step as f32 / STEPS as f32);
            let length = out.last().map_or(0.0, |(last, _, length)| length + place.distance(*last));
            out.push((place, along.normalize_or(Vec2::Y), length));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;
    use crate::geometry::checks::{check, open_edges};

    #[test]
    fn revolved_quarter_circle_is_a_hemisphere() {
        let points: Vec<[f32; 2]> =
            (0..=16).map(|k| (k as f32 / 16.0 * TAU / 4.0).sin_cos()).map(|(s, c)| [c, s]).collect();
        for vertex in revolved(&points).vertices {
            assert_abs_diff_eq!(vertex.position.length(), 1.0, epsilon = 1e-3);
            // The spline's ends are slightly flatter.
            assert!(vertex.normal.dot(vertex.position) > 0.99, "{} {}", vertex.position, vertex.normal);
        }
    }

    #[test]
    fn ring_has_no_open_edges() {
        let ring = ring(Vec3::X, 0.3, 0.1);
        check("ring", &ring, 0.99);
        assert!(open_edges(&ring).is_empty());
    }
}
