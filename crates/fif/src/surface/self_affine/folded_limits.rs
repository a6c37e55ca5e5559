//! Global bounds of a folded surface and of the errors of its evaluation; lengths are in units of the domain.

use crate::numeric::interval::Interval;
use crate::numeric::polynomial::UNIT;
use crate::surface::hermite_patch::{Magnitudes, Patch};
use crate::surface::self_affine::limits::Limits;
use crate::surface::self_affine::self_affine::Part;
use crate::surface::self_affine::zig_zag::ZigZag;

/// The limits of a folded surface whose narrowest and widest cells have these shares.
pub(crate) fn limits(fold: &ZigZag, factor: f64, [narrowest, widest]: [f64; 2], contraction: f64) -> Limits {
    const SWEEPS: u32 = 64;
    let up = 1.0 + 64.0 * UNIT;
    let stretch = up / narrowest;
    let mut limits = Limits {
        stretch,
        contraction,
        gain: [up / (1.0 - factor.abs()), up / (1.0 - contraction)],
        shift: shift(widest),
        ..Limits::EMPTY
    };
    let [[h, h_x, h_y], [e, e_x, e_y]] = patches(fold, &mut limits);
    let reach = e.magnitude() * limits.gain[0] * up;
    limits.own = Interval::new(-reach, reach);
    for _ in 0..SWEEPS {
        limits.own = limits.own.intersection(e.sum(limits.own.scaled(factor)));
    }
    limits.own_slopes = [e_x, e_y].map(|range| {
        let most = range.magnitude() * limits.gain[1] * up;
        Interval::new(-most, most)
    });
    limits.range = h.sum(limits.own.scaled(factor));
    limits.slopes = [0, 1].map(|k| [h_x, h_y][k].sum(limits.own_slopes[k].scaled(contraction)));
    limits.steepest = steepest(&limits);
    limits
}

/// The orbit of a point is that of one within this distance, in units of the domain, when the widest cell has this share.
pub(crate) fn shift(widest: f64) -> f64 {
    // 16 roundings a step; going back along the orbit, a cell's share makes them smaller.
    16.0 * UNIT * (1.0 + (1.0 + 64.0 * UNIT) / (1.0 - widest))
}

/// Ranges of values and slopes of the patches of both functions, which the limits take in with their noise.
pub(crate) fn patches(fold: &ZigZag, limits: &mut Limits) -> [[Interval; 3]; 2] {
    let mut ranges = [[Interval::EMPTY; 3]; 2];
    let [m, n] = fold.cells;
    for (i, j) in (0..m).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let strips = [fold.strip_of(0, i), fold.strip_of(1, j)];
        let width = strips[0].width.min(strips[1].width);
        for (all, part) in ranges.iter_mut().zip([Part::Data, Part::Own]) {
            let patch = fold.patch(strips, part);
            let [value, along_x, along_y] = patch.ranges([0.0, 1.0], [0.0, 1.0]);
            let scaled = |range: Interval, k: usize| range.scaled(1.0 / strips[k].width).inflated(0.0);
            let here = [value, scaled(along_x, 0), scaled(along_y, 1)];
            *all = [0, 1, 2].map(|k| all[k].hull(here[k]));
            add(limits, &patch, width);
        }
    }
    let [noise, noise_slope] = limits.noise;
    let ranges =
        ranges.map(|[value, x, y]| [value.inflated(noise), x.inflated(noise_slope), y.inflated(noise_slope)]);
    let most = |k: usize| ranges[0][k].magnitude().max(ranges[1][k].magnitude());
    limits.patch = [most(0), most(1).max(most(2))];
    ranges
}

/// The greatest slope of f along either axis.
pub(crate) fn steepest(limits: &Limits) -> f64 {
    limits.slopes[0].magnitude().max(limits.slopes[1].magnitude())
}

/// Takes in a patch over a cell whose narrower side is `width`.
fn add(limits: &mut Limits, patch: &Patch, width: f64) {
    let mut corner = [0.0_f64; 3];
    for data in patch.0.iter().flatten() {
        corner = [0, 1, 2].map(|k| corner[k].max(data[k].abs()));
    }
    let magnitudes = Magnitudes::new(corner);
    // Corners are differences of the data and a bilinear function: 12 roundings of twice as much.
    let value = UNIT * ((Patch::ROUNDINGS + 24.0) * magnitudes.value + 2.0 * magnitudes.slope);
    let slope = UNIT / width * ((Patch::ROUNDINGS + 24.0) * magnitudes.slope + 2.0 * magnitudes.second);
    limits.noise = [limits.noise[0].max(value), limits.noise[1].max(slope)];
    limits.bend = limits.bend.max(2.0 * magnitudes.second / (width * width));
}

/// Rounding of a value after `steps` terms: of the patches, of powers of s, of partial sums, and of the orbit.
pub(crate) fn value_rounding(limits: &Limits, steps: u32) -> f64 {
    let steps = f64::from(steps);
    let weight = if steps < limits.gain[0] { steps + 1.0 } else { limits.gain[0] + 1.0 };
    let scale = limits.range.magnitude() + limits.patch[0];
    let moved = 2.0 * limits.shift * (limits.steepest + weight * limits.patch[1]);
    1.01 * (weight * limits.noise[0]
        + UNIT * (2.0 * (steps + 2.0) * scale + 2.0 * weight * (weight * limits.patch[0] + scale))
        + moved)
}

/// Rounding of a slope after `steps` terms, widths of cells included, but for what the gradient changes over the rounding of the point.
pub(crate) fn slope_rounding(limits: &Limits, steps: u32) -> f64 {
    let steps = f64::from(steps);
    let weight = if steps < limits.gain[1] { steps + 1.0 } else { limits.gain[1] + 1.0 };
    let [_, patch] = limits.patch;
    let scale = limits.steepest + patch;
    1.01 * (weight * (limits.noise[1] + limits.bend * 2.0 * limits.shift)
        + UNIT
            * (2.0 * (steps + 2.0) * scale
                + (4.0 + 16.0 * limits.stretch) * weight * (weight * patch + scale)))
}
