//! The torus folded by an integer matrix, with its nodes.

use alloc::vec::Vec;
use asperity_core::Interval;
use asperity_core::math::sqrt_f64;

use crate::numeric::matrix2::{IDENTITY, added, product};
use crate::numeric::polynomial::UNIT;
use crate::surface::hermite_patch::{Corner, Magnitudes, Patch};
use crate::surface::self_affine::limits::Limits;

/// The unit torus under an integer matrix, with nodes on a square grid.
#[derive(Clone, Debug)]
pub struct TorusFold {
    pub(crate) nodes: Vec<Node>,
    pub(crate) bits: u32,
    pub(crate) matrix: [[i32; 2]; 2],
    /// `s M`.
    pub(crate) scaled: [[f64; 2]; 2],
}

/// A node: its data and the data of the corner of the patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// `p` and its slopes per width of a cell.
    pub(crate) corner: Corner,
    /// `z` and `d` as given.
    pub(crate) data: Corner,
}

impl TorusFold {
    /// The number of nodes along a side.
    #[inline]
    #[must_use]
    pub const fn side(&self) -> usize {
        1 << self.bits
    }

    /// The node of an index pair, modulo the side.
    #[inline]
    pub(crate) fn node(&self, [i, j]: [usize; 2]) -> Node {
        const NONE: Node = Node { corner: [0.0; 3], data: [0.0; 3] };
        let mask = (1 << self.bits) - 1;
        self.nodes.get((i & mask) << self.bits | j & mask).copied().unwrap_or(NONE)
    }

    /// The patch of p over a cell.
    #[inline]
    pub(crate) fn patch(&self, [i, j]: [usize; 2]) -> Patch {
        let corner = |i, j| self.node([i, j]).corner;
        let [next_i, next_j] = [i.wrapping_add(1), j.wrapping_add(1)];
        Patch([[corner(i, j), corner(i, next_j)], [corner(next_i, j), corner(next_i, next_j)]])
    }
}

/// The limits of a torus surface whose heights and slopes have magnitudes `[z, x, y]`.
pub(crate) fn limits(
    fold: &TorusFold,
    factor: f64,
    [norm, contraction]: [f64; 2],
    [z, x, y]: Corner,
) -> Limits {
    let side = fold.side();
    let scale = side as f64;
    let mut corner = [0.0_f64; 3];
    let (mut value, mut along) = (Interval::EMPTY, [Interval::EMPTY; 2]);
    for (index, node) in fold.nodes.iter().enumerate() {
        for (most, part) in corner.iter_mut().zip(node.corner) {
            *most = most.max(part.abs());
        }
        let [p, p_x, p_y] =
            fold.patch([index >> fold.bits, index & (side - 1)]).ranges([0.0, 1.0], [0.0, 1.0]);
        value = value.hull(p);
        along = [along[0].hull(p_x), along[1].hull(p_y)];
    }
    let along = along.map(|range| range.scaled(scale));
    let magnitudes = Magnitudes::new(corner);
    // The data of the corners, each with at most 5 roundings.
    let turned = factor.abs() * 2.0 * norm * x.max(y);
    let given = Magnitudes::new([z * (1.0 + factor.abs()), (x + turned) / scale, (y + turned) / scale]);
    let noise = [
        UNIT * (Patch::ROUNDINGS * magnitudes.value + 2.0 * magnitudes.slope + 5.0 * given.value),
        scale * UNIT * (Patch::ROUNDINGS * magnitudes.slope + 2.0 * magnitudes.second + 5.0 * given.slope),
    ];
    let up = 1.0 + 8.0 * UNIT;
    let gain = [1.0 / (1.0 - factor.abs()) * up, 1.0 / (1.0 - contraction) * up];
    let length = |a: f64, b: f64| {
        let most = a.max(b).max(f64::MIN_POSITIVE);
        most * sqrt_f64((a / most) * (a / most) + (b / most) * (b / most)) * up
    };
    let patch = [value.magnitude(), length(along[0].magnitude(), along[1].magnitude())];
    let steepest = patch[1] * gain[1] * up + f64::MIN_POSITIVE;
    let range = Interval::new(-patch[0] * gain[0] * up, patch[0] * gain[0] * up);
    let slopes = [Interval::new(-steepest, steepest); 2];
    let bend = 2.0 * scale * scale * magnitudes.second;
    let mut limits = Limits {
        stretch: norm,
        contraction,
        gain,
        noise,
        patch,
        bend,
        shift: 0.0,
        range,
        slopes,
        own: range,
        own_slopes: slopes,
        steepest,
    };
    settle(&mut limits, value.inflated(noise[0]), along.map(|range| range.inflated(noise[1])), fold, factor);
    (limits.own, limits.own_slopes) = (limits.range, limits.slopes);
    limits
}

/// Tighter enclosures from the functional equations: an enclosure of f on the right is one on the
/// left.
fn settle(limits: &mut Limits, value: Interval, along: [Interval; 2], fold: &TorusFold, factor: f64) {
    const SWEEPS: u32 = 64;
    let (mut sum, mut jacobian, mut rest) =
        ([Interval::new(0.0, 0.0); 2], IDENTITY, Interval::new(-limits.steepest, limits.steepest));
    for _ in 0..SWEEPS {
        limits.range = limits.range.intersection(value.sum(limits.range.scaled(factor)));
        sum = added(sum, &jacobian, along);
        jacobian = product(&fold.scaled, &jacobian);
        rest = rest.scaled(limits.contraction);
    }
    let margin = slope_rounding(limits, SWEEPS, limits.steepest);
    limits.slopes = sum
        .map(|range| range.sum(rest).inflated(margin))
        .map(|range| range.intersection(Interval::new(-limits.steepest, limits.steepest)));
}

/// Rounding of a value after `steps` terms.
///
/// It includes the patches, powers of s, and partial sums of up to twice the range.
pub(crate) fn value_rounding(limits: &Limits, steps: u32) -> f64 {
    let steps = f64::from(steps);
    let weight = if steps < limits.gain[0] { steps } else { limits.gain[0] };
    let scale = limits.range.magnitude();
    1.01 * (weight * limits.noise[0]
        + UNIT * (2.0 * (steps + 2.0) * scale + 2.0 * weight * (weight * limits.patch[0] + scale)))
}

/// Rounding of a gradient after `steps` terms.
///
/// It includes the patches, Jacobians, which err by at most 8 k units after k products relative to
/// `(|s| ‖M‖)ᵏ`, products with them, and partial sums up to `largest`.
pub(crate) fn slope_rounding(limits: &Limits, steps: u32, largest: f64) -> f64 {
    let steps = f64::from(steps);
    let weight = if steps < limits.gain[1] { steps } else { limits.gain[1] };
    let [_, patch] = limits.patch;
    1.01 * (weight * (1.5 * limits.noise[1] + 4.0 * UNIT * patch)
        + UNIT * ((steps + 2.0) * largest + 9.0 * weight * (weight * patch + limits.steepest)))
}
/// `‖M‖₂`, rounded up: `√((T + √(T² − 4 det²))/2)` with the sum T of all squares.
pub(crate) fn spectral_norm(matrix: &[[i32; 2]; 2]) -> f64 {
    let [[a, b], [c, d]] = matrix.map(|row| row.map(i128::from));
    let (total, determinant) = (a * a + b * b + c * c + d * d, (a * d - b * c).abs());
    // Both factors are exact integers below 2⁶⁵, so nothing cancels.
    let root = sqrt_f64((total - 2 * determinant) as f64 * (total + 2 * determinant) as f64);
    sqrt_f64(0.5 * (total as f64 + root)) * (1.0 + 8.0 * UNIT)
}
