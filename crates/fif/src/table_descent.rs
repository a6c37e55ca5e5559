//! Ordered descent of a ray through the cached top levels of a smooth height field.

use crate::axis::Axis;
use crate::cached::Top;
use crate::descent::{Level, Walk, slab};
use crate::interval::Interval;
use crate::jet_table::Jets;
use crate::polynomial::UNIT;

/// Evaluations that one search for a root makes at most.
const EVALUATIONS: u32 = 80;

/// Where a ray meets the surface, and what was found there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting {
    pub(crate) t: f64,
    /// Value and slope of both axes, when they were evaluated at `t` as well as the tolerance asks.
    pub(crate) jets: Option<[[f64; 2]; 2]>,
}

/// What a descent is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Aim {
    First,
    /// Some hit, as soon as there is one for certain.
    Any,
    /// The first stretch with one root at most.
    Stretch,
}

/// Where a descent stops.
pub(crate) enum Stop {
    Met(Meeting),
    /// A stretch with one root at most.
    At(Search),
}

/// One ray on its way through two tables.
pub(crate) struct TableWalk<'a, X: Axis, Y: Axis> {
    /// The same ray for cells below the tables.
    walk: Walk<'a, X, Y>,
    aim: Aim,
    x: Top<'a, X::Jets>,
    y: Top<'a, Y::Jets>,
    /// `1/d`, infinite for a component that is 0.
    inverse: [f64; 3],
    /// More than the rounding of `t` where the ray crosses a plane of constant x or y.
    late: [f64; 2],
    /// More than the rounding of the rate at which the ray comes nearer.
    rate_pad: f64,
    /// More than what the rounding of the coordinates does to the height.
    blur: f64,
    magnitude: [f64; 2],
    /// Errors of `t` that are allowed.
    reach: f64,
    /// Steps for values to the rounding error.
    finest: usize,
    /// Steps for the slopes of the hit.
    slope_steps: usize,
}

/// A cell of a table and where it lies.
#[derive(Clone, Copy)]
struct Place {
    number: usize,
    left: f64,
    width: f64,
}

impl<'a, X: Axis, Y: Axis> TableWalk<'a, X, Y> {
    /// `None` unless both axes have a table of values, and for rays with components that are zero or extreme.
    pub(crate) fn new(walk: &Walk<'a, X, Y>, tolerance: f64) -> Option<Self> {
        let (x, y) = (walk.surface.x.top()?, walk.surface.y.top()?);
        let inverse = [1.0 / walk.d.x, 1.0 / walk.d.y, 1.0 / walk.d.z];
        let sane = |v: f64| v.abs() < 1e100;
        if !(sane(inverse[0]) && sane(inverse[1]) && sane(walk.d.x) && sane(walk.d.y) && sane(walk.d.z)) {
            return None;
        }
        let ([f, f_slope], [g, g_slope]) = (*x.bounds.first()?, *y.bounds.first()?);
        let falls = [f_slope.magnitude() * g.magnitude(), f.magnitude() * g_slope.magnitude()];
        let speed = walk.d.z.abs() + walk.d.x.abs() * falls[0] + walk.d.y.abs() * falls[1];
        let (wide, deep) = (walk.surface.x.domain().width(), walk.surface.y.domain().width());
        let (a, b) = (x.jets.finest().0, y.jets.finest().0);
        // Over a cell of the tolerance's size, one slope is as good as another.
        let part = if tolerance > 0.0 { tolerance / if wide > deep { wide } else { deep } } else { 0.0 };
        let (p, q) = (x.jets.cells_within(part), y.jets.cells_within(part));
        Some(Self {
            walk: *walk,
            aim: Aim::First,
            late: [walk.pad.x * inverse[0].abs(), walk.pad.y * inverse[1].abs()],
            rate_pad: 16.0 * f64::EPSILON * speed,
            blur: walk.pad.z + falls[0] * walk.pad.x + falls[1] * walk.pad.y,
            magnitude: [f.magnitude(), g.magnitude()],
            reach: if tolerance > 0.0 { tolerance / walk.d.length() } else { 0.0 },
            finest: if a > b { a } else { b },
            slope_steps: if p > q { p } else { q },
            inverse,
            x,
            y,
        })
    }

    /// The first hit within `span`, which lies over the domain.
    pub(crate) fn first(&mut self, span: Interval) -> Option<Meeting> {
        match self.descend(span, Aim::First)? {
            Stop::Met(meeting) => Some(meeting),
            Stop::At(mut search) => search.finish(self),
        }
    }

    /// Whether there is a hit within `span`, which lies over the domain.
    pub(crate) fn any(&mut self, span: Interval) -> bool {
        self.descend(span, Aim::Any).is_some()
    }

    /// The first hit below the tables, or the first stretch with one root at most.
    pub(crate) fn stretch(&mut self, span: Interval) -> Option<Stop> {
        self.descend(span, Aim::Stretch)
    }

    fn descend(&mut self, span: Interval, aim: Aim) -> Option<Stop> {
        self.aim = aim;
        let (x, y) = (self.walk.surface.x.domain(), self.walk.surface.y.domain());
        let x = Place { number: 0, left: x.lo, width: x.width() };
        let y = Place { number: 0, left: y.lo, width: y.width() };
        self.visit(x, y, span)
    }

    /// At most 20 deep: a table has 1024 cells of two maps at most, or fewer levels.
    fn visit(&mut self, x: Place, y: Place, span: Interval) -> Option<Stop> {
        let ([f, f_slope], [g, g_slope]) = (*self.x.bounds.get(x.number)?, *self.y.bounds.get(y.number)?);
        let h = times(f, g);
        let h = Interval::new(h.lo - self.walk.pad.z, h.hi + self.walk.pad.z);
        let (o, d) = (self.walk.o, self.walk.d);
        let span = if d.z == 0.0 {
            span.intersection(slab(o.z, 0.0, h))
        } else {
            let (a, b) = ((h.lo - o.z) * self.inverse[2], (h.hi - o.z) * self.inverse[2]);
            let (a, b) = if a < b { (a, b) } else { (b, a) };
            span.intersection(Interval::new(a - 2.0 * UNIT * a.abs(), b + 2.0 * UNIT * b.abs()))
        };
        if span.lo > span.hi || span.lo.is_nan() || span.hi.is_nan() {
            return None;
        }
        let (u, v) = (times(f_slope, g), times(f, g_slope));
        let (u, v) = (spread(u, d.x), spread(v, d.y));
        let rate = Interval::new(d.z - u.hi - v.hi - self.rate_pad, d.z - u.lo - v.lo + self.rate_pad);
        if rate.lo > 0.0 || rate.hi < 0.0 {
            let mut search = Search::new(self, span, rate);
            return match self.aim {
                Aim::Stretch => Some(Stop::At(search)),
                Aim::First => search.finish(self).map(Stop::Met),
                Aim::Any => search.certain(self).then_some(Stop::At(search)),
            };
        }
        let (x_ends, y_ends) = (x.number >= self.x.first_leaf, y.number >= self.y.first_leaf);
        if x_ends && y_ends {
            let surface = self.walk.surface;
            let x = Level::top(surface.x.numbered(x.number), x.left, x.width, [f, f_slope]);
            let y = Level::top(surface.y.numbered(y.number), y.left, y.width, [g, g_slope]);
            let t = self.walk.visit(&x, &y, span)?;
            return Some(Stop::Met(Meeting { t, jets: None }));
        }
        let along_x = y_ends || (!x_ends && x.width >= y.width);
        let (axis, place, count) = if along_x { (0, x, self.x.count) } else { (1, y, self.y.count) };
        let (origin, inverse, late) =
            (if along_x { o.x } else { o.y }, *self.inverse.get(axis)?, *self.late.get(axis)?);
        let width = place.width / count as f64;
        for k in 0..count {
            let j = if inverse < 0.0 { count - 1 - k } else { k };
            let left = place.left + width * j as f64;
            let (a, b) = ((left - origin) * inverse, (left + width - origin) * inverse);
            let (a, b) = if a < b { (a, b) } else { (b, a) };
            let slack = late + 2.0 * UNIT * (a.abs() + b.abs());
            let part = span.intersection(Interval::new(a - slack, b + slack));
            if part.lo <= part.hi {
                let child = Place { number: place.number * count + 1 + j, left, width };
                let (x, y) = if along_x { (child, y) } else { (x, child) };
                if let Some(stop) = self.visit(x, y, part) {
                    return Some(stop);
                }
            }
        }
        None
    }

    /// Value and slope of both axes where the ray meets the surface, the slopes over cells of the tolerance's size.
    pub(crate) fn jets(&self, meeting: Meeting) -> [[f64; 2]; 2] {
        meeting.jets.unwrap_or_else(|| self.above(meeting.t, self.slope_steps).0)
    }

    /// The steps for a height this good.
    #[inline]
    fn steps(&self, error: f64) -> usize {
        let mut steps = 1;
        while steps < self.finest && self.error(steps) > error {
            steps += 1;
        }
        steps
    }

    /// Bound of the error of a height, but for what the surface's rounding adds.
    #[inline]
    fn error(&self, steps: usize) -> f64 {
        let at = |errors: &[[f64; 2]]| errors.get(steps).map_or(f64::INFINITY, |e| e[0]);
        let (f, g) = (at(self.x.jets.errors()), at(self.y.jets.errors()));
        1.0001 * (self.magnitude[0] * g + self.magnitude[1] * f + f * g) + self.blur
    }

    /// The jets at `t`, the height of the ray above the surface, and how it changes.
    #[inline(always)]
    fn above(&self, t: f64, steps: usize) -> ([[f64; 2]; 2], f64, f64) {
        let (o, d) = (self.walk.o, self.walk.d);
        let (x, y) = (o.x + t * d.x, o.y + t * d.y);
        // The numbers of steps that tolerances ask for, as constants: half the time of a loop.
        let (f, g) = match steps {
            1 => (self.x.jets.jet(x, 1), self.y.jets.jet(y, 1)),
            2 => (self.x.jets.jet(x, 2), self.y.jets.jet(y, 2)),
            _ => (self.x.jets.jet(x, steps), self.y.jets.jet(y, steps)),
        };
        let z = o.z + t * d.z;
        ([f, g], z - f[0] * g[0], d.z - d.x * f[1] * g[0] - d.y * f[0] * g[1])
    }
}

/// The search for the one root there may be in a stretch over which the ray comes nearer all along.
///
/// Interval Newton: every evaluation bounds the root from both sides by the greatest and the least rate, and proves, as soon
/// as one of these bounds lies within the stretch, that the root does.
#[derive(Clone, Copy)]
pub(crate) struct Search {
    span: Interval,
    /// `±1`, so that the height above the surface times this grows.
    sign: f64,
    least: f64,
    most: f64,
    /// Their reciprocals; the slack of the bounds is more than their rounding.
    slow: f64,
    fast: f64,
    lo: f64,
    hi: f64,
    /// Whether the root is known not to lie before the stretch, and not behind it.
    starts: bool,
    ends: bool,
    steps: usize,
    /// Bound of the error of a height after so many steps.
    bound: f64,
    wanted: usize,
    slack: f64,
    reach: f64,
    t: f64,
    jets: [[f64; 2]; 2],
    evaluated: u32,
}

/// What a step of a search found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Progress {
    Going,
    /// `t` is as good as it is asked to be, if the root lies within the stretch.
    Near,
    /// The root does not lie within the stretch.
    Outside,
}

impl Search {
    fn new<X: Axis, Y: Axis>(walk: &TableWalk<'_, X, Y>, span: Interval, rate: Interval) -> Self {
        let (sign, least, most) =
            if rate.lo > 0.0 { (1.0, rate.lo, rate.hi) } else { (-1.0, -rate.hi, -rate.lo) };
        let slack = 4.0 * UNIT * (span.lo.abs() + span.hi.abs());
        let reach = walk.reach + slack;
        Self {
            span,
            sign,
            least,
            most,
            slow: 1.0 / least,
            fast: 1.0 / most,
            lo: span.lo,
            hi: span.hi,
            starts: false,
            ends: false,
            steps: 1,
            bound: walk.error(1),
            wanted: walk.steps(0.25 * reach * least),
            slack,
            reach,
            t: 0.5 * span.lo + 0.5 * span.hi,
            jets: [[0.0; 2]; 2],
            evaluated: 0,
        }
    }

    /// One evaluation.
    #[inline]
    pub(crate) fn step<X: Axis, Y: Axis>(&mut self, walk: &TableWalk<'_, X, Y>) -> Progress {
        let t = self.t;
        let (jets, value, slope) = walk.above(t, self.steps);
        let bound = self.bound;
        let (value, slope) = (self.sign * value, self.sign * slope);
        self.jets = jets;
        self.evaluated += 1;
        // The root lies between these: at the least rate it is far, at the greatest near.
        let (low, high) = (value - bound, value + bound);
        let before = t - high * if high > 0.0 { self.slow } else { self.fast } - self.slack;
        let after = t - low * if low < 0.0 { self.slow } else { self.fast } + self.slack;
        self.ends |= low > 0.0 || after <= self.span.hi;
        self.starts |= high < 0.0 || before >= self.span.lo;
        self.lo = if before > self.lo { before } else { self.lo };
        self.hi = if after < self.hi { after } else { self.hi };
        if self.lo > self.hi && !(self.starts && self.ends) {
            return Progress::Outside;
        }
        let size = value.abs();
        if size + bound <= self.reach * self.least
            || (size <= bound && self.steps >= walk.finest)
            || self.evaluated >= EVALUATIONS
        {
            return Progress::Near;
        }
        if size <= 4.0 * bound {
            self.steps = if self.steps < self.wanted { self.wanted } else { walk.finest };
            self.bound = walk.error(self.steps);
        }
        let slope = if slope < self.least { self.least } else { slope };
        let slope = if slope > self.most { self.most } else { slope };
        let newton = t - value / slope;
        let inside = newton > self.lo && newton < self.hi && !self.evaluated.is_multiple_of(8);
        let next = if inside { newton } else { 0.5 * self.lo + 0.5 * self.hi };
        if next == t || self.hi - self.lo <= self.slack {
            return Progress::Near;
        }
        self.t = next;
        Progress::Going
    }

    /// The root, once it is near.
    pub(crate) fn settle<X: Axis, Y: Axis>(&self, walk: &TableWalk<'_, X, Y>) -> Option<Meeting> {
        for (known, t, way) in [(self.starts, self.span.lo, self.sign), (self.ends, self.span.hi, -self.sign)]
        {
            if !known {
                let (_, value, _) = walk.above(t, walk.finest);
                let bound = walk.error(walk.finest);
                if value.abs() <= bound {
                    return Some(Meeting { t, jets: None });
                }
                if way * value > 0.0 {
                    return None;
                }
            }
        }
        Some(Meeting { t: self.t, jets: (self.steps >= walk.slope_steps).then_some(self.jets) })
    }

    fn finish<X: Axis, Y: Axis>(&mut self, walk: &TableWalk<'_, X, Y>) -> Option<Meeting> {
        loop {
            match self.step(walk) {
                Progress::Going => {}
                Progress::Near => return self.settle(walk),
                Progress::Outside => return None,
            }
        }
    }

    /// Whether there is a root, without finding it.
    fn certain<X: Axis, Y: Axis>(&mut self, walk: &TableWalk<'_, X, Y>) -> bool {
        loop {
            match self.step(walk) {
                _ if self.starts && self.ends => return true,
                Progress::Going => {}
                Progress::Near => return self.settle(walk).is_some(),
                Progress::Outside => return false,
            }
        }
    }
}

/// The product, rounded to nearest.
#[inline]
fn times(a: Interval, b: Interval) -> Interval {
    let (p, q, r, s) = (a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi);
    let least = |a: f64, b: f64| if a < b { a } else { b };
    let most = |a: f64, b: f64| if a > b { a } else { b };
    Interval::new(least(least(p, q), least(r, s)), most(most(p, q), most(r, s)))
}

#[inline]
fn spread(a: Interval, s: f64) -> Interval {
    let (p, q) = (a.lo * s, a.hi * s);
    if p < q { Interval::new(p, q) } else { Interval::new(q, p) }
}
