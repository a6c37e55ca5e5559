//! Flat patterns for walls and floors: ruled lines and tiles.

use glam::Vec2;

/// Returns the coverage of a line at `x`, for lines of a width at every integer; soft over `blur`
/// on each side.
pub fn line(x: f32, width: f32, blur: f32) -> f32 {
    let distance = (x - x.round()).abs() - 0.5 * width;
    (0.5 - distance / (2.0 * blur.max(1e-6))).clamp(0.0, 1.0)
}

/// Checkerboard with fields of side 1: 1 on the dark fields.
pub fn checker(p: Vec2) -> f32 {
    (p.x.floor() + p.y.floor()).rem_euclid(2.0)
}

/// Returns the coverage of a grid of two families of lines.
pub fn grid(p: Vec2, width: f32, blur: f32) -> f32 {
    line(p.x, width, blur).max(line(p.y, width, blur))
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn line_has_its_width() {
        assert_eq!([0.0, 0.09, 0.11, 0.5, 2.95].map(|x| line(x, 0.2, 1e-6)), [1.0, 1.0, 0.0, 0.0, 1.0]);
        assert_abs_diff_eq!(line(1.1, 0.2, 0.01), 0.5, epsilon = 1e-5);
        assert_eq!(grid(Vec2::new(0.5, 1.0), 0.2, 1e-6), 1.0);
        assert_eq!([checker(Vec2::new(0.5, 0.5)), checker(Vec2::new(-0.5, 0.5))], [0.0, 1.0]);
    }
}
