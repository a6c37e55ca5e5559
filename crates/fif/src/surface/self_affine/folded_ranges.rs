//! Rigorous bounds of a folded surface over rectangles.

use asperity_core::Interval;

use crate::numeric::polynomial::UNIT;
use crate::surface::bounds::SurfaceBounds;
use crate::surface::extrema::ceiling;
use crate::surface::self_affine::self_affine::{FoldParts, Part, SelfAffine};
use crate::surface::self_affine::zig_zag::{Strip, ZigZag, slope_rounding, steepest, value_rounding};

/// Maximum number of steps in which bounds follow a rectangle.
const MOST_STEPS: u32 = 64;

/// Rounding of a step in units of the domain.
pub(crate) const STEP: f64 = 16.0 * UNIT;

/// Enclosures over a rectangle, slopes in units of the domain.
struct Followed {
    height: Interval,
    slopes: [Interval; 2],
}

impl SelfAffine<ZigZag> {
    /// See [`SelfAffine::bounds`].
    pub(crate) fn bounds_over(&self, x: Interval, y: Interval) -> SurfaceBounds {
        let limits = &self.limits;
        let whole = SurfaceBounds { height: limits.range, slopes: self.slope_range() };
        let (Some((low, _)), Some((high, _))) = (self.fold.locate(x.lo, y.lo), self.fold.locate(x.hi, y.hi))
        else {
            return whole;
        };
        let at = [0, 1].map(|k| Interval::new(low[k], high[k]));
        if !(at[0].width() >= 0.0 && at[1].width() >= 0.0) {
            return whole;
        }
        let Some(followed) = self.followed(at, Part::Data) else { return whole };
        let height = followed.height.intersection(limits.range);
        let slopes = self.per_domain([0, 1].map(|k| followed.slopes[k].intersection(limits.slopes[k])));
        let zero = Interval::new(0.0, 0.0);
        // On the path from the center, slopes outside the domain are 0 and heights are those of the
        // border.
        let clamped = [x, y].into_iter().zip(self.fold.domain).map(|(x, side)| x.intersection(side));
        let mut around = self.evaluate(x.middle(), y.middle(), 0.0).interval();
        for ((range, clamped), slope) in [x, y].into_iter().zip(clamped).zip(slopes) {
            let middle = range.middle();
            let reach = (range.hi - middle).max(middle - range.lo).next_up();
            let slope = if clamped == range { slope } else { slope.hull(zero) };
            around = around.sum(slope.product(Interval::new(-reach, reach)));
        }
        SurfaceBounds { height: height.intersection(around), slopes }
    }

    /// Narrower global ranges, by branch and bound over the domain.
    pub(crate) fn narrow(&mut self) {
        const PASSES: u32 = 8;
        let unit = [Interval::new(0.0, 1.0); 2];
        let cells = self.fold.cells[0].max(self.fold.cells[1]).next_power_of_two().trailing_zeros();
        for pass in 1..=PASSES {
            let depth = cells + pass.min(5);
            self.limits.own_slopes = [0, 1].map(|k| {
                let most = self.limits.own_slopes[k].magnitude();
                let upper = |at| self.followed(at, Part::Own).map_or(most, |own| own.slopes[k].magnitude());
                let least = ceiling(unit, depth, upper).min(most);
                Interval::new(-least, least)
            });
        }
        let depth = cells + 4;
        self.limits.own = self.sides(Part::Own, depth, self.limits.own, |own| own.height);
        let slopes =
            [0, 1].map(|k| self.sides(Part::Data, depth, self.limits.slopes[k], |data| data.slopes[k]));
        let range = self.sides(Part::Data, depth, self.limits.range, |data| data.height);
        (self.limits.slopes, self.limits.range) = (slopes, range);
        self.limits.steepest = steepest(&self.limits);
    }

    /// The range of a part over small squares, within its known range.
    fn sides(&self, part: Part, depth: u32, most: Interval, of: impl Fn(&Followed) -> Interval) -> Interval {
        let unit = [Interval::new(0.0, 1.0); 2];
        let high = |at| self.followed(at, part).map_or(most.hi, |followed| of(&followed).hi);
        let low = |at| -self.followed(at, part).map_or(most.lo, |followed| of(&followed).lo);
        Interval::new(-ceiling(unit, depth, low), ceiling(unit, depth, high)).intersection(most)
    }

    /// Enclosures over a rectangle, in units of the domain, of f or of w.
    ///
    /// `None` if it overlaps too many cells for one step.
    fn followed(&self, mut at: [Interval; 2], first: Part) -> Option<Followed> {
        let limits = &self.limits;
        let zero = Interval::new(0.0, 0.0);
        let (mut height, mut sum, mut weight) = (Interval::ENTIRE, zero, 1.0_f64);
        let (mut slopes, mut jacobian, mut part) = ([zero; 2], [Interval::new(1.0, 1.0); 2], first);
        let mut steps = 0;
        while steps < MOST_STEPS {
            let padded = [0, 1].map(|k| self.padded(at[k]));
            let ends = [0, 1].map(|k| [self.fold.strip(k, padded[k].lo), self.fold.strip(k, padded[k].hi)]);
            let all = at.iter().all(|side| side.width() >= 1.0);
            if (all && steps > 0) || ends.iter().any(|[low, high]| high.index - low.index > 1) {
                break;
            }
            let ranges = self.patch_ranges(ends, part);
            sum = sum.sum(ranges[0].scaled(weight));
            slopes = [0, 1].map(|k| slopes[k].sum(jacobian[k].product(ranges[k + 1])));
            for (k, [low, high]) in ends.into_iter().enumerate() {
                let turned =
                    Interval::new(low.slope(), low.slope()).hull(Interval::new(high.slope(), high.slope()));
                jacobian[k] = jacobian[k].product(turned.scaled(self.factor));
                at[k] = pieces([low, high]).map(image).fold(Interval::EMPTY, Interval::hull);
            }
            weight *= self.factor;
            steps += 1;
            part = Part::Own;
            let rest = limits.own.scaled(weight);
            height = height.intersection(sum.sum(rest).inflated(value_rounding(limits, steps)));
        }
        let margin = slope_rounding(limits, steps);
        let slopes =
            [0, 1].map(|k| slopes[k].sum(jacobian[k].product(limits.own_slopes[k])).inflated(margin));
        (steps > 0).then_some(Followed { height, slopes })
    }

    /// A position with the rounding of a step.
    fn padded(&self, at: Interval) -> Interval {
        let pad = STEP + self.limits.shift;
        Interval::new((at.lo - pad).max(0.0), (at.hi + pad).min(1.0))
    }

    /// Ranges of a function and its slopes over a rectangle within two cells along each axis.
    fn patch_ranges(&self, [x, y]: [[Strip; 2]; 2], part: Part) -> [Interval; 3] {
        let mut all = [Interval::EMPTY; 3];
        for (across, u) in pieces(x) {
            for (along, v) in pieces(y) {
                let [value, by_x, by_y] = self.fold.patch([across, along], part).ranges(u, v);
                let here = [value, by_x.scaled(1.0 / across.width), by_y.scaled(1.0 / along.width)];
                all = [0, 1, 2].map(|k| all[k].hull(here[k]));
            }
        }
        // Reciprocals and widths are rounded, by far less than the noise of a slope.
        [
            all[0].inflated(self.limits.noise[0]),
            all[1].inflated(self.limits.noise[1]),
            all[2].inflated(self.limits.noise[1]),
        ]
    }
}

/// The parts of an interval in its one or two cells, and the position of each.
pub(crate) fn pieces([low, high]: [Strip; 2]) -> impl Iterator<Item = (Strip, [f64; 2])> {
    let one = low.index == high.index;
    let first = (low, [low.u, if one { high.u } else { 1.0 }]);
    [Some(first), (!one).then_some((high, [0.0, high.u]))].into_iter().flatten()
}

/// Image of a part of a cell under Φ.
pub(crate) fn image((strip, [low, high]): (Strip, [f64; 2])) -> Interval {
    let at = |u: f64| Strip { u, ..strip }.folded();
    let (a, b) = (at(low), at(high));
    if a < b { Interval::new(a, b) } else { Interval::new(b, a) }
}
