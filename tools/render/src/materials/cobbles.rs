//! A periodic bump map of worn cobbles with mortar, as a stand-in for an existing map.

use glam::{Vec2, Vec3};

/// Cobbles along a side of the map.
const CELLS: i32 = 7;

/// Returns the unit normals of `size · size` texels, row by row from the lower end; `n_y` grows
/// with the row.
pub fn cobbles(size: usize) -> Vec<Vec3> {
    let step = 1.0 / size as f32;
    let height =
        |i: usize, j: usize| height(Vec2::new((i % size) as f32 + 0.5, (j % size) as f32 + 0.5) * step);
    let slope = |ahead: f32, behind: f32| (behind - ahead) / (2.0 * step);
    (0..size * size)
        .map(|k| (k % size, k / size))
        .map(|(i, j)| {
            let (left, below) = (i + size - 1, j + size - 1);
            let x = slope(height(i + 1, j), height(left, j));
            let y = slope(height(i, j + 1), height(i, below));
            Vec3::new(x, y, 1.0).normalize()
        })
        .collect()
}

/// Returns the height at a point of the unit square, in units of its side.
fn height(p: Vec2) -> f32 {
    let cell = p * CELLS as f32;
    let (mut nearest, mut second) = (f32::MAX, f32::MAX);
    let mut tilt = Vec2::ZERO;
    let mut from = Vec2::ZERO;
    for k in 0..25 {
        let neighbor = cell.floor().as_ivec2() + glam::IVec2::new(k % 5 - 2, k / 5 - 2);
        let wrapped = neighbor.rem_euclid(glam::IVec2::splat(CELLS));
        let [a, b, c, d] = hash(wrapped.x as u32, wrapped.y as u32);
        let offset = neighbor.as_vec2() + Vec2::splat(0.5) + 0.62 * Vec2::new(a - 0.5, b - 0.5) - cell;
        let distance = offset.length();
        if distance < nearest {
            (second, nearest) = (nearest, distance);
            (tilt, from) = (Vec2::new(c - 0.5, d - 0.5), offset);
        } else if distance < second {
            second = distance;
        }
    }
    // The distance to the border between two cobbles, rounded off.
    let border = (0.5 * (second - nearest) / 0.32).clamp(0.0, 1.0);
    let dome = 1.0 - (1.0 - border) * (1.0 - border) * (1.0 - border);
    (0.17 * dome - 0.10 * from.dot(tilt) - 0.05 * from.length_squared()) / CELLS as f32
}

/// Returns four numbers in [0, 1) for a cell.
fn hash(x: u32, y: u32) -> [f32; 4] {
    let mut word = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ 0x27D4_EB2F;
    [(); 4].map(|()| {
        word ^= word >> 15;
        word = word.wrapping_mul(0x2C1B_3C6D);
        word ^= word >> 12;
        word = word.wrapping_mul(0x297A_2D39);
        word ^= word >> 15;
        (word >> 8) as f32 / (1 << 24) as f32
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn cobbles_are_periodic() {
        for k in 0..64 {
            let t = (k as f32 + 0.5) / 64.0;
            assert_abs_diff_eq!(height(Vec2::new(0.0, t)), height(Vec2::new(1.0, t)), epsilon = 1e-5);
            assert_abs_diff_eq!(height(Vec2::new(t, 0.0)), height(Vec2::new(t, 1.0)), epsilon = 1e-5);
        }
        let normals = cobbles(64);
        assert!(normals.iter().all(|n| n.is_normalized() && n.z > 0.2));
        // The mean slope of a height field is zero.
        let mean: Vec3 = normals.iter().map(|n| *n / n.z).sum::<Vec3>() / normals.len() as f32;
        assert_abs_diff_eq!(mean.truncate(), Vec2::ZERO, epsilon = 7e-4);
    }
}
