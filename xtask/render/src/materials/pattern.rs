//! Flat patterns for walls and floors: ruled lines, bricks, tiles.

use glam::{DVec2, Vec3};

/// How much of a line lies at `x`, for lines of a width at every whole number; soft over `blur` on each side.
pub fn line(x: f64, width: f64, blur: f64) -> f32 {
    let distance = (x - x.round()).abs() - 0.5 * width;
    (0.5 - distance / (2.0 * blur.max(1e-6))).clamp(0.0, 1.0) as f32
}

/// Bricks in running bond: the brick's place in the bond and how much mortar lies at the point, in units of a
/// course's height; a brick is `length` long.
pub fn brick(p: DVec2, length: f64, mortar: f64) -> ([i32; 2], f32) {
    let course = p.y.floor();
    let along = p.x / length + 0.5 * course.rem_euclid(2.0);
    let joint = line(along, mortar / length, 0.25 * mortar / length).max(line(p.y, mortar, 0.25 * mortar));
    ([along.floor() as i32, course as i32], joint)
}

/// Whether the point lies on a dark field of a checker with fields of side 1.
pub fn checker(p: DVec2) -> f32 {
    (p.x.floor() + p.y.floor()).rem_euclid(2.0) as f32
}

/// Two colours, mixed.
pub fn mix(a: Vec3, b: Vec3, share: f32) -> Vec3 {
    a + (b - a) * share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_its_width_and_joints_part_the_bricks() {
        assert_eq!([0.0, 0.09, 0.11, 0.5, 2.95].map(|x| line(x, 0.2, 1e-6)), [1.0, 1.0, 0.0, 0.0, 1.0]);
        assert!((line(1.1, 0.2, 0.01) - 0.5).abs() < 1e-6);
        // The first course: bricks from 0 to 2 and from 2 to 4; the second is shifted by half a brick.
        assert_eq!(brick(DVec2::new(1.0, 0.5), 2.0, 0.1), ([0, 0], 0.0));
        assert_eq!(brick(DVec2::new(2.0, 0.5), 2.0, 0.1), ([1, 0], 1.0));
        assert_eq!(brick(DVec2::new(2.0, 1.5), 2.0, 0.1), ([1, 1], 0.0));
        assert_eq!(brick(DVec2::new(1.0, 1.5), 2.0, 0.1), ([1, 1], 1.0));
        assert_eq!([checker(DVec2::new(0.5, 0.5)), checker(DVec2::new(-0.5, 0.5))], [0.0, 1.0]);
    }
}
