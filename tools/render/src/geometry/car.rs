//! A car-like body: one smooth surface, its wheels, and the positions of its windows.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use crate::{
    geometry::{
        mesh::{Mesh, Vertex},
        relief::differences,
        revolution::revolved,
    },
    interpolation::smootherstep,
};

/// Half of the length in meters; the front is at +x.
const LENGTH: f32 = 2.15;
/// Height of the line below the windows.
const BELT: f32 = 0.86;
/// Columns along the car and rows around it.
const CELLS: [usize; 2] = [360, 220];

/// Returns the height of the roof line.
fn top(x: f32) -> f32 {
    let body = 0.72 + 0.15 * smootherstep(2.3, 0.6, x) + 0.06 * smootherstep(-0.9, -1.8, x);
    let cabin = smootherstep(1.15, 0.10, x) * smootherstep(-2.0, -0.80, x);
    body + 0.54 * cabin
}

/// Returns the fraction of breadth and height that remains toward the ends of the car.
fn end(x: f32) -> f32 {
    (1.0 - (x.abs() / LENGTH).powf(6.0)).max(0.0).powf(1.0 / 4.4)
}

/// Returns a point of the body at a position along it and an angle around it, both within [0, 1].
fn body(along: f32, around: f32) -> Vec3 {
    // Denser at the ends, where the surface curves.
    let x = LENGTH * (PI * (along - 0.5)).sin();
    let closing = end(x);
    let (sin, cos) = (TAU * around).sin_cos();
    let round = |s: f32, power: f32| s.signum() * s.abs().powf(power);
    let (upper, lower) =
        (top(x), 0.24 + 0.05 * smootherstep(1.2, 2.1, x) + 0.07 * smootherstep(-1.3, -2.1, x));
    let middle = 0.5 * (BELT - 0.30) + 0.26;
    let z = if sin >= 0.0 {
        middle + closing * (upper - middle) * round(sin, 0.62)
    } else {
        middle + closing * (middle - lower) * round(sin, 0.42)
    };
    // The cabin leans inward.
    let lean = 1.0 - 0.34 * smootherstep(BELT - 0.14, 1.38, z) - 0.05 * smootherstep(0.55, 0.2, z);
    let breadth = 0.84 - 0.09 * smootherstep(0.8, 2.2, x) - 0.05 * smootherstep(-0.9, -2.2, x);
    Vec3::new(x, closing.sqrt() * breadth * lean * round(cos, 0.5), z)
}

/// The body; its texture coordinates are meters along the car and approximate meters around it.
pub fn car_body() -> Mesh {
    let [columns, rows] = CELLS;
    Mesh::grid(columns, rows, |i, j| {
        let [along, around] = [i as f32 / columns as f32, j as f32 / rows as f32];
        let [forward, upward] = differences(body, [along, around], 1.5e-3);
        let position = body(along, around);
        let out = Vec3::new(position.x.signum(), 0.0, 0.0);
        let normal = forward.cross(-upward).try_normalize().unwrap_or(out);
        let tangent = (forward - normal * normal.dot(forward)).normalize_or(normal.any_orthonormal_vector());
        Vertex { position, normal, tangent, uv: Vec2::new(position.x, 3.6 * around) }
    })
}

/// Returns the depth of a body point within a window in meters, negative outside the windows.
pub fn window(position: Vec3, normal: Vec3) -> f32 {
    let Vec3 { x, z, .. } = position;
    let above = (z - BELT - 0.02).min(1.335 - z);
    if normal.y.abs() > 0.55 {
        // Two side windows with a pillar between them. Their ends are inclined like the
        // windscreens.
        let front = 0.62 - 0.95 * (z - BELT) - x;
        let rear = x + 1.32 - 0.85 * (z - BELT);
        let pillar = (x + 0.42).abs() - 0.035;
        above.min(front).min(rear).min(pillar)
    } else {
        let screens = (x - 0.12).max(-1.02 - x);
        above.min(screens).min(0.60 - position.y.abs())
    }
}

/// Half the width of the gaps between doors, bonnet and bumper, in meters.
const GAP: f32 = 0.004;

/// Whether a point of the body is in a gap between panels.
pub fn gap(position: Vec3, normal: Vec3) -> bool {
    let Vec3 { x, z, .. } = position;
    let aside = position.y.abs();
    let within = |x: f32, range: [f32; 2]| x > range[0] && x < range[1];
    let at = |x: f32, place: f32| (x - place).abs() < GAP;
    if normal.y.abs() > 0.55 {
        // Two doors, whose front edge is inclined like the windscreen.
        let front = 0.78 - 0.2 * (z - BELT);
        let upright = [front, -0.42, -1.04].iter().any(|&edge| at(x, edge)) && within(z, [0.33, BELT]);
        upright || at(z, 0.33) && within(x, [-1.04, front])
    } else if normal.z > 0.3 && x > 0.0 {
        let bonnet = [1.08, 1.93];
        at(aside, 0.60) && within(x, bonnet) || aside < 0.60 && bonnet.iter().any(|&edge| at(x, edge))
    } else {
        normal.x.abs() > 0.3 && at(z, 0.53)
    }
}

/// Returns the depth of a body point within a headlamp in meters, negative outside the headlamps.
pub fn headlamp(position: Vec3, normal: Vec3) -> f32 {
    let Vec3 { x, y, z } = position;
    let lower = 0.575 + 0.12 * (y.abs() - 0.45);
    let across = (y.abs() - 0.40).min(0.74 - y.abs());
    if normal.x > 0.1 && x > 1.6 { across.min(z - lower).min(lower + 0.085 - z) } else { -1.0 }
}

/// Whether a point of the body is in the dark part of the grille.
pub fn grille(position: Vec3) -> bool {
    let Vec3 { x, y, z } = position;
    // Horizontal bars.
    x > 1.8
        && y.abs() < 0.46 - 0.5 * (z - 0.46).abs()
        && (z - 0.42).abs() < 0.065
        && (z * 32.0).fract() > 0.25
}

/// Positions of the wheels along the car, and above the ground; also their radius.
pub const WHEELS: [[f32; 2]; 2] = [[-1.28, 0.325], [1.32, 0.325]];

/// Whether a point of the body is in the dark wheel arch.
pub fn arch(position: Vec3) -> bool {
    WHEELS.iter().any(|[x, z]| (position.x - x).hypot(position.z - z) < 0.375 && position.y.abs() > 0.4)
}

/// Returns a tire about the y axis, upright, with its outer side toward −y, and the disc inside it.
pub fn wheel(center: Vec3) -> [Mesh; 2] {
    let turn = |mut mesh: Mesh| {
        let upright = |p: Vec3| Vec3::new(p.x, -p.z, p.y);
        for vertex in &mut mesh.vertices {
            vertex.position = center + upright(vertex.position);
            vertex.normal = upright(vertex.normal);
            vertex.tangent = upright(vertex.tangent);
        }
        mesh
    };
    let tyre = [[0.21, -0.10], [0.30, -0.105], [0.325, -0.06], [0.325, 0.06], [0.30, 0.105], [0.21, 0.09]];
    let disc = [[0.215, 0.08], [0.19, 0.075], [0.15, 0.045], [0.08, 0.055], [0.03, 0.07], [0.0, 0.07]];
    [turn(revolved(&tyre)), turn(revolved(&disc))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::checks::check;

    #[test]
    fn body_normals_point_outward() {
        let mesh = car_body();
        check("car", &mesh, 0.0);
        for v in &mesh.vertices {
            let outward = v.position - Vec3::new(v.position.x * 0.9, 0.0, 0.55);
            assert!(v.normal.dot(outward) > -0.02, "{v:?}");
        }
    }

    #[test]
    fn windows_are_above_the_belt_and_not_in_the_roof() {
        assert!(window(Vec3::new(0.0, 0.7, 1.1), Vec3::Y) > 0.0);
        assert!(window(Vec3::new(0.0, 0.7, 0.8), Vec3::Y) < 0.0);
        assert!(window(Vec3::new(0.4, 0.0, 1.1), Vec3::new(0.8, 0.0, 0.6)) > 0.0);
        assert!(window(Vec3::new(-0.4, 0.0, 1.3), Vec3::Z) < 0.0);
    }
}
