//! Ordered descent of a ray through the boxes of a height field: products of cells of both axes.

use asperity_core::Interval;

use crate::numeric::double::Double;
use crate::numeric::estimate::Bounded;
use crate::ray::ray::{Aim, Root};
use crate::ray::traversal::Traversal;
use crate::surface::height_field::curve::{Below, Cell, Curve};
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;

/// More than the relative rounding of the times at the ends of cells: 192 sums of 105 bits each.
const THIN: f64 = 4.0 * FINEST;

/// Maximum number of boxes visited behind a point where the ray touches the surface.
const FURTHER: u32 = 1 << 10;

/// Maximum number of boxes that decide whether rough intervals hide a pair of roots.
///
/// For a ray along an axis, and for any other ray.
const DEEPER: [u32; 2] = [1 << 14, 1 << 13];

/// The same if any hit suffices, certain or not.
const DEEPER_FOR_ANY: u32 = 1 << 7;

/// Subdivisions of a rough interval of 10⁻¹² of the domain at whose ends heights are tested,
/// relative to their ranges.
const PROBES: u32 = 16;
const PART: f64 = 1.0 / 32.0;

/// Intervals behind an undecided point in which heights are tested, and the number of heights in
/// each.
///
/// The farthest ends 10⁻¹² of the domain from the point, and each is half as long as the next.
const LOST: u32 = 24;
const PLACES: u32 = 16;

/// Maximum number of boxes visited behind an undecided point.
const BEHIND: u32 = 1 << 12;

/// Maximum depth of nested boxes in the search for a point of the surface beyond the ray.
const DIVE: u32 = 48;

/// Levels after which heights are tested again.
const EVERY: u32 = 4;

/// The side of the surface on which the ray is, as far as known.
struct SideState {
    /// `±1` at the last known position, 0 at the beginning.
    side: f64,
    /// Distance at which the ray came so close that rounding hides the side.
    touched: Option<f64>,
    /// Distance at which a limit left undecided whether it passes through.
    lost: Option<f64>,
    /// Distance at which cells were too narrow to be distinguished, and the box over them was
    /// undecided.
    narrow: Option<f64>,
    /// The distance from there within which a change of sides is a root.
    close: f64,
    found: Option<Root>,
}

impl SideState {
    /// From `t` on the ray is on this side for some distance; returns whether this ends the search.
    fn known(&mut self, side: f64, t: f64) -> bool {
        let near = self.touched.unwrap_or(t);
        if self.side * side < 0.0 {
            let certain = self.lost.is_none_or(|lost| t - lost <= self.close);
            // Behind a touching point, the end of a long interval determines the side.
            let t = if t - near > self.close { near } else { 0.5 * near + 0.5 * t };
            self.found = Some(Root { t, certain });
        } else if t - near > self.close {
            self.found = Some(Root { t: near, certain: false });
        }
        self.side = side;
        self.found.is_some()
    }
}

/// State of a descent.
struct Descent<'a, 'b, F: Function, G: Function> {
    traversal: &'b mut Traversal<'a, HeightField<F, G>>,
    x: &'b Axis<'a, F>,
    y: &'b Axis<'a, G>,
    /// Whether slopes are unknown.
    rough: bool,
    state: SideState,
    /// Height of a box that rounding leaves undecided.
    flat: f64,
    /// More than the rounding of a height in the middle of an interval.
    blur: f64,
    /// Length of an interval that rounding may have moved to a neighboring cell.
    thin: f64,
    /// Length of an interval below which cells may have equal times at both ends.
    narrow: f64,
    /// Remaining boxes for rough intervals, the end of the probed intervals, and the last tested
    /// position.
    deeper: u32,
    probed: f64,
    seen: Double,
    /// End of the part of the ray over the domain.
    end: Double,
    aim: Aim,
}

impl<F: Function, G: Function> Traversal<'_, HeightField<F, G>> {
    /// The first root along a part of the ray, or any.
    pub(crate) fn boxes(&mut self, span: Interval, aim: Aim) -> Option<Root> {
        let (surface, o, d) = (self.context.surface, self.ray.origin, self.ray.direction);
        let across = Axis::new(&surface.x, [o.x, d.x], d.y);
        let along = Axis::new(&surface.y, [o.y, d.y], d.x);
        let (x, y) = (across.root(), along.root());
        let (mut lo, mut hi) = (Double::from(span.lo), Double::from(span.hi));
        let mut flat = 2.0 * self.pad.z;
        // Rounding at the border is attributed to the ray if the surface is smooth.
        let rough = surface.x.derivative().is_none() || surface.y.derivative().is_none();
        for (ends, direction, value, other) in [
            ([across.time(x.left), across.time(x.left.plus(x.width))], d.x, x.value, surface.y.range()),
            ([along.time(y.left), along.time(y.left.plus(y.width))], d.y, y.value, surface.x.range()),
        ] {
            if direction == 0.0 {
                flat += 2.0 * value.width() * other.magnitude();
            } else if rough {
                let [a, b] = ends;
                (lo, hi) = (lo.max(a.min(b)), hi.min(a.max(b)));
            }
        }
        let [f, g] = [surface.x.range(), surface.y.range()].map(Interval::magnitude);
        let near = |domain: Interval, origin: f64| FINEST * (domain.magnitude() + origin.abs());
        let (off_x, off_y) = (near(surface.x.domain(), o.x), near(surface.y.domain(), o.y));
        let moved = || surface.x.function().blur(off_x) * g + surface.y.function().blur(off_y) * f;
        let blur = self.pad.z + if rough { 1.0001 * moved() } else { 0.0 };
        let state =
            SideState { side: 0.0, touched: None, lost: None, narrow: None, close: self.finest, found: None };
        let slanted = d.x != 0.0 && d.y != 0.0;
        // Along an axis every cell is crossed from end to end.
        let narrow = THIN * (span.lo.abs() + span.hi.abs());
        let thin = if slanted { narrow } else { -1.0 };
        let deeper = if aim == Aim::Any { DEEPER_FOR_ANY } else { DEEPER[usize::from(slanted)] };
        let seen = Double::from(f64::NAN);
        let mut descent = Descent {
            traversal: self,
            x: &across,
            y: &along,
            rough,
            state,
            flat,
            blur,
            thin,
            narrow,
            deeper,
            probed: f64::NEG_INFINITY,
            seen,
            end: hi,
            aim,
        };
        descent.visit(&x, &y, [lo, hi]);
        let SideState { touched, lost, narrow, found, .. } = descent.state;
        found.or(touched.or(lost).or(narrow).map(|t| Root { t, certain: false }))
    }

    /// The height of the ray above the surface at `t`.
    fn height(&self, t: f64) -> Bounded {
        self.over(t, |x, y| self.context.surface.near(x, y))
    }
}

impl<F: Function, G: Function> Descent<'_, '_, F, G> {
    /// Returns whether the search ends within the box over two cells and an interval of the ray.
    fn visit(&mut self, x: &Level<F>, y: &Level<G>, [mut lo, mut hi]: [Double; 2]) -> bool {
        let (mut height, span) = (x.value.product(y.value), Interval::new(lo.hi, hi.hi));
        let inside = lo <= hi && span.lo < f64::INFINITY;
        if !inside {
            return false;
        }
        if self.rough && hi.minus(lo).hi <= self.thin {
            // The ray may be in a neighboring cell all along.
            height = height.inflated(self.blur);
        }
        let (ray, pad) = (self.traversal.ray, self.traversal.pad.z);
        let [z, end] = [span.lo, span.hi].map(|t| ray.origin.z + t * ray.direction.z);
        let (above, below) = (height.hi + pad, height.lo - pad);
        if (z > above && end > above) || (z < below && end < below) {
            return self.state.known(if z > above { 1.0 } else { -1.0 }, span.lo);
        }
        if below <= z && z <= above && below <= end && end <= above {
            return self.enter(x, y, [lo, hi], height);
        }
        let cut = self.traversal.within(span, height);
        let middle = height.middle();
        let side = |t: f64| if ray.origin.z + t * ray.direction.z < middle { -1.0 } else { 1.0 };
        if cut.lo > cut.hi {
            return self.state.known(side(span.lo), span.lo);
        }
        if cut.lo > span.lo {
            if self.state.known(side(span.lo), span.lo) {
                return true;
            }
            lo = Double::from(cut.lo);
        }
        if cut.hi < span.hi {
            hi = Double::from(cut.hi);
        }
        self.enter(x, y, [lo, hi], height) || (cut.hi < span.hi && self.state.known(side(span.hi), cut.hi))
    }

    /// [`Descent::visit`] if the ray is at the height of the box.
    fn enter(&mut self, x: &Level<F>, y: &Level<G>, [lo, hi]: [Double; 2], height: Interval) -> bool {
        let span = Interval::new(lo.hi, hi.hi);
        let (mut slopes, mut rate) = ([Interval::ENTIRE; 2], Interval::ENTIRE);
        if !self.rough {
            slopes = [x.slope.product(y.value), x.value.product(y.slope)];
            rate = self.traversal.rate(slopes);
        }
        if rate.lo > 0.0 || rate.hi < 0.0 {
            return self.crossing(span, rate, slopes);
        }
        self.traversal.budget = self.traversal.budget.saturating_sub(1);
        let (x_ends, y_ends) = (self.x.ends(x), self.y.ends(y));
        if rate.magnitude() < f64::INFINITY {
            if (x_ends && y_ends) || span.width() <= self.traversal.close {
                return self.crossing(span, rate, slopes);
            }
        } else {
            if height.width() <= self.flat {
                return self.touch(span.lo);
            }
            let (ends, short) = (x_ends && y_ends, span.width() <= self.traversal.close);
            if short {
                self.deeper = self.deeper.saturating_sub(1);
                let now = (x.depth + y.depth).is_multiple_of(EVERY) || ends || span.lo >= self.probed;
                if now && (self.dive(x, y, [lo, hi]) || self.probe([lo, hi], [x.value, y.value])) {
                    return true;
                }
            }
            let far = self.state.lost.is_some_and(|lost| span.lo - lost > self.state.close);
            if ends || (short && (self.deeper == 0 || far)) {
                return self.lose(lo);
            }
            // Of children without a length only the last one is visited.
            if hi.minus(lo).hi <= self.narrow && self.state.narrow.is_none() {
                self.state.narrow = Some(lo.hi);
            }
        }
        if self.traversal.budget == 0 {
            return self.give_up(span);
        }
        let (across, along) = (self.x, self.y);
        if y_ends || (!x_ends && x.size >= y.size) {
            across.children(x, [lo, hi]).any(|(part, span)| self.visit(&part(), y, span))
        } else {
            along.children(y, [lo, hi]).any(|(part, span)| self.visit(x, &part(), span))
        }
    }

    /// Tests the heights at both ends of a short interval over a rough surface, and in between if
    /// not yet tested.
    ///
    /// This finds a root before everything in front of it is excluded. Returns whether the search
    /// ends.
    fn probe(&mut self, [lo, hi]: [Double; 2], values: [Interval; 2]) -> bool {
        let parts = if lo.hi < self.probed { 1 } else { PROBES };
        self.probed = self.probed.max(hi.hi);
        let step = hi.minus(lo).scaled(1.0 / f64::from(parts));
        let tolerances = values.map(|value| PART * value.width());
        let at = |k: u32| if k == parts { hi } else { lo.plus(step.times(Double::from(f64::from(k)))) };
        [0, parts].into_iter().chain(1..parts).any(|k| self.looked(at(k), tolerances))
    }

    /// Follows the child that extends farthest beyond the ray, level by level, and tests the height
    /// there.
    ///
    /// Returns whether the search ends.
    fn dive(&mut self, x: &Level<F>, y: &Level<G>, mut span: [Double; 2]) -> bool {
        let (side, ray) = (self.state.side, self.traversal.ray);
        if side == 0.0 {
            return false;
        }
        let reach = |x: Interval, y: Interval, t: Double| {
            let (height, z) = (x.product(y), ray.origin.z + t.hi * ray.direction.z);
            if side > 0.0 { height.hi - z } else { z - height.lo }
        };
        let (mut x, mut y) = (x.clone(), y.clone());
        for _ in 0..DIVE {
            let (x_ends, y_ends) = (self.x.ends(&x), self.y.ends(&y));
            if (x_ends && y_ends) || span[1].minus(span[0]).hi <= self.thin {
                break;
            }
            let beyond = if y_ends || (!x_ends && x.size >= y.size) {
                let next = farthest(self.x, &x, span, |value, t| reach(value, y.value, t));
                next.map(|(far, part, stretch)| {
                    (x, span) = (part, stretch);
                    far
                })
            } else {
                let next = farthest(self.y, &y, span, |value, t| reach(x.value, value, t));
                next.map(|(far, part, stretch)| {
                    (y, span) = (part, stretch);
                    far
                })
            };
            if beyond.is_none_or(|far| far <= 0.0) {
                return false;
            }
        }
        self.looked(span[0].plus(span[1]).scaled(0.5), [0.0; 2])
    }

    /// Tests the height at `t` over a rough surface; returns whether the search ends.
    fn looked(&mut self, t: Double, [x, y]: [f64; 2]) -> bool {
        if t == self.seen || t > self.end {
            return false;
        }
        let (ray, surface, blur) = (self.traversal.ray, self.traversal.context.surface, self.blur);
        let at = |o: f64, d: f64| Double::from(o).plus(t.times(Double::from(d)));
        let f = surface.x.at(at(ray.origin.x, ray.direction.x), x);
        let height = f.product(surface.y.at(at(ray.origin.y, ray.direction.y), y));
        let above = ray.origin.z + t.hi * ray.direction.z - height.value;
        if above.abs() <= height.bound + blur {
            return false;
        }
        self.seen = t;
        self.state.known(above.signum(), t.hi)
    }

    /// From `t` on a limit hides the side, unless a height nearby implies a root; returns whether
    /// the search ends.
    fn lose(&mut self, t: Double) -> bool {
        if self.state.lost.is_some() {
            return false;
        }
        self.state.lost = Some(t.hi);
        if self.aim == Aim::Any {
            return true;
        }
        self.deeper = self.deeper.min(BEHIND);
        // Past a root a rough surface alternates between both sides of the ray.
        (0..LOST).any(|k| {
            let far = self.state.close / f64::from(1_u32 << k);
            (0..PLACES).any(|i| {
                let near = far * (1.0 - f64::from(i) / f64::from(2 * PLACES));
                self.looked(t.plus(Double::from(near)), [0.0; 2])
            })
        })
    }

    /// From `t` on rounding hides the side; returns false, as the search continues.
    fn touch(&mut self, t: f64) -> bool {
        if self.state.touched.is_none() {
            (self.state.touched, self.traversal.budget) = (Some(t), self.traversal.budget.min(FURTHER));
        }
        false
    }

    /// Returns a change of sign as the best guess at the end of the budget; always true.
    fn give_up(&mut self, span: Interval) -> bool {
        let [a, b] = [span.lo, span.hi].map(|t| self.traversal.height(t).value);
        let t = match self.state.touched {
            Some(t) => t,
            None if (a < 0.0) != (b < 0.0) => self.root(span, [a, b]),
            None => span.lo,
        };
        self.state.found = Some(Root { t, certain: false });
        true
    }

    /// Decides by the heights at both ends of an interval with bounded rates.
    fn crossing(&mut self, span: Interval, rate: Interval, slopes: [Interval; 2]) -> bool {
        let (pad, d) = (self.traversal.pad, self.traversal.ray.direction);
        let moved = |slope: Interval, pad: f64, d: f64| if d == 0.0 { 0.0 } else { slope.magnitude() * pad };
        let blur = moved(slopes[0], pad.x, d.x) + moved(slopes[1], pad.y, d.y);
        let [first, last] = [span.lo, span.hi].map(|t| self.traversal.height(t));
        // The remainder of a height after subtracting its error.
        let clear = |above: Bounded| {
            let rest = above.value.abs() - above.bound - blur;
            if rest > 0.0 { rest.copysign(above.value) } else { 0.0 }
        };
        let (low, high) = (clear(first), clear(last));
        if low == 0.0 {
            self.touch(span.lo);
        } else if self.state.known(low.signum(), span.lo) {
            return true;
        }
        if low * high < 0.0 {
            let t = self.root(span, [first.value, last.value]);
            self.state.found = Some(Root { t, certain: self.state.lost.is_none() });
            return true;
        }
        let apart = low.abs() + high.abs() > rate.magnitude() * span.width();
        if low * high > 0.0 && rate.contains(0.0) && !apart {
            self.touch(span.lo);
        }
        if high == 0.0 { self.touch(span.hi) } else { self.state.known(high.signum(), span.hi) }
    }

    /// A root in `span`, at whose ends the signs differ.
    fn root(&self, span: Interval, [mut v0, mut v1]: [f64; 2]) -> f64 {
        const STEPS: usize = 80;
        let (mut t0, mut t1) = (span.lo, span.hi);
        // The Illinois method: a secant whose older end counts half if it stays, with occasional
        // bisection.
        let mut stayed = 0_i32;
        for step in 0..STEPS {
            let secant = t1 - v1 * ((t1 - t0) / (v1 - v0));
            let middle = 0.5 * t0 + 0.5 * t1;
            let t = if step % 8 == 7 || !(t0 < secant && secant < t1) { middle } else { secant };
            if t <= t0 || t >= t1 {
                break;
            }
            let above = self.traversal.height(t);
            if above.value.abs() <= above.bound {
                return t;
            }
            if (above.value < 0.0) == (v0 < 0.0) {
                (t0, v0) = (t, above.value);
                v1 *= if stayed > 0 { 0.5 } else { 1.0 };
                stayed = 1;
            } else {
                (t1, v1) = (t, above.value);
                v0 *= if stayed < 0 { 0.5 } else { 1.0 };
                stayed = -1;
            }
        }
        0.5 * t0 + 0.5 * t1
    }
}

/// The child with the maximum of `reach` of its values and time, with this maximum and its
/// interval.
fn farthest<F: Function>(
    axis: &Axis<'_, F>,
    level: &Level<F>,
    span: [Double; 2],
    reach: impl Fn(Interval, Double) -> f64,
) -> Option<(f64, Level<F>, [Double; 2])> {
    let mut best: Option<(f64, Level<F>, [Double; 2])> = None;
    for (part, [lo, hi]) in axis.children(level, span) {
        if lo < hi {
            let part = part();
            let far = reach(part.value, lo);
            if best.as_ref().is_none_or(|(most, ..)| far > *most) {
                best = Some((far, part, [lo, hi]));
            }
        }
    }
    best
}

/// Maximum depth of nested cells of one axis.
const LEVELS: u32 = 192;

/// Relative width of the cells down to which the position of a ray is known: 2⁻⁹⁶.
const FINEST: f64 = f64::EPSILON * f64::EPSILON / 256.0;

/// A curve under a ray: the conversion of its positions to times.
struct Axis<'a, F: Function> {
    curve: &'a Curve<F>,
    origin: f64,
    direction: f64,
    /// Whether positions are stored as times of the ray; otherwise, where these overflow, as
    /// positions.
    timed: bool,
    /// Relative width of a child in its cell, if all are equal.
    ratio: Option<Double>,
    /// Width of the smallest cells, which are not split; none for a ray along the axis, whose cells
    /// need no position.
    finest: f64,
}

/// A cell of one axis: its position and the bounds of the function there.
#[derive(Clone)]
struct Level<F: Function> {
    cell: Cell<Below<F>>,
    /// The left end and the width, as positions or as times; the width also as a length, rounded.
    left: Double,
    width: Double,
    size: f64,
    value: Interval,
    slope: Interval,
    depth: u32,
}

impl<'a, F: Function> Axis<'a, F> {
    fn new(curve: &'a Curve<F>, [origin, direction]: [f64; 2], other: f64) -> Self {
        let count = curve.count();
        let even = curve.function().is_even().then(|| Double::ratio(1.0, count as f64));
        let domain = curve.domain();
        let farthest = (domain.magnitude() + origin.abs()) / direction.abs();
        let finest = if other == 0.0 { 0.0 } else { FINEST * domain.width() };
        Self { curve, origin, direction, timed: farthest < 0.125 * f64::MAX, ratio: even, finest }
    }

    /// The domain, or the single position of a ray along the other axis.
    fn root(&self) -> Level<F> {
        let domain = self.curve.domain();
        let [lo, hi] = [domain.lo, domain.hi].map(Double::from);
        let [mut left, mut width] = [lo, hi.minus(lo)];
        if self.timed {
            (left, width) = (self.time_of(left), width.over(self.direction));
        }
        let root = self.level(self.curve.root(), [left, width], domain.width(), 0);
        if self.direction == 0.0 {
            return Level { value: self.curve.near(self.origin).interval(), depth: LEVELS, ..root };
        }
        root
    }

    /// Whether a cell is not split further.
    #[inline]
    fn ends(&self, level: &Level<F>) -> bool {
        level.depth >= LEVELS || level.size <= self.finest
    }

    #[inline]
    fn level(&self, cell: Cell<Below<F>>, [left, width]: [Double; 2], size: f64, depth: u32) -> Level<F> {
        let [value, slope] = self.curve.bounds(&cell);
        Level { cell, left, width, size, value, slope, depth }
    }

    fn time_of(&self, place: Double) -> Double {
        place.minus(Double::from(self.origin)).over(self.direction)
    }

    #[inline]
    fn time(&self, place: Double) -> Double {
        if self.timed { place } else { self.time_of(place) }
    }

    /// Knot `j` of a cell, whose children have the width `part` if all are equal.
    #[inline]
    fn knot(&self, level: &Level<F>, part: Double, j: usize) -> Double {
        match (self.ratio, j) {
            (_, 0) => level.left,
            (Some(_), 1) => level.left.plus(part),
            (Some(_), _) => level.left.plus(part.times(Double::from(j as f64))),
            (None, _) => level.left.plus(level.width.times(self.curve.function().knot(j))),
        }
    }

    /// The children crossed by an interval of the ray, in its order, and the part of the interval
    /// over each.
    ///
    /// Each child is computed on demand.
    #[inline]
    fn children<'b>(
        &'b self,
        level: &'b Level<F>,
        [mut lo, hi]: [Double; 2],
    ) -> impl Iterator<Item = (impl Fn() -> Level<F> + 'b, [Double; 2])> + 'b {
        let (count, mut done) = (self.curve.count(), false);
        let part = match self.ratio {
            // Powers of two are exact.
            Some(Double { hi: ratio, lo: 0.0 }) => level.width.scaled(ratio),
            Some(ratio) => level.width.times(ratio),
            None => level.width,
        };
        (0..count).filter_map(move |k| {
            let (j, far) = if self.direction < 0.0 { (count - 1 - k, count - 1 - k) } else { (k, k + 1) };
            let end = || self.time(self.knot(level, part, far));
            let end = if k + 1 == count { hi } else { end() };
            // An interval that only ends where the next child begins belongs to the next child.
            if done || (end <= lo && k + 1 < count) {
                return None;
            }
            let span = [lo, end.min(hi).max(lo)];
            (lo, done) = (span[1], end >= hi);
            let child = move || {
                let left = self.knot(level, part, j);
                let [from, to] = self.curve.part(j);
                let width =
                    if self.ratio.is_some() { part } else { self.knot(level, part, j + 1).minus(left) };
                let cell = self.curve.child(&level.cell, j);
                self.level(cell, [left, width], level.size * (to - from), level.depth + 1)
            };
            Some((child, span))
        })
    }
}
