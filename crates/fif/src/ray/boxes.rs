//! Ordered descent of a ray through the boxes of a height field: products of cells of both axes.

use asperity_core::Interval;

use crate::numeric::double::Double;
use crate::numeric::estimate::Bounded;
use crate::ray::ray::{Aim, Root};
use crate::ray::traversal::Traversal;
use crate::surface::height_field::curve::{Below, Cell, Curve};
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;

/// More than the rounding of the times at which a ray is at the ends of cells, relative to them: 192 sums of 105 bits each.
const THIN: f64 = 4.0 * FINEST;

/// Boxes visited at most behind a place where the ray touches the surface.
const FURTHER: u32 = 1 << 10;

/// Boxes that decide at most whether rough stretches hide a pair of roots: of a ray along an axis, and of any other.
const DEEPER: [u32; 2] = [1 << 14, 1 << 13];

/// The like where any hit does, certain or not.
const DEEPER_FOR_ANY: u32 = 1 << 7;

/// Parts of a rough stretch of 10⁻¹² of the domain at whose ends heights are looked at, to this part of their ranges.
const PROBES: u32 = 16;
const PART: f64 = 1.0 / 32.0;

/// Stretches behind a place that is left open in which heights are looked at, the farthest ending 10⁻¹² of the domain from
/// it, each half as long, and the heights in each.
const LOST: u32 = 24;
const PLACES: u32 = 16;

/// Boxes visited at most behind such a place.
const BEHIND: u32 = 1 << 12;

/// Boxes, each within the last, by which a place of the surface beyond the ray is looked for.
const DIVE: u32 = 48;

/// Levels after which heights are looked at again.
const EVERY: u32 = 4;

/// Side of the surface on which the ray is, as far as it is known.
struct Sight {
    /// `±1` where it was known last, 0 at the beginning.
    side: f64,
    /// Distance at which the ray came so near that rounding hides the side.
    touched: Option<f64>,
    /// Distance at which a limit left undecided whether it passes through.
    lost: Option<f64>,
    /// Distance at which cells were too narrow to be told apart, and the box over them was not decided.
    narrow: Option<f64>,
    /// The way from there within which a change of sides is a root.
    close: f64,
    found: Option<Root>,
}

impl Sight {
    /// From `t` on the ray is on this side for some way: whether that ends the search.
    fn known(&mut self, side: f64, t: f64) -> bool {
        let near = self.touched.unwrap_or(t);
        if self.side * side < 0.0 {
            let certain = self.lost.is_none_or(|lost| t - lost <= self.close);
            // Behind a place where it touches, the end of a long stretch tells the side.
            let t = if t - near > self.close { near } else { 0.5 * near + 0.5 * t };
            self.found = Some(Root { t, certain });
        } else if t - near > self.close {
            self.found = Some(Root { t: near, certain: false });
        }
        self.side = side;
        self.found.is_some()
    }
}

/// A descent on its way.
struct Descent<'a, 'b, F: Function, G: Function> {
    way: &'b mut Traversal<'a, HeightField<F, G>>,
    x: &'b Axis<'a, F>,
    y: &'b Axis<'a, G>,
    /// Whether slopes are unknown.
    rough: bool,
    sight: Sight,
    /// Height of a box that rounding leaves undecided.
    flat: f64,
    /// More than what rounding does to a height in the middle of a stretch.
    blur: f64,
    /// Length of a stretch that rounding may have put into a cell beside its own.
    thin: f64,
    /// Length of a stretch below which cells may have the same time at both ends.
    narrow: f64,
    /// Boxes left for rough stretches, the end of those that were probed, and the place that was looked at last.
    deeper: u32,
    probed: f64,
    seen: Double,
    /// End of the ray's stretch over the domain.
    end: Double,
    aim: Aim,
}

impl<F: Function, G: Function> Traversal<'_, HeightField<F, G>> {
    /// The least root along a stretch of the ray, or any.
    pub(crate) fn boxes(&mut self, span: Interval, aim: Aim) -> Option<Root> {
        let (surface, o, d) = (self.context.surface, self.ray.origin, self.ray.direction);
        let across = Axis::new(&surface.x, [o.x, d.x], d.y);
        let along = Axis::new(&surface.y, [o.y, d.y], d.x);
        let (x, y) = (across.root(), along.root());
        let (mut lo, mut hi) = (Double::from(span.lo), Double::from(span.hi));
        let mut flat = 2.0 * self.pad.z;
        // Rounding at the border counts as the ray's where the surface is smooth.
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
        let sight =
            Sight { side: 0.0, touched: None, lost: None, narrow: None, close: self.finest, found: None };
        let slanted = d.x != 0.0 && d.y != 0.0;
        // Along an axis every cell is gone through from end to end.
        let narrow = THIN * (span.lo.abs() + span.hi.abs());
        let thin = if slanted { narrow } else { -1.0 };
        let deeper = if aim == Aim::Any { DEEPER_FOR_ANY } else { DEEPER[usize::from(slanted)] };
        let seen = Double::from(f64::NAN);
        let mut descent = Descent {
            way: self,
            x: &across,
            y: &along,
            rough,
            sight,
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
        let Sight { touched, lost, narrow, found, .. } = descent.sight;
        found.or(touched.or(lost).or(narrow).map(|t| Root { t, certain: false }))
    }

    /// The height of the ray above the surface at `t`.
    fn height(&self, t: f64) -> Bounded {
        self.over(t, |x, y| self.context.surface.near(x, y))
    }
}

impl<F: Function, G: Function> Descent<'_, '_, F, G> {
    /// Whether the search ends within the box over two cells and a stretch of the ray.
    fn visit(&mut self, x: &Level<F>, y: &Level<G>, [mut lo, mut hi]: [Double; 2]) -> bool {
        let (mut height, span) = (x.value.product(y.value), Interval::new(lo.hi, hi.hi));
        let inside = lo <= hi && span.lo < f64::INFINITY;
        if !inside {
            return false;
        }
        if self.rough && hi.minus(lo).hi <= self.thin {
            // The ray may be in a neighbouring cell all along.
            height = height.inflated(self.blur);
        }
        let (ray, pad) = (self.way.ray, self.way.pad.z);
        let [z, end] = [span.lo, span.hi].map(|t| ray.origin.z + t * ray.direction.z);
        let (above, below) = (height.hi + pad, height.lo - pad);
        if (z > above && end > above) || (z < below && end < below) {
            return self.sight.known(if z > above { 1.0 } else { -1.0 }, span.lo);
        }
        if below <= z && z <= above && below <= end && end <= above {
            return self.enter(x, y, [lo, hi], height);
        }
        let cut = self.way.within(span, height);
        let middle = height.middle();
        let side = |t: f64| if ray.origin.z + t * ray.direction.z < middle { -1.0 } else { 1.0 };
        if cut.lo > cut.hi {
            return self.sight.known(side(span.lo), span.lo);
        }
        if cut.lo > span.lo {
            if self.sight.known(side(span.lo), span.lo) {
                return true;
            }
            lo = Double::from(cut.lo);
        }
        if cut.hi < span.hi {
            hi = Double::from(cut.hi);
        }
        self.enter(x, y, [lo, hi], height) || (cut.hi < span.hi && self.sight.known(side(span.hi), cut.hi))
    }

    /// [`Descent::visit`] where the ray is as high as the box.
    fn enter(&mut self, x: &Level<F>, y: &Level<G>, [lo, hi]: [Double; 2], height: Interval) -> bool {
        let span = Interval::new(lo.hi, hi.hi);
        let (mut slopes, mut rate) = ([Interval::ENTIRE; 2], Interval::ENTIRE);
        if !self.rough {
            slopes = [x.slope.product(y.value), x.value.product(y.slope)];
            rate = self.way.rate(slopes);
        }
        if rate.lo > 0.0 || rate.hi < 0.0 {
            return self.crossing(span, rate, slopes);
        }
        self.way.budget = self.way.budget.saturating_sub(1);
        let (x_ends, y_ends) = (self.x.ends(x), self.y.ends(y));
        if rate.magnitude() < f64::INFINITY {
            if (x_ends && y_ends) || span.width() <= self.way.close {
                return self.crossing(span, rate, slopes);
            }
        } else {
            if height.width() <= self.flat {
                return self.touch(span.lo);
            }
            let (ends, short) = (x_ends && y_ends, span.width() <= self.way.close);
            if short {
                self.deeper = self.deeper.saturating_sub(1);
                let now = (x.depth + y.depth).is_multiple_of(EVERY) || ends || span.lo >= self.probed;
                if now && (self.dive(x, y, [lo, hi]) || self.probe([lo, hi], [x.value, y.value])) {
                    return true;
                }
            }
            let far = self.sight.lost.is_some_and(|lost| span.lo - lost > self.sight.close);
            if ends || (short && (self.deeper == 0 || far)) {
                return self.lose(lo);
            }
            // Of children without a length the last one alone is visited.
            if hi.minus(lo).hi <= self.narrow && self.sight.narrow.is_none() {
                self.sight.narrow = Some(lo.hi);
            }
        }
        if self.way.budget == 0 {
            return self.give_up(span);
        }
        let (across, along) = (self.x, self.y);
        if y_ends || (!x_ends && x.size >= y.size) {
            across.children(x, [lo, hi]).any(|(part, span)| self.visit(&part(), y, span))
        } else {
            along.children(y, [lo, hi]).any(|(part, span)| self.visit(x, &part(), span))
        }
    }

    /// Looks at the heights at both ends of a short stretch over a rough surface, and in between where that is new: a root is
    /// found sooner than all that lies before it is cleared. Whether that ends the search.
    fn probe(&mut self, [lo, hi]: [Double; 2], values: [Interval; 2]) -> bool {
        let parts = if lo.hi < self.probed { 1 } else { PROBES };
        self.probed = self.probed.max(hi.hi);
        let step = hi.minus(lo).scaled(1.0 / f64::from(parts));
        let tolerances = values.map(|value| PART * value.width());
        let at = |k: u32| if k == parts { hi } else { lo.plus(step.times(Double::from(f64::from(k)))) };
        [0, parts].into_iter().chain(1..parts).any(|k| self.looked(at(k), tolerances))
    }

    /// Follows the child that reaches farthest beyond the ray, level by level, and looks at the height there: whether that
    /// ends the search.
    fn dive(&mut self, x: &Level<F>, y: &Level<G>, mut span: [Double; 2]) -> bool {
        let (side, ray) = (self.sight.side, self.way.ray);
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

    /// Looks at the height at `t` over a rough surface: whether that ends the search.
    fn looked(&mut self, t: Double, [x, y]: [f64; 2]) -> bool {
        if t == self.seen || t > self.end {
            return false;
        }
        let (ray, surface, blur) = (self.way.ray, self.way.context.surface, self.blur);
        let at = |o: f64, d: f64| Double::from(o).plus(t.times(Double::from(d)));
        let f = surface.x.at(at(ray.origin.x, ray.direction.x), x);
        let height = f.product(surface.y.at(at(ray.origin.y, ray.direction.y), y));
        let above = ray.origin.z + t.hi * ray.direction.z - height.value;
        if above.abs() <= height.bound + blur {
            return false;
        }
        self.seen = t;
        self.sight.known(above.signum(), t.hi)
    }

    /// From `t` on a limit hides the side, unless a height nearby tells that there is a root: whether that ends the search.
    fn lose(&mut self, t: Double) -> bool {
        if self.sight.lost.is_some() {
            return false;
        }
        self.sight.lost = Some(t.hi);
        if self.aim == Aim::Any {
            return true;
        }
        self.deeper = self.deeper.min(BEHIND);
        // Past a root a rough surface is now on one side of the ray, now on the other.
        (0..LOST).any(|k| {
            let far = self.sight.close / f64::from(1_u32 << k);
            (0..PLACES).any(|i| {
                let near = far * (1.0 - f64::from(i) / f64::from(2 * PLACES));
                self.looked(t.plus(Double::from(near)), [0.0; 2])
            })
        })
    }

    /// From `t` on rounding hides the side; false, as the search goes on.
    fn touch(&mut self, t: f64) -> bool {
        if self.sight.touched.is_none() {
            (self.sight.touched, self.way.budget) = (Some(t), self.way.budget.min(FURTHER));
        }
        false
    }

    /// A change of sign as the best guess at the end of the budget; true.
    fn give_up(&mut self, span: Interval) -> bool {
        let [a, b] = [span.lo, span.hi].map(|t| self.way.height(t).value);
        let t = match self.sight.touched {
            Some(t) => t,
            None if (a < 0.0) != (b < 0.0) => self.root(span, [a, b]),
            None => span.lo,
        };
        self.sight.found = Some(Root { t, certain: false });
        true
    }

    /// By the heights at both ends of a stretch with bounded rates.
    fn crossing(&mut self, span: Interval, rate: Interval, slopes: [Interval; 2]) -> bool {
        let (pad, d) = (self.way.pad, self.way.ray.direction);
        let moved = |slope: Interval, pad: f64, d: f64| if d == 0.0 { 0.0 } else { slope.magnitude() * pad };
        let blur = moved(slopes[0], pad.x, d.x) + moved(slopes[1], pad.y, d.y);
        let [first, last] = [span.lo, span.hi].map(|t| self.way.height(t));
        // What is left of a height when its error is taken off.
        let clear = |above: Bounded| {
            let rest = above.value.abs() - above.bound - blur;
            if rest > 0.0 { rest.copysign(above.value) } else { 0.0 }
        };
        let (low, high) = (clear(first), clear(last));
        if low == 0.0 {
            self.touch(span.lo);
        } else if self.sight.known(low.signum(), span.lo) {
            return true;
        }
        if low * high < 0.0 {
            let t = self.root(span, [first.value, last.value]);
            self.sight.found = Some(Root { t, certain: self.sight.lost.is_none() });
            return true;
        }
        let apart = low.abs() + high.abs() > rate.magnitude() * span.width();
        if low * high > 0.0 && rate.contains(0.0) && !apart {
            self.touch(span.lo);
        }
        if high == 0.0 { self.touch(span.hi) } else { self.sight.known(high.signum(), span.hi) }
    }

    /// A root in `span`, at whose ends the signs differ.
    fn root(&self, span: Interval, [mut v0, mut v1]: [f64; 2]) -> f64 {
        const STEPS: usize = 80;
        let (mut t0, mut t1) = (span.lo, span.hi);
        // Illinois: a secant whose older end counts half when it stays, with a bisection now and then.
        let mut stayed = 0_i32;
        for step in 0..STEPS {
            let secant = t1 - v1 * ((t1 - t0) / (v1 - v0));
            let middle = 0.5 * t0 + 0.5 * t1;
            let t = if step % 8 == 7 || !(t0 < secant && secant < t1) { middle } else { secant };
            if t <= t0 || t >= t1 {
                break;
            }
            let above = self.way.height(t);
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

/// The child with the maximum of `reach` of its values and of the time, with this maximum and the child's stretch of the ray.
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

/// Cells of one axis that a box is split into, one within the other, at most.
const LEVELS: u32 = 192;

/// Width of the cells, in parts of the domain, down to which a ray's place is known: 2⁻⁹⁶.
const FINEST: f64 = f64::EPSILON * f64::EPSILON / 256.0;

/// A curve under a ray: how its places become times.
struct Axis<'a, F: Function> {
    curve: &'a Curve<F>,
    origin: f64,
    direction: f64,
    /// Whether places are kept as times at which the ray is there; else, where these overflow, as themselves.
    timed: bool,
    /// Share of a child in its cell, where all have the same.
    share: Option<Double>,
    /// Width of the cells that are not split any more; none for a ray along the axis, whose cells need no place of their own.
    finest: f64,
}

/// A cell of one axis: where it lies and what bounds the function there.
#[derive(Clone)]
struct Level<F: Function> {
    cell: Cell<Below<F>>,
    /// The left end and the width, as places or as times; the latter also as a length, rounded.
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
        Self { curve, origin, direction, timed: farthest < 0.125 * f64::MAX, share: even, finest }
    }

    /// The domain, or the one place that the ray keeps to.
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

    /// Whether a cell is not split any more.
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

    /// Knot `j` of a cell, whose children have the width `part`, where all have the same.
    #[inline]
    fn knot(&self, level: &Level<F>, part: Double, j: usize) -> Double {
        match (self.share, j) {
            (_, 0) => level.left,
            (Some(_), 1) => level.left.plus(part),
            (Some(_), _) => level.left.plus(part.times(Double::from(j as f64))),
            (None, _) => level.left.plus(level.width.times(self.curve.function().knot(j))),
        }
    }

    /// The children that a stretch of the ray goes through, in its order, each made when it is asked for, and the part
    /// of the stretch over each.
    #[inline]
    fn children<'b>(
        &'b self,
        level: &'b Level<F>,
        [mut lo, hi]: [Double; 2],
    ) -> impl Iterator<Item = (impl Fn() -> Level<F> + 'b, [Double; 2])> + 'b {
        let (count, mut done) = (self.curve.count(), false);
        let part = match self.share {
            // Powers of two are exact.
            Some(Double { hi: share, lo: 0.0 }) => level.width.scaled(share),
            Some(share) => level.width.times(share),
            None => level.width,
        };
        (0..count).filter_map(move |k| {
            let (j, far) = if self.direction < 0.0 { (count - 1 - k, count - 1 - k) } else { (k, k + 1) };
            let end = || self.time(self.knot(level, part, far));
            let end = if k + 1 == count { hi } else { end() };
            // A stretch that only ends where the next child begins belongs to that.
            if done || (end <= lo && k + 1 < count) {
                return None;
            }
            let span = [lo, end.min(hi).max(lo)];
            (lo, done) = (span[1], end >= hi);
            let child = move || {
                let left = self.knot(level, part, j);
                let [from, to] = self.curve.part(j);
                let width =
                    if self.share.is_some() { part } else { self.knot(level, part, j + 1).minus(left) };
                let cell = self.curve.child(&level.cell, j);
                self.level(cell, [left, width], level.size * (to - from), level.depth + 1)
            };
            Some((child, span))
        })
    }
}
