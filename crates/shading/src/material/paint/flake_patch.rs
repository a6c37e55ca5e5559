//! Patches of space, one per flake: the patch of a point, and the tilt of the flake.

use asperity_noise::{IntegerHash, Lattice};
use glam::Vec3;

use crate::material::segment::unit;
use crate::math::{clamp_to, cos, floor, pow, sin, sqrt};

/// The flake that contains a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FlakePatch {
    /// A random number in [0, 1), the same for all points of the flake.
    pub(super) value: f32,
    /// The center of the cell of the flake, which identifies it.
    center: Vec3,
    /// Tilt, to be added to a unit normal: a vector uniform in the unit ball.
    pub(super) tilt: Vec3,
}

/// The flake of the cell of a point, and the fraction of a pixel that it covers.
///
/// ```text
/// cover = Π_i clamp((widthᵢ/2 − |dᵢ|)/edgeᵢ + ½, 0, 1)
/// ```
///
/// with `d` of [`nearest_flake`] at a scatter of 1: the box of the flake, filtered by a box of
/// sides `edge`. The edges are at most the width, and at most the rest of the cell, so that the
/// flake stays in the cell. The mean cover over a plane across axis i is then `Π_j widthⱼ/cell` of
/// the other two axes, if the width along axis i is the cell.
///
/// - **Domain:** `cell` > 0, each width at most `cell`. `None` for a point with |pᵢ| ≥ 2²³ cells
///   and where the position or the cell is not finite.
pub(super) fn covered_flake(
    position: Vec3,
    cell: f32,
    width: Vec3,
    edge: f32,
    seed: u32,
) -> Option<(FlakePatch, f32)> {
    let edges = width.min(Vec3::splat(cell) - width).min(Vec3::splat(edge)).max(Vec3::ZERO);
    let (flake, off) = nearest_flake(position, cell, width + edges, 1.0, seed)?;
    let along = |axis: usize| match edges[axis] > 0.0 {
        true => clamp_to((0.5 * width[axis] - off[axis]) / edges[axis] + 0.5, 1.0),
        // As wide as the cell, or without any width.
        false => f32::from(u8::from(width[axis] > 0.0)),
    };
    Some((flake, along(0) * along(1) * along(2)))
}

/// The flake of the cell of a point, and the distance |dᵢ| of the point from its center along each
/// axis.
///
/// ```text
/// d = (frac(p/cell) − ½) cell − scatter r (cell − width),   inside where |dᵢ| ≤ widthᵢ/2,   center = p − d
/// ```
///
/// with three random numbers r of the cell in [−½, ½). Without scatter, flakes are in the middle of
/// their cells, as in the thesis, which shows as a grid. With a scatter of 1 they may be anywhere
/// in them. A flake keeps all of its points as it becomes wider.
///
/// Cells do not move while the width of flakes changes with the distance. A width of a whole cell
/// or more fills space with flakes.
///
/// - **Domain:** `cell` > 0. `None` for a point with |pᵢ| ≥ 2²³ cells, where cells cannot be
///   distinguished, and where the position or the cell is not finite.
/// - **Random numbers** are hashes of the cell and the seed. The thesis has 256 different flakes,
///   tilted towards the corners of a cube: at a strength of 0.2 the steepest tenth is 38 times
///   denser along the diagonals than along the axes.
///
/// Nilsson 2008, §4.3.4, *Width of a PRNG-patch*. The printed `PRNG_square` finds a flake in only
/// 2⁻²⁴ of space, because its fraction wraps around the texture instead of the texel.
fn nearest_flake(
    position: Vec3,
    cell: f32,
    width: Vec3,
    scatter: f32,
    seed: u32,
) -> Option<(FlakePatch, Vec3)> {
    const FARTHEST: f32 = 8_388_608.0;
    let place = position / cell;
    // Written so that NaN returns `None`.
    if !(place.abs().max_element() < FARTHEST && place.is_finite()) {
        return None;
    }
    let corner = Vec3::from(place.to_array().map(floor));
    let cells = corner.to_array().map(|c| c as i32);
    let random = |k: u32| unit(IntegerHash.word(cells, seed ^ k.wrapping_mul(0x9e37_79b9)));
    let room = (Vec3::ONE - width / cell).clamp(Vec3::ZERO, Vec3::ONE) * clamp_to(scatter, 1.0);
    let middle = Vec3::splat(0.5) + (Vec3::new(random(4), random(5), random(6)) - 0.5) * room;
    let off = ((place - corner) - middle).abs() * cell;
    let flake = FlakePatch {
        value: random(0),
        center: (corner + middle) * cell,
        tilt: ball([random(1), random(2), random(3)]),
    };
    Some((flake, off))
}

/// A vector uniform in the unit ball.
fn ball([u, v, w]: [f32; 3]) -> Vec3 {
    let z = 1.0 - 2.0 * u;
    let (across, turn) = (sqrt((1.0 - z * z).max(0.0)), core::f32::consts::TAU * v);
    Vec3::new(across * cos(turn), across * sin(turn), z) * pow(w, 1.0 / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::{SplitMix64, assert_abs_diff_eq};

    /// The flake that contains a point.
    fn flake_patch(position: Vec3, cell: f32, width: Vec3, scatter: f32, seed: u32) -> Option<FlakePatch> {
        let (flake, off) = nearest_flake(position, cell, width, scatter, seed)?;
        off.cmple(0.5 * width).all().then_some(flake)
    }

    #[test]
    fn points_of_a_flake_return_the_same_patch() {
        let width = Vec3::new(0.3, 0.2, 0.4);
        let center = Vec3::new(2.5, -1.5, 0.5);
        let flake = flake_patch(center, 1.0, width, 0.0, 9).unwrap();
        for corner in [Vec3::ONE, Vec3::NEG_ONE, Vec3::new(1.0, -1.0, 1.0)] {
            assert_eq!(flake_patch(center + corner * width * 0.499, 1.0, width, 0.0, 9), Some(flake));
            assert_eq!(flake_patch(center + corner * width * 0.501, 1.0, width, 0.0, 9), None);
        }
        let others =
            [center + Vec3::X, center - Vec3::Y].map(|c| flake_patch(c, 1.0, width, 0.0, 9).unwrap());
        assert!(others.iter().all(|other| other.value != flake.value && other.tilt != flake.tilt));
        assert_ne!(flake_patch(center, 1.0, width, 0.0, 10).unwrap().value, flake.value);
    }

    #[test]
    fn scattered_flakes_keep_their_points_as_they_grow() {
        let mut inside = 0;
        for i in 0..2000_u16 {
            let p = Vec3::new(f32::from(i) * 0.173, f32::from(i) * 0.291 - 70.0, f32::from(i) * 0.117);
            let at = |width: f32| flake_patch(p, 1.0, Vec3::splat(width), 1.0, 5);
            let mut before = None;
            for k in 1..=20_u8 {
                let flake = at(f32::from(k) / 20.0);
                assert!(before.is_none() || flake.is_some(), "{p}, {k}");
                before = flake;
            }
            inside += u16::from(at(0.5).is_some());
        }
        // An eighth of space: four standard errors of 2000 points.
        assert!(inside.abs_diff(250) < 60, "{inside}");
    }

    #[test]
    fn tilts_are_uniform_in_the_ball() {
        let (mut radii, mut squares) = (0.0, Vec3::ZERO);
        for i in 0..4096_u16 {
            let p = Vec3::new(f32::from(i % 16), f32::from(i / 16 % 16), f32::from(i / 256)) + 0.5;
            let tilt = flake_patch(p, 1.0, Vec3::ONE, 0.0, 3).unwrap().tilt;
            assert!(tilt.length() < 1.00001);
            radii += tilt.length_squared();
            squares += tilt * tilt;
        }
        // E r² = 3/5 and a third of it along each axis; standard deviations 0.26 and 0.21, four
        // standard errors of 4096.
        assert_abs_diff_eq!(radii / 4096.0, 0.6, epsilon = 0.017);
        assert_abs_diff_eq!(squares / 4096.0, Vec3::splat(0.2), epsilon = 0.013);
    }

    #[test]
    fn flake_patch_of_invalid_points_is_none() {
        for x in [f32::NAN, f32::INFINITY, 1e30] {
            assert_eq!(flake_patch(Vec3::new(x, 0.0, 0.0), 1.0, Vec3::ONE, x, 0), None, "{x}");
            assert_eq!(flake_patch(Vec3::ZERO, x, Vec3::ONE, 0.0, 0), None, "{x}");
        }
        assert_eq!(flake_patch(Vec3::ZERO, 1.0, Vec3::NAN, 0.0, 0), None);
    }

    #[test]
    fn patch_has_its_pinned_values() {
        let patch = flake_patch(Vec3::new(0.37, -1.21, 2.83), 0.01, Vec3::splat(0.01), 0.5, 1).unwrap();
        let [tilt, center] =
            [[0.160_218_91, -0.556_663_7, 0.689_331_9], [0.375, -1.214_999_9, 2.835]].map(Vec3::from_array);
        assert!((patch.tilt - tilt).abs().cmple(1e-6 * tilt.abs()).all(), "{patch:?}");
        assert!((patch.center - center).abs().cmple(1e-6 * center.abs()).all(), "{patch:?}");
    }

    #[test]
    fn flakes_tilt_isotropically() {
        // Tilts steeper than 0.8, in directions of 45° and of 0° about z: equally many per solid
        // angle.
        let (mut axes, mut diagonals) = (0.0, 0.0);
        let mut random = SplitMix64 { state: 8 };
        let mut uniform = || (random.word() >> 11) as f64 * (-53_f64).exp2();
        for _ in 0..400_000 {
            let p = Vec3::new(uniform() as f32, uniform() as f32, uniform() as f32) * 4000.0;
            let tilt = flake_patch(p, 1.0, Vec3::ONE, 0.0, 2).unwrap().tilt;
            let r = tilt.length();
            if r > 0.8 && tilt.z.abs() < 0.2 * r {
                let octant = (tilt.y.atan2(tilt.x) / core::f32::consts::FRAC_PI_4).round() as i32;
                *(if octant % 2 == 0 { &mut axes } else { &mut diagonals }) += 1.0;
            }
        }
        // About 20000 each: four standard errors of their ratio.
        let ratio: f64 = axes / diagonals;
        assert_abs_diff_eq!(
            ratio,
            1.0,
            epsilon = 4.0 * (2.0_f64 / diagonals).sqrt(),
            "{axes} and {diagonals}"
        );
    }
}
