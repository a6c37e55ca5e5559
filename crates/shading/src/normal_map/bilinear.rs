//! Bilinear interpolation between the centers of the texels of a periodic map.

use glam::Vec2;

use crate::math::floor;

/// The four texels around a point and their weights.
pub(super) fn corners(uv: Vec2, [width, height]: [usize; 2]) -> [(f32, usize); 4] {
    let axis = |u: f32, size: usize| {
        // The fraction of NaN or infinity is NaN.
        let turn = u - floor(u);
        let place = if turn > 0.0 { turn * size as f32 } else { 0.0 } - 0.5;
        let first = floor(place);
        // −1 is the last one, and `size` the first.
        let i = (first as i64).rem_euclid(size as i64) as usize;
        (i, if i + 1 < size { i + 1 } else { 0 }, place - first)
    };
    let ((left, right, x), (low, high, y)) = (axis(uv.x, width), axis(uv.y, height));
    [
        ((1.0 - x) * (1.0 - y), low * width + left),
        (x * (1.0 - y), low * width + right),
        ((1.0 - x) * y, high * width + left),
        (x * y, high * width + right),
    ]
}

/// The slope at a point; missing texels are read as 0.
pub(super) fn bilinear(uv: Vec2, size: [usize; 2], slopes: &[Vec2]) -> Vec2 {
    corners(uv, size)
        .into_iter()
        .fold(Vec2::ZERO, |sum, (weight, k)| sum + weight * slopes.get(k).copied().unwrap_or_default())
}
