//! Rigorous bounds of a torus surface over rectangles, and its means.

use asperity_core::Interval;
use asperity_core::math::sqrt_f64;

use crate::numeric::estimate::Bounded;
use crate::numeric::matrix2::{IDENTITY, added, product, transposed};
use crate::numeric::polynomial::UNIT;
use crate::surface::bounds::SurfaceBounds;
use crate::surface::extrema::ceiling;
use crate::surface::self_affine::address::Address;
use crate::surface::self_affine::self_affine::{MOST_STEPS, SelfAffine};
use crate::surface::self_affine::torus_fold::{TorusFold, slope_rounding, value_rounding};

/// Enclosures over a rectangle, and one of the mean height over it.
pub(crate) struct BoundsAndMean {
    pub(crate) bounds: SurfaceBounds,
    pub(crate) mean: Interval,
}

/// `Σ_{k<K} J_kᵀ ∇p∘Mᵏ` over a small rectangle, and K.
struct PartialSlopes {
    slopes: [Interval; 2],
    steps: u32,
}

impl SelfAffine<TorusFold> {
    /// [`SelfAffine::bounds`] and an enclosure of the mean height.
    ///
    /// The linear part around the center contributes nothing to the mean.
    pub(crate) fn bounds_and_mean(&self, x: Interval, y: Interval) -> BoundsAndMean {
        let limits = &self.limits;
        let whole = SurfaceBounds { height: limits.range, slopes: limits.slopes };
        let whole = BoundsAndMean { bounds: whole, mean: limits.range };
        let half = [half_width(x), half_width(y)];
        let Some((mut at, cut)) = Address::of(x.middle(), y.middle()) else { return whole };
        if !(half[0] >= 0.0 && half[1] >= 0.0 && half[0] + half[1] < 4.0) {
            return whole;
        }
        let center = at;
        let cells = self.side() as f64;
        let by = self.fold.scaled;
        let mut extent = half.map(|half| (half + cut) * cells);
        let mut radius = sqrt_f64(extent[0] * extent[0] + extent[1] * extent[1]) * (1.0 + 4.0 * UNIT);
        let (mut sum, mut slopes) = (Interval::new(0.0, 0.0), [Interval::new(0.0, 0.0); 2]);
        let (mut weight, mut jacobian, mut steps) = (1.0_f64, IDENTITY, 0);
        // The first K terms at the center, their gradient, and the rest over the rectangle.
        let (mut value, mut gradient, mut bent) = (0.0, [0.0_f64; 2], 0.0);
        let (mut height, mut mean, reach) = (limits.range, limits.range, half.map(|half| half + cut));
        while extent[0].max(extent[1]) <= 0.5 && steps < MOST_STEPS {
            let [range, along_x, along_y] = self.patch_ranges(at, extent);
            let (cell, [u, v]) = at.cell(self.fold.bits);
            let patch = self.fold.patch(cell);
            let slope = patch.slopes(u, v);
            let far = |range: Interval, at: f64| (range.hi - at).max(at - range.lo);
            bent += weight.abs() * (far(along_x, slope[0]) * extent[0] + far(along_y, slope[1]) * extent[1]);
            value += weight * patch.value(u, v);
            let term = transposed(&jacobian, slope.map(|slope| slope * cells));
            gradient = [gradient[0] + term[0], gradient[1] + term[1]];
            sum = sum.sum(range.scaled(weight));
            slopes = added(slopes, &jacobian, [along_x.scaled(cells), along_y.scaled(cells)]);
            weight *= self.factor;
            jacobian = product(&by, &jacobian);
            radius *= limits.stretch * (1.0 + 2.0 * UNIT);
            extent = [radius; 2];
            at = at.moved(&self.fold.matrix);
            steps += 1;
            let rest = limits.range.scaled(weight);
            let error = value_rounding(limits, steps);
            height = height.intersection(sum.sum(rest).inflated(error));
            let turn = gradient[0].abs() * reach[0] + gradient[1].abs() * reach[1] + bent;
            // The center is the center of the rectangle up to half a unit in the last place, which
            // `half` contains.
            let error = error
                + turn * 1e-14
                + slope_rounding(limits, steps, 2.0 * limits.steepest) * (reach[0] + reach[1]);
            let center = Interval::new(value, value).sum(rest);
            height = height.intersection(center.inflated(turn + error));
            mean = mean.intersection(center.inflated(bent + error));
        }
        if steps == 0 {
            return whole;
        }
        let rest = limits.contraction_of(steps) * limits.steepest;
        let round = added(slopes, &IDENTITY, [Interval::new(-rest, rest); 2]);
        slopes = added(slopes, &jacobian, limits.slopes);
        slopes = [0, 1].map(|k| {
            let margin = slope_rounding(limits, steps, 2.0 * limits.steepest);
            slopes[k].intersection(round[k]).inflated(margin)
        });
        slopes = [0, 1].map(|k| slopes[k].intersection(limits.slopes[k]));
        let term = |k: usize| slopes[k].product(Interval::new(-reach[k], reach[k]));
        let around = self.value_from(center, 0.0).interval();
        height = height.intersection(around.sum(term(0)).sum(term(1)));
        BoundsAndMean { bounds: SurfaceBounds { height, slopes }, mean: mean.intersection(height) }
    }

    /// Narrower global ranges, by branch and bound over one period.
    pub(crate) fn narrow(&mut self) {
        let period = [Interval::new(0.0, 1.0); 2];
        for finer in 1..=7 {
            let depth = self.fold.bits + finer.min(5);
            let steepest = ceiling(period, depth, |[x, y]| {
                let PartialSlopes { slopes: [u, v], steps } = self.partial_slopes(x, y);
                let (u, v) = (u.magnitude(), v.magnitude());
                let margin = slope_rounding(&self.limits, steps, 2.0 * self.limits.steepest);
                let rest = self.limits.contraction_of(steps) * self.limits.steepest;
                (sqrt_f64(u * u + v * v) + rest + 2.0 * margin) * (1.0 + 8.0 * UNIT)
            });
            if steepest < self.limits.steepest {
                self.limits.steepest = steepest;
            }
            let most = Interval::new(-self.limits.steepest, self.limits.steepest);
            self.limits.slopes = self.limits.slopes.map(|range| range.intersection(most));
        }
        let depth = self.fold.bits + 4;
        let sides = |of: &dyn Fn(SurfaceBounds) -> Interval| {
            let high = ceiling(period, depth, |[x, y]| of(self.bounds(x, y)).hi);
            Interval::new(-ceiling(period, depth, |[x, y]| -of(self.bounds(x, y)).lo), high)
        };
        let slopes = [0, 1].map(|k| sides(&|bounds| bounds.slopes[k]));
        let range = sides(&|bounds| bounds.height);
        self.limits.slopes = [0, 1].map(|k| self.limits.slopes[k].intersection(slopes[k]));
        self.limits.range = self.limits.range.intersection(range);
        (self.limits.own, self.limits.own_slopes) = (self.limits.range, self.limits.slopes);
    }

    fn partial_slopes(&self, x: Interval, y: Interval) -> PartialSlopes {
        let mut slopes = [Interval::new(0.0, 0.0); 2];
        let Some((mut at, cut)) = Address::of(x.middle(), y.middle()) else {
            return PartialSlopes { slopes, steps: 0 };
        };
        let (cells, by) = (self.side() as f64, self.fold.scaled);
        let mut extent = [x, y].map(|range| (half_width(range) + cut) * cells);
        let mut radius = sqrt_f64(extent[0] * extent[0] + extent[1] * extent[1]) * (1.0 + 4.0 * UNIT);
        let (mut jacobian, mut steps) = (IDENTITY, 0);
        while extent[0].max(extent[1]) <= 0.5 && steps < MOST_STEPS {
            let [_, along_x, along_y] = self.patch_ranges(at, extent);
            slopes = added(slopes, &jacobian, [along_x.scaled(cells), along_y.scaled(cells)]);
            jacobian = product(&by, &jacobian);
            radius *= self.limits.stretch * (1.0 + 2.0 * UNIT);
            extent = [radius; 2];
            at = at.moved(&self.fold.matrix);
            steps += 1;
        }
        PartialSlopes { slopes, steps }
    }

    /// The mean height over `x × y` by its bounds over `cells`² equal parts.
    ///
    /// ```text
    /// mean f ∈ S_K(c) ± Σ_{k<K} |s|ᵏ |∇p(Mᵏ Q) − ∇p(Mᵏ c)| |Mᵏ (Q − c)| + sᴷ f   over a part Q around c
    /// ```
    ///
    /// The bound decreases like `cells^(−ln |s|/ln ‖M‖)`: four times as many cells gain a factor of
    /// four to five for |s| = 3/8 and ‖M‖ = √5. Over whole periods [`SelfAffine::mean`] is exact.
    /// NaN for a rectangle that is empty or not finite.
    pub fn mean_over(&self, x: Interval, y: Interval, cells: u32) -> Bounded {
        let cells = cells.max(1);
        let step = [x, y].map(|range| range.width() / f64::from(cells));
        if !(step[0] >= 0.0 && step[1] >= 0.0 && x.lo.is_finite() && y.lo.is_finite()) {
            return Bounded::NAN;
        }
        let part = |range: Interval, step: f64, k: u32| {
            let at = |k: u32| if k == cells { range.hi } else { range.lo + f64::from(k) * step };
            Interval::new(at(k), at(k + 1))
        };
        let (mut sum, mut bound) = (0.0, 0.0);
        for i in 0..cells {
            let along = part(x, step[0], i);
            for j in 0..cells {
                let across = part(y, step[1], j);
                let mean = self.bounds_and_mean(along, across).mean;
                sum += mean.middle();
                bound += 0.5 * mean.width();
            }
        }
        let count = f64::from(cells) * f64::from(cells);
        let limits = &self.limits;
        // Sums of up to `count` heights; parts of unequal size and positions by the rounding of
        // their ends.
        let ends = 4.0 * f64::EPSILON * (x.magnitude() + y.magnitude()) * limits.steepest;
        let rounding = UNIT * (count + 16.0) * limits.range.magnitude();
        Bounded { value: sum / count, bound: 1.001 * (bound / count + ends + rounding) }
    }

    /// Ranges of p and its slopes per cell over the box of half widths `extent`, at most half a
    /// cell, around a point.
    fn patch_ranges(&self, at: Address, extent: [f64; 2]) -> [Interval; 3] {
        let ([i, j], place) = at.cell(self.fold.bits);
        let reach = |k: usize| {
            let pad = extent[k] * (1.0 + 4.0 * UNIT) + 4.0 * UNIT;
            [place[k] - pad, place[k] + pad]
        };
        let mut all = [Interval::EMPTY; 3];
        for (di, u) in pieces(reach(0)) {
            for (dj, v) in pieces(reach(1)) {
                let cell = [i.wrapping_add_signed(di), j.wrapping_add_signed(dj)];
                let ranges = self.fold.patch(cell).ranges(u, v);
                all = [0, 1, 2].map(|k| all[k].hull(ranges[k]));
            }
        }
        [all[0].inflated(self.limits.noise[0]), all[1], all[2]]
    }
}

/// Half the width, rounded up so that it covers the rounding of the center.
fn half_width(range: Interval) -> f64 {
    let middle = range.middle();
    (range.hi - middle).max(middle - range.lo).next_up()
}

/// The parts of `[lo, hi]` in the cell and its neighbors: the cell, and the position in it.
fn pieces([lo, hi]: [f64; 2]) -> impl Iterator<Item = (isize, [f64; 2])> {
    let own = (0, [lo.max(0.0), hi.min(1.0)]);
    let before = (-1, [(1.0 + lo).max(0.0), 1.0]);
    let after = (1, [0.0, (hi - 1.0).min(1.0)]);
    let parts = [Some(own), (lo < 0.0).then_some(before), (hi > 1.0).then_some(after)];
    parts.into_iter().flatten()
}
