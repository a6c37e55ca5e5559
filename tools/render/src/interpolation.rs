//! Interpolation: smooth steps and the Catmull–Rom spline.

use glam::Vec2;

/// Step from 0 at `low` to 1 at `high`: `t² (3 − 2t)`.
pub fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Step from 0 at `low` to 1 at `high` with two continuous derivatives: `t³ (6t² − 15t + 10)`.
pub fn smootherstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * t * (t * (6.0 * t - 15.0) + 10.0)
}

/// Returns position and derivative at `t` of the Catmull–Rom segment between the second and third
/// of four points.
pub fn catmull_rom([a, b, c, d]: [Vec2; 4], t: f32) -> [Vec2; 2] {
    let linear = 0.5 * (c - a);
    let (square, cube) = (a - 2.5 * b + 2.0 * c - 0.5 * d, 1.5 * (b - c) + 0.5 * (d - a));
    [b + t * (linear + t * (square + t * cube)), linear + t * (2.0 * square + t * 3.0 * cube)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_and_splines_interpolate_their_ends() {
        for step in [smoothstep, smootherstep] {
            assert_eq!([0.0, 1.0, 1.5, 2.0, 3.0].map(|x| step(1.0, 2.0, x)), [0.0, 0.0, 0.5, 1.0, 1.0]);
        }
        let points = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        assert_eq!([0.0, 1.0].map(|t| catmull_rom(points, t)[0]), [Vec2::X, Vec2::ONE]);
        assert_eq!(catmull_rom(points, 0.0)[1], Vec2::splat(0.5));
    }
}
