//! Meshes of things made on a wheel: profiles turned about the z axis, and rings for handles.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::{
    geometry::mesh::{Mesh, Vertex},
    interpolation::catmull_rom,
};

/// Steps of a profile from one of its points to the next.
const STEPS: usize = 16;

/// Steps around the axis.
const AROUND: usize = 192;

/// The smooth profile through points `(radius, height)`, turned about the z axis; its outside is to the right of the way along it.
///
/// Texture coordinates are the angle and the length along the profile.
pub fn revolved(points: &[[f32; 2]]) -> Mesh {
    let profile = smooth(points);
    // The last column lies where the first does, with texture coordinates of its own.
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

/// A ring of radius `ring` about `centre`, upright in the x–z plane, of a tube of radius `tube`.
pub fn ring(centre: Vec3, ring: f32, tube: f32) -> Mesh {
    let (columns, rows) = (AROUND / 2, AROUND / 4);
    Mesh::grid(rows, columns, |row, column| {
        let (a, b) = (TAU * (columns - column) as f32 / columns as f32, TAU * row as f32 / rows as f32);
        let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
        let out = Vec3::new(cb * ca, sb, cb * sa);
        Vertex {
            position: centre + ring * Vec3::new(ca, 0.0, sa) + tube * out,
            normal: out,
            tangent: Vec3::new(-sa, 0.0, ca),
            uv: Vec2::new(ring * a, tube * b),
        }
    })
}

/// Points of the Catmull–Rom spline through the given ones, with its unit directions and lengths up to there.
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
    fn a_turned_quarter_circle_is_a_hemisphere() {
        let points: Vec<[f32; 2]> =
            (0..=16).map(|k| (k as f32 / 16.0 * TAU / 4.0).sin_cos()).map(|(s, c)| [c, s]).collect();
        for vertex in revolved(&points).vertices {
            assert_abs_diff_eq!(vertex.position.length(), 1.0, epsilon = 1e-3);
            // The spline's ends are a little flatter.
            assert!(vertex.normal.dot(vertex.position) > 0.99, "{} {}", vertex.position, vertex.normal);
        }
    }

    #[test]
    fn a_ring_has_no_open_edge() {
        let ring = ring(Vec3::X, 0.3, 0.1);
        check("ring", &ring, 0.99);
        assert!(open_edges(&ring).is_empty());
    }
}
