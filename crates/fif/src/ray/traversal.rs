//! The first hit of a ray on any surface `z = f(x, y)`, and a proof that it is the first.
//!
//! A [`Context`] contains the constants of a surface, and a [`Traversal`] the state of one ray. The
//! search finds roots of `r(t)`, the height of the ray above the surface at the distance t:
//!
//! 1. [`Context::ray`] clips the ray to the domain.
//! 2. [`Traversal::descend`] visits the squares of a quadtree over the domain front to back. The
//!    range of the heights over a square clips the ray: outside this interval it is above or below
//!    the surface.
//! 3. [`Traversal::search`] decides an interval over a smallest square. Bounds of the slopes bound
//!    the rate `r′`, so r at an end of the interval excludes roots for some distance. If the rate
//!    keeps its sign, r at both ends decides; otherwise the rest of the interval is halved and
//!    bounded again.
//! 4. [`Traversal::root`] encloses a root between a change of sign, by secants and the bounds of
//!    the rate.
//! 5. [`Traversal::hit`] evaluates height and gradient there.
//!
//! Height fields `f(x) g(y)` have specialized steps 2 and 3: by products of cells
//! ([`boxes`](crate::ray::boxes)) or of tables ([`tables`](crate::ray::tables)).

use asperity_core::Interval;
use glam::DVec3;

use crate::numeric::estimate::Bounded;
use crate::numeric::polynomial::UNIT;
use crate::ray::ray::{Aim, Hit, Ray, Root};
use crate::surface::bounds::{Surface, SurfaceBounds, upward_normal};

/// Maximum number of evaluations, or boxes, of one ray; beyond, a hit is not certain.
const BUDGET: u32 = 1 << 16;

/// Length of an interval, relative to the domain, at whose ends a change of sign is a root.
const CLOSE: f64 = 1e-12;

/// Maximum number of pending intervals; every split halves one.
const WAITING: usize = 64;

/// Splits after which the slopes are bounded again.
const SPLITS: u32 = 8;

/// Length of the shortest interval over a rough surface, relative to the shortest over a smooth
/// one.
const ROUGH_PART: f64 = 1.0 / 64.0;

/// Maximum number of evaluations of a search for a single root.
const EVALUATIONS: u32 = 100;

/// Evaluations to which bounds are equivalent.
const BOUNDS: u32 = 2;

/// The constants of a surface, common to all rays.
pub(crate) struct Context<'a, S: ?Sized> {
    pub(crate) surface: &'a S,
    domain: [Interval; 2],
    range: Interval,
}

/// State of one ray.
pub(crate) struct Traversal<'a, S: ?Sized> {
    pub(crate) context: &'a Context<'a, S>,
    pub(crate) ray: Ray,
    /// More than the rounding of a coordinate on the ray within the domain.
    pub(crate) pad: DVec3,
    /// Length of an interval at whose ends a change of sign is a root, and of an interval that is
    /// not split further.
    pub(crate) close: f64,
    pub(crate) finest: f64,
    /// Whether a root is requested to the rounding error.
    exact: bool,
    /// Remaining evaluations or boxes.
    pub(crate) budget: u32,
    /// Distance at which a limit first left undecided whether the ray hits the surface.
    lost: Option<f64>,
}

impl<'a, S: Surface + ?Sized> Context<'a, S> {
    pub(crate) fn new(surface: &'a S) -> Self {
        Self { surface, domain: surface.domain(), range: surface.range() }
    }

    /// The ray with its part over the domain, which may be empty; `None` for an invalid ray.
    pub(crate) fn ray(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<(Traversal<'_, S>, Interval)> {
        let (o, d) = (ray.origin, ray.direction);
        if !o.is_finite() || !d.is_finite() || d == DVec3::ZERO {
            return None;
        }
        let [x, y] = self.domain;
        let pad = |origin: f64, extent: f64| 16.0 * f64::EPSILON * (origin.abs() + extent);
        let pad =
            DVec3::new(pad(o.x, x.magnitude()), pad(o.y, y.magnitude()), pad(o.z, self.range.magnitude()));
        let longest = d.x.abs().max(d.y.abs()).max(d.z.abs());
        let finest = CLOSE * x.width().max(y.width());
        let exact = tolerance <= finest || tolerance.is_nan();
        // The length of the direction is less than √3 times its longest component.
        let finest = finest / longest;
        let close = if exact { finest } else { 0.5 * tolerance / longest };
        let span = Interval::new(if t.lo > 0.0 { t.lo } else { 0.0 }, t.hi);
        let span = span.intersection(slab(o.x, d.x, padded(x, pad.x)));
        let span = span.intersection(slab(o.y, d.y, padded(y, pad.y)));
        let ray = *ray;
        Some((Traversal { context: self, ray, pad, close, finest, exact, budget: BUDGET, lost: None }, span))
    }

    /// The first hit with `t` in the interval.
    pub(crate) fn first(
        &self,
        squares: &impl Squares,
        ray: &Ray,
        t: Interval,
        tolerance: f64,
    ) -> Option<Hit> {
        let (mut traversal, span) = self.ray(ray, t, tolerance)?;
        let root = traversal.meets(squares, span, Aim::First)?;
        traversal.hit(root, tolerance)
    }

    /// Whether the ray hits the surface with `t` in the interval.
    pub(crate) fn any(&self, squares: &impl Squares, ray: &Ray, t: Interval) -> bool {
        let Some((mut traversal, span)) = self.ray(ray, t, 0.0) else { return false };
        let root = traversal.meets(squares, span, Aim::Any);
        root.is_some_and(|Root { t, .. }| t.is_finite() && ray.at(t).is_finite())
    }
}

/// A square of the quadtree: the domain halved `level` times along both axes.
#[derive(Clone, Copy)]
pub(crate) struct Square {
    pub(crate) level: u32,
    pub(crate) at: [u32; 2],
}

impl Square {
    const WHOLE: Self = Self { level: 0, at: [0; 2] };

    /// Its side along an axis.
    #[inline]
    pub(crate) fn side(self, axis: usize, domain: Interval) -> Interval {
        let step = domain.width() / f64::from(1_u32 << self.level);
        let index = f64::from(if axis == 0 { self.at[0] } else { self.at[1] });
        Interval::new(domain.lo + step * index, domain.lo + step * (index + 1.0))
    }

    #[inline]
    fn quarter(self, right: u32, far: u32) -> Self {
        Self { level: self.level + 1, at: [2 * self.at[0] + right, 2 * self.at[1] + far] }
    }
}

/// Bounds over the squares of the quadtree.
pub(crate) trait Squares {
    /// The level of the smallest squares.
    fn finest(&self) -> u32;

    /// Bounds over a square, whose sides are `x` and `y`.
    fn heights(&self, square: Square, x: Interval, y: Interval) -> Interval;

    /// Bounds of heights and slopes over a smallest square.
    fn leaf(&self, square: Square, x: Interval, y: Interval) -> SurfaceBounds;
}

/// A surface without a table: bounds are computed on request.
pub(crate) struct Unbounded<'a, S: ?Sized>(pub(crate) &'a S);

impl<S: Surface + ?Sized> Squares for Unbounded<'_, S> {
    fn finest(&self) -> u32 {
        5
    }

    fn heights(&self, square: Square, x: Interval, y: Interval) -> Interval {
        if square.level < 2 { self.0.range() } else { self.0.bounds(x, y).height }
    }

    fn leaf(&self, _: Square, x: Interval, y: Interval) -> SurfaceBounds {
        self.0.bounds(x, y)
    }
}

impl<S: Surface + ?Sized> Traversal<'_, S> {
    fn meets(&mut self, squares: &impl Squares, span: Interval, aim: Aim) -> Option<Root> {
        if self.is_vertical() {
            return self.vertical(span);
        }
        let found = self.descend(squares, span, aim);
        // A point left undecided just before a root may be as close to it as rounding may move
        // another root.
        let near = |t: f64| self.lost.is_none_or(|lost| t - lost <= self.finest);
        let found = found.map(|root| Root { certain: root.certain && near(root.t), ..root });
        found.or(self.lost.map(|t| Root { t, certain: false }))
    }

    /// The first root in the squares along the ray, or any; the nearest square is on top of the
    /// stack.
    fn descend(&mut self, squares: &impl Squares, span: Interval, aim: Aim) -> Option<Root> {
        const PLACES: usize = 64;
        let [x, y] = self.context.domain;
        let finest = squares.finest().min(12);
        let (o, d) = (self.ray.origin, self.ray.direction);
        let inverse = [1.0 / d.x, 1.0 / d.y];
        // More than the rounding of a coordinate, as a distance.
        let pad_t = [self.pad.x * inverse[0].abs(), self.pad.y * inverse[1].abs()];
        let mut stack = [(Square::WHOLE, span); PLACES];
        let mut filled = 1_usize;
        let mut segments = Segments::new();
        while filled > 0 {
            filled -= 1;
            let Some(&(square, span)) = stack.get(filled) else { break };
            let sides = [square.side(0, x), square.side(1, y)];
            let around = [padded(sides[0], self.pad.x), padded(sides[1], self.pad.y)];
            if square.level >= finest {
                let SurfaceBounds { height, slopes } = squares.leaf(square, around[0], around[1]);
                let span = self.within(span, height);
                if span.lo <= span.hi
                    && let Some(root) = self.search(&mut segments, span, self.rate(slopes), aim)
                {
                    return Some(root);
                }
                continue;
            }
            let span = self.within(span, squares.heights(square, around[0], around[1]));
            if span.lo.is_nan() || span.hi.is_nan() || span.lo > span.hi {
                continue;
            }
            // The interval before and behind the middle of either side, for any direction of the
            // ray.
            let halves = |axis: usize| {
                let (origin, step) = if axis == 0 { (o.x, d.x) } else { (o.y, d.y) };
                let (side, pad, inverse, pad_t) = if axis == 0 {
                    (sides[0], self.pad.x, inverse[0], pad_t[0])
                } else {
                    (sides[1], self.pad.y, inverse[1], pad_t[1])
                };
                let middle = side.middle();
                let backward = u32::from(step < 0.0);
                if step == 0.0 {
                    let at = |near: bool| if near { span } else { Interval::EMPTY };
                    return [(0, at(origin <= middle + pad)), (1, at(origin >= middle - pad))];
                }
                let t = (middle - origin) * inverse;
                let slack = pad_t + 4.0 * f64::EPSILON * t.abs();
                [
                    (backward, span.intersection(Interval::new(span.lo, t + slack))),
                    (1 - backward, span.intersection(Interval::new(t - slack, span.hi))),
                ]
            };
            let (across, along) = (halves(0), halves(1));
            let quarter = |i: usize, j: usize| {
                let ((right, s), (far, t)) = (across[i & 1], along[j & 1]);
                (square.quarter(right, far), s.intersection(t))
            };
            let (mut second, mut third) = (quarter(0, 1), quarter(1, 0));
            if third.1.lo < second.1.lo {
                (second, third) = (third, second);
            }
            for part in [quarter(1, 1), third, second, quarter(0, 0)] {
                if part.1.lo <= part.1.hi
                    && let Some(place) = stack.get_mut(filled)
                {
                    *place = part;
                    filled += 1;
                }
            }
        }
        None
    }

    /// The first root in an interval over which the rate is in `rate`, or any.
    fn search(&mut self, waiting: &mut Segments, span: Interval, rate: Interval, aim: Aim) -> Option<Root> {
        waiting.filled = 0;
        // More than the rounding of t.
        let slack = 4.0 * UNIT * (span.lo.abs() + span.hi.abs());
        waiting.push(Segment { span, rate, clearance: [0.0; 2], splits: 0 });
        while let Some(segment) = waiting.pop() {
            let Segment { span: Interval { lo, hi }, rate, clearance, .. } = segment;
            let (width, speed) = (hi - lo, rate.magnitude());
            let rough = !speed.is_finite();
            if rough && aim == Aim::First && width > self.close && self.budget > 0 {
                // Heights at the ends exclude nothing in between; bounds of the parts do.
                self.split(waiting, segment);
                continue;
            }
            let coarse = if rough { self.context.range.width() } else { 0.0625 * speed * width };
            // If the sign at an end is unknown, that end is the root, up to rounding.
            let low = if clearance[0] == 0.0 { self.clearance(lo, coarse) } else { clearance[0] };
            if low == 0.0 {
                return Some(self.proven(lo));
            }
            let high = if clearance[1] == 0.0 { self.clearance(hi, coarse) } else { clearance[1] };
            let crosses = (low < 0.0) != (high < 0.0) && high != 0.0;
            if crosses && aim == Aim::Any {
                return Some(Root { t: lo, certain: true });
            }
            // r is monotonic: one root or none.
            if rate.lo > 0.0 || rate.hi < 0.0 {
                if crosses {
                    return Some(Root { t: self.root(segment.span, rate, low, slack), certain: true });
                }
                if high == 0.0 {
                    return Some(self.proven(hi));
                }
                continue;
            }
            if crosses && (width <= self.close || self.budget == 0) {
                let certain = width <= self.close;
                return Some(Root { t: self.root(segment.span, Interval::ENTIRE, low, slack), certain });
            }
            // A Lipschitz bound from either end leaves [from, to]: |r| decreases at most at these
            // rates.
            let (fall, rise) = if low > 0.0 { (-rate.lo, rate.hi) } else { (rate.hi, -rate.lo) };
            let from = lo + low.abs() / fall - slack;
            let from = if from > lo { from } else { lo };
            let to = if crosses || high == 0.0 { hi } else { hi - high.abs() / rise + slack };
            let to = if to < hi { to } else { hi };
            if from > to {
                continue;
            }
            let finest = if rough { ROUGH_PART * self.finest } else { self.finest };
            if width <= finest || self.budget == 0 {
                // There may be no way to decide whether the ray dips in and out again.
                if self.lost.is_none() && self.bounded(segment).is_some() {
                    self.lost = Some(lo);
                }
                continue;
            }
            let rest = segment.cut(Interval::new(from, to), [low, high]);
            if to - from <= 0.5 * width {
                waiting.push(rest);
            } else {
                self.split(waiting, rest);
            }
        }
        None
    }

    /// Both halves, with new bounds once they are much smaller than the domain of the old ones.
    fn split(&mut self, waiting: &mut Segments, segment: Segment) {
        let Segment { span, rate, clearance, splits } = segment;
        let (middle, splits) = (span.middle(), splits + 1);
        let again = !rate.magnitude().is_finite() || splits.is_multiple_of(SPLITS);
        for (span, clearance) in [
            (Interval::new(middle, span.hi), [0.0, clearance[1]]),
            (Interval::new(span.lo, middle), [clearance[0], 0.0]),
        ] {
            let part = Segment { span, rate, clearance, splits };
            if let Some(part) = if again { self.bounded(part) } else { Some(part) } {
                waiting.push(part);
            }
        }
    }

    /// The interval with bounds over its own rectangle; `None` if the ray is above or below all of
    /// it.
    fn bounded(&mut self, segment: Segment) -> Option<Segment> {
        self.budget = self.budget.saturating_sub(BOUNDS);
        let (a, b) = (self.ray.at(segment.span.lo), self.ray.at(segment.span.hi));
        let side = |a: f64, b: f64, pad: f64| {
            if a < b { Interval::new(a - pad, b + pad) } else { Interval::new(b - pad, a + pad) }
        };
        let SurfaceBounds { height, slopes } =
            self.context.surface.bounds(side(a.x, b.x, self.pad.x), side(a.y, b.y, self.pad.y));
        let span = self.within(segment.span, height);
        let rate = self.rate(slopes).intersection(segment.rate);
        (span.lo <= span.hi).then_some(Segment { rate, ..segment.cut(span, segment.clearance) })
    }

    /// A lower bound of |r|, with the sign of r; 0 only if the sign is unknown.
    fn clearance(&mut self, t: f64, mut tolerance: f64) -> f64 {
        const FINER: f64 = 1.0 / 4096.0;
        loop {
            let Bounded { value, bound } = self.above(t, tolerance);
            self.budget = self.budget.saturating_sub(1);
            if value.abs() > bound {
                return if value < 0.0 { value + bound } else { value - bound };
            }
            if tolerance <= 0.0 || tolerance.is_nan() || value.is_nan() {
                return 0.0;
            }
            tolerance = if bound < 0.5 * tolerance { 0.0 } else { tolerance * FINER };
        }
    }

    /// A root in an interval with different signs of r at its ends; the only one, if the rate
    /// excludes 0.
    fn root(&mut self, span: Interval, rate: Interval, low: f64, slack: f64) -> f64 {
        let sign = if low < 0.0 { 1.0 } else { -1.0 };
        // r times the sign increases over the interval.
        let rate = rate.scaled(sign);
        let (pace, most) = (rate.lo.max(0.0), rate.hi);
        let (mut lo, mut hi) = (span.lo, span.hi);
        let mut t = span.middle();
        let mut last: Option<(f64, f64)> = None;
        for step in 0..EVALUATIONS {
            let width = hi - lo;
            let enough = if self.exact { slack } else { self.close };
            if width <= enough || t <= lo || t >= hi {
                break;
            }
            let wanted = 0.03125 * pace * width;
            let Bounded { value, bound } = self.above(t, wanted);
            self.budget = self.budget.saturating_sub(1);
            let (value, at) = (sign * value, t);
            if value.abs() <= bound && wanted <= 2.0 * bound {
                return t;
            }
            // Interval Newton: the root lies between `before` and `after`, far at the minimum rate,
            // near at the maximum.
            let (below, over) = (value - bound, value + bound);
            let quick = |v: f64| if most.is_finite() { v / most } else { 0.0 };
            let slow = |v: f64| if pace > 0.0 { v / pace } else { v * f64::INFINITY };
            let before = at - if over > 0.0 { slow(over) } else { quick(over) } - slack;
            let after = at - if below < 0.0 { slow(below) } else { quick(below) } + slack;
            lo = if before > lo { before } else { lo };
            hi = if after < hi { after } else { hi };
            // A secant through the last two points, or the middle.
            let secant = match last {
                Some((s, v)) if v != value => at - value * ((at - s) / (value - v)),
                _ => f64::NAN,
            };
            last = Some((at, value));
            let inside = lo < secant && secant < hi && step % 4 != 3;
            t = if inside { secant } else { 0.5 * lo + 0.5 * hi };
        }
        let t = if lo < t && t < hi { t } else { 0.5 * lo + 0.5 * hi };
        span.nearest(t)
    }

    /// `r(t)`: the height of the ray above the surface.
    #[inline]
    fn above(&self, t: f64, tolerance: f64) -> Bounded {
        self.over(t, |x, y| self.context.surface.evaluate(x, y, tolerance))
    }

    /// The height of the ray at `t` above heights.
    #[inline]
    pub(crate) fn over(&self, t: f64, height: impl Fn(f64, f64) -> Bounded) -> Bounded {
        let at = self.ray.at(t);
        let h = height(at.x, at.y);
        let rounding = f64::EPSILON * (self.ray.origin.z.abs() + at.z.abs());
        Bounded { value: at.z - h.value, bound: h.bound + rounding }
    }

    /// The interval in which the ray is in the height range of the surface.
    #[inline]
    pub(crate) fn within(&self, span: Interval, height: Interval) -> Interval {
        span.intersection(slab(self.ray.origin.z, self.ray.direction.z, padded(height, self.pad.z)))
    }

    /// Range of `r′ = d_z − f_x d_x − f_y d_y` for these ranges of the slopes.
    pub(crate) fn rate(&self, [x, y]: [Interval; 2]) -> Interval {
        let d = self.ray.direction;
        Interval::new(d.z, d.z).sum(x.scaled(-d.x)).sum(y.scaled(-d.y))
    }

    /// Whether the ray is parallel to z, so that it hits the surface at one height.
    pub(crate) fn is_vertical(&self) -> bool {
        self.ray.direction.x == 0.0 && self.ray.direction.y == 0.0
    }

    /// The distance at which a ray parallel to z hits the surface.
    pub(crate) fn vertical(&self, span: Interval) -> Option<Root> {
        if span.lo > span.hi {
            return None;
        }
        let above = self.above(0.0, 0.0);
        let t = -above.value / self.ray.direction.z;
        let slack = above.bound / self.ray.direction.z.abs();
        let near = span.lo - slack <= t && t <= span.hi + slack;
        let certain = span.lo + slack <= t && t <= span.hi - slack;
        near.then(|| Root { t: span.nearest(t), certain })
    }

    /// The root, certain if the signs nearby prove it.
    pub(crate) fn proven(&self, t: f64) -> Root {
        // Where rounding hides the sign for longer than the shortest interval, farther.
        const NEARBY: [f64; 6] = [1e-3, 1e-2, 1e-1, 1.0, 4.0, 16.0];
        let apart = |near: f64| {
            let [a, b] = [t - near, t + near].map(|t| self.above(t, 0.0));
            a.value.abs() > a.bound && b.value.abs() > b.bound && (a.value < 0.0) != (b.value < 0.0)
        };
        Root { t, certain: NEARBY.iter().any(|part| apart(part * self.finest)) }
    }

    /// The hit at `t`, to the tolerance; `None` if t or the distance to the surface overflows.
    pub(crate) fn hit(&self, Root { t, certain }: Root, tolerance: f64) -> Option<Hit> {
        let at = self.ray.at(t);
        if !t.is_finite() || !at.is_finite() {
            return None;
        }
        let [x, y] = self.context.domain;
        let certain = certain && x.contains(at.x) && y.contains(at.y);
        let (x, y) = (x.nearest(at.x), y.nearest(at.y));
        let (near, height) = if self.exact { (0.0, 0.0) } else { (tolerance, 0.125 * tolerance) };
        let gradient = self.context.surface.gradient_near(x, y, near);
        let height = self.context.surface.evaluate(x, y, height).value;
        Some(Hit { t, x, y, height, gradient, normal: gradient.map(upward_normal), certain })
    }
}

/// An interval of the ray, bounds of the rate over it, and bounds of r at its ends.
#[derive(Clone, Copy)]
struct Segment {
    span: Interval,
    rate: Interval,
    /// Lower bounds of |r| at the ends, with its sign; 0 where nothing is known.
    clearance: [f64; 2],
    splits: u32,
}

impl Segment {
    /// A part of the interval, with the bounds at the ends that it keeps.
    fn cut(self, span: Interval, [low, high]: [f64; 2]) -> Self {
        let kept = |end: f64, old: f64, clearance: f64| if end == old { clearance } else { 0.0 };
        Self {
            span,
            clearance: [kept(span.lo, self.span.lo, low), kept(span.hi, self.span.hi, high)],
            ..self
        }
    }
}

/// Intervals left to search, the nearest last.
struct Segments {
    waiting: [Segment; WAITING],
    filled: usize,
}

impl Segments {
    fn new() -> Self {
        let none = Segment { span: Interval::EMPTY, rate: Interval::ENTIRE, clearance: [0.0; 2], splits: 0 };
        Self { waiting: [none; WAITING], filled: 0 }
    }

    fn push(&mut self, segment: Segment) {
        if let Some(place) = self.waiting.get_mut(self.filled) {
            *place = segment;
            self.filled += 1;
        }
    }

    fn pop(&mut self) -> Option<Segment> {
        self.filled = self.filled.checked_sub(1)?;
        self.waiting.get(self.filled).copied()
    }
}

fn padded(side: Interval, pad: f64) -> Interval {
    Interval::new(side.lo - pad, side.hi + pad)
}

/// The interval of `t` with `origin + t direction` in `side`; everything or nothing for a parallel
/// ray.
#[inline]
fn slab(origin: f64, direction: f64, side: Interval) -> Interval {
    if direction == 0.0 {
        return if side.contains(origin) { Interval::ENTIRE } else { Interval::EMPTY };
    }
    let (a, b) = ((side.lo - origin) / direction, (side.hi - origin) / direction);
    if a < b { Interval::new(a, b) } else { Interval::new(b, a) }
}
