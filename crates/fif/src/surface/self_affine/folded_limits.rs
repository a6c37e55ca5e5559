//! Global bounds of a folded surface and of the errors of its evaluation; lengths are in units of the domain.

use crate::numeric::interval::Interval;
use crate::numeric::polynomial::UNIT;
use crate::surface::hermite_patch::{Magnitudes, Patch};
use crate::surface::self_affine::folded::{FoldedSurface, Part};
use crate::surface::self_affine::folded_node::FoldedNode;

/// What bounds need, rounded up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FoldedLimits {
    /// `1/a` for the smallest share a of a cell in the domain.
    pub(crate) stretch: f64,
    /// `|s|/a`.
    pub(crate) contraction: f64,
    /// `1/(1 − |s|)` and `1/(1 − |s|/a)`.
    pub(crate) gain: [f64; 2],
    /// Error of one patch's value and slopes.
    pub(crate) noise: [f64; 2],
    /// The greatest value and slope of `H` and `H − G`.
    pub(crate) patch: [f64; 2],
    /// A Lipschitz constant of the slopes of both.
    pub(crate) bend: f64,
    /// The computed orbit of a point stays this close to that of a point this close.
    pub(crate) shift: f64,
    /// Encloses `f`.
    pub(crate) range: Interval,
    /// Enclose the slopes of f.
    pub(crate) slopes: [Interval; 2],
    /// Encloses `w`.
    pub(crate) own: Interval,
    /// The greatest slopes of w.
    pub(crate) own_slopes: [f64; 2],
}

impl FoldedLimits {
    pub(crate) const EMPTY: Self = Self {
        stretch: 0.0,
        contraction: 0.0,
        gain: [0.0; 2],
        noise: [0.0; 2],
        patch: [0.0; 2],
        bend: 0.0,
        shift: 0.0,
        range: Interval::EMPTY,
        slopes: [Interval::EMPTY; 2],
        own: Interval::EMPTY,
        own_slopes: [0.0; 2],
    };

    pub(crate) fn new<S: AsRef<[FoldedNode]>>(
        surface: &FoldedSurface<S>,
        [narrowest, widest]: [f64; 2],
        contraction: f64,
    ) -> Self {
        const SWEEPS: u32 = 64;
        let up = 1.0 + 64.0 * UNIT;
        let factor = surface.factor;
        let stretch = up / narrowest;
        let mut limits = Self {
            stretch,
            contraction,
            gain: [up / (1.0 - factor.abs()), up / (1.0 - contraction)],
            // 16 roundings in units of the domain a step; going back along the orbit, a cell's share makes them smaller.
            shift: 16.0 * UNIT * (1.0 + up / (1.0 - widest)),
            ..Self::EMPTY
        };
        let mut ranges = [[Interval::EMPTY; 3]; 2];
        let [m, n] = surface.cells;
        for (i, j) in (0..m).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let strips = [surface.strip_of(0, i), surface.strip_of(1, j)];
            let width = strips[0].width.min(strips[1].width);
            for (all, part) in ranges.iter_mut().zip([Part::Data, Part::Own]) {
                let patch = surface.patch(strips, part);
                let [value, along_x, along_y] = patch.ranges([0.0, 1.0], [0.0, 1.0]);
                let scaled = |range: Interval, k: usize| range.scaled(1.0 / strips[k].width).inflated(0.0);
                let here = [value, scaled(along_x, 0), scaled(along_y, 1)];
                *all = [0, 1, 2].map(|k| all[k].hull(here[k]));
                limits.add(&patch, width);
            }
        }
        let [[h, h_x, h_y], [e, e_x, e_y]] = ranges;
        let [noise, noise_slope] = limits.noise;
        let [h, e] = [h, e].map(|range| range.inflated(noise));
        let [h_x, h_y, e_x, e_y] = [h_x, h_y, e_x, e_y].map(|range| range.inflated(noise_slope));
        let most =
            |ranges: &[Interval]| ranges.iter().fold(0.0_f64, |most, range| most.max(range.magnitude()));
        limits.patch = [most(&[h, e]), most(&[h_x, h_y, e_x, e_y])];
        let reach = e.magnitude() * limits.gain[0] * up;
        limits.own = Interval::new(-reach, reach);
        for _ in 0..SWEEPS {
            limits.own = limits.own.intersection(e.sum(limits.own.scaled(factor)));
        }
        limits.own_slopes = [e_x, e_y].map(|range| range.magnitude() * limits.gain[1] * up);
        limits.range = h.sum(limits.own.scaled(factor));
        limits.slopes = [0, 1].map(|k| {
            let own = Interval::new(-limits.own_slopes[k], limits.own_slopes[k]);
            [h_x, h_y][k].sum(own.scaled(contraction))
        });
        limits
    }

    /// Takes in a patch over a cell whose narrower side is `width`.
    fn add(&mut self, patch: &Patch, width: f64) {
        let mut corner = [0.0_f64; 3];
        for data in patch.0.iter().flatten() {
            corner = [0, 1, 2].map(|k| corner[k].max(data[k].abs()));
        }
        let magnitudes = Magnitudes::new(corner);
        // Corners are differences of the data and a bilinear function: 12 roundings of twice as much.
        let value = UNIT * ((Patch::ROUNDINGS + 24.0) * magnitudes.value + 2.0 * magnitudes.slope);
        let slope = UNIT / width * ((Patch::ROUNDINGS + 24.0) * magnitudes.slope + 2.0 * magnitudes.second);
        self.noise = [self.noise[0].max(value), self.noise[1].max(slope)];
        self.bend = self.bend.max(2.0 * magnitudes.second / (width * width));
    }

    pub(crate) fn is_finite(&self) -> bool {
        [self.range, self.slopes[0], self.slopes[1]].iter().all(|range| range.magnitude().is_finite())
            && self.noise[0].is_finite()
            && self.noise[1].is_finite()
            && self.bend.is_finite()
    }

    /// The greatest slope of f along either axis.
    pub(crate) fn steepest(&self) -> f64 {
        self.slopes[0].magnitude().max(self.slopes[1].magnitude())
    }

    /// Rounding of a value after `steps` terms: of the patches, of powers of s, of partial sums, and of the orbit.
    pub(crate) fn value_rounding(&self, steps: u32) -> f64 {
        let steps = f64::from(steps);
        let weight = if steps < self.gain[0] { steps + 1.0 } else { self.gain[0] + 1.0 };
        let scale = self.range.magnitude() + self.patch[0];
        let moved = 2.0 * self.shift * (self.steepest() + weight * self.patch[1]);
        1.01 * (weight * self.noise[0]
            + UNIT * (2.0 * (steps + 2.0) * scale + 2.0 * weight * (weight * self.patch[0] + scale))
            + moved)
    }

    /// Rounding of a slope after `steps` terms, widths of cells included, but for what the gradient changes over the rounding of the point.
    pub(crate) fn slope_rounding(&self, steps: u32) -> f64 {
        let steps = f64::from(steps);
        let weight = if steps < self.gain[1] { steps + 1.0 } else { self.gain[1] + 1.0 };
        let [_, patch] = self.patch;
        let scale = self.steepest() + patch;
        1.01 * (weight * (self.noise[1] + self.bend * 2.0 * self.shift)
            + UNIT
                * (2.0 * (steps + 2.0) * scale
                    + (4.0 + 16.0 * self.stretch) * weight * (weight * patch + scale)))
    }
}
