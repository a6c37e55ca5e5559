//! Where flakes are: one in each cell, and lattices that count the flakes of larger regions.

use asperity_noise::{IntegerHash, Lattice};
use glam::Vec3;

use super::counts::Flakes;
use crate::math::floor;

/// One flake of a [`GlintField`](super::GlintField).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlintFlake {
    /// Its unit normal in the frame of the surface, distributed by the NDF of the field.
    pub normal: Vec3,
    /// A point in it, nearer to it than to any other flake.
    pub center: Vec3,
}

/// The points of a lattice around a position, with their weights and the flakes around each.
///
/// The lattice of a level has 4ˡ flakes around each point and 2ˡ cells between points. A position
/// sees the corners of its tetrahedron, one of six in each cube (Kuhn). A point that is also one of a
/// coarser lattice has the same random word there.
pub(super) fn corners(place: Vec3, level: u32, seed: u32) -> [(f32, Flakes); 4] {
    let size = (1_u32 << level) as f32;
    let place = place / size;
    let low = place.map(floor);
    let mut corner = low.to_array().map(|x| x as i32);
    let mut steps: [(f32, usize); 3] = core::array::from_fn(|axis| ((place - low)[axis], axis));
    // Three comparisons sort three numbers, the largest first.
    for (i, k) in [(0, 1), (1, 2), (0, 1)] {
        if steps[i].0 < steps[k].0 {
            steps.swap(i, k);
        }
    }
    let [(first, a), (second, b), (third, c)] = steps;
    let weights = [1.0 - first, first - second, second - third, third];
    let count = size * size;
    let mut at = |weight: f32, step: Option<usize>| {
        if let Some(axis) = step {
            corner[axis] += 1;
        }
        // In cells of single flakes, so the word of a point does not depend on the level.
        let word = IntegerHash.word(corner.map(|x| x << level), seed);
        (weight, Flakes { word, count })
    };
    [at(weights[0], None), at(weights[1], Some(a)), at(weights[2], Some(b)), at(weights[3], Some(c))]
}

/// The cell of a position that is less than 2²³ cells away.
fn cell_of(place: Vec3) -> [i32; 3] {
    place.to_array().map(|x| {
        let whole = x as i32;
        whole - i32::from(whole as f32 > x)
    })
}

/// The jittered center of a cell, in cells.
fn center(cell: [i32; 3], seed: u32) -> Vec3 {
    let word = IntegerHash.word(cell, seed);
    let jitter = [word, word >> 10, word >> 20].map(|w| (w & 1023) as f32 / 2048.0 + 0.25);
    Vec3::from(cell.map(|x| x as f32)) + Vec3::from(jitter)
}

/// The cell of the nearest jittered center, and the center, in cells.
pub(super) fn nearest(place: Vec3, seed: u32) -> ([i32; 3], Vec3) {
    let base = cell_of(place);
    // No other center is nearer if all possible centers of its cell are farther than the center of
    // the cell of the point. Distant centers are rounded.
    let bound = place.distance_squared(center(base, seed)) * 1.000_1;
    let slack = place.abs().max_element() * f32::EPSILON + 1e-6;
    let squares = core::array::from_fn(|axis| {
        let within = place[axis] - base[axis] as f32;
        let gaps = [within + 0.25, (0.25 - within).max(within - 0.75), 1.25 - within];
        gaps.map(|gap| (gap - slack).max(0.0)).map(|gap| gap * gap)
    });
    let [across, along, up]: [[f32; 3]; 3] = squares;
    let mut best = (f32::INFINITY, base, Vec3::ZERO);
    for (k, up) in (-1..).zip(up) {
        for (j, along) in (-1..).zip(along) {
            for (i, across) in (-1..).zip(across) {
                if across + along + up <= bound {
                    let cell = [base[0] + i, base[1] + j, base[2] + k];
                    let center = center(cell, seed);
                    let distance = place.distance_squared(center);
                    if distance < best.0 {
                        best = (distance, cell, center);
                    }
                }
            }
        }
    }
    (best.1, best.2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn nearest_finds_the_nearest_of_27_centers() {
        for i in 0..3000_u16 {
            // The last ones are where the rounding of positions is an eighth of a cell.
            let far = if i < 2000 { 1.0 } else { 50_000.0 };
            let place =
                Vec3::new(f32::from(i) * 0.173, f32::from(i % 97) * 0.291 - 70.0, f32::from(i % 31) * 0.37)
                    * far;
            let base = cell_of(place);
            let around = (0..27).map(|k| [base[0] + k % 3 - 1, base[1] + k / 3 % 3 - 1, base[2] + k / 9 - 1]);
            let distances = around.map(|cell| (place.distance_squared(center(cell, 3)), cell));
            let best = distances.reduce(|best, next| if next.0 < best.0 { next } else { best }).unwrap();
            assert_eq!(nearest(place, 3), (best.1, center(best.1, 3)), "{place}");
        }
    }

    #[test]
    fn corners_are_a_partition_of_unity_that_does_not_jump() {
        for i in 0..2000_u16 {
            let p =
                Vec3::new(f32::from(i) * 0.173, f32::from(i % 97) * 0.291 - 70.0, f32::from(i % 31) * 0.37);
            let level = u32::from(i % 5);
            let here = corners(p, level, 3);
            assert_abs_diff_eq!(here.iter().map(|corner| corner.0).sum::<f32>(), 1.0, epsilon = 1e-6);
            // Words that appear or vanish within a small step have hardly any weight.
            let there = corners(p + Vec3::new(3e-4, -2e-4, 1e-4), level, 3);
            for (weight, flakes) in here {
                let same: f32 = there.iter().filter(|c| c.1.word == flakes.word).map(|c| c.0).sum();
                assert!((weight - same).abs() < 2e-3, "{p}: {weight} {same}");
            }
        }
    }
}
