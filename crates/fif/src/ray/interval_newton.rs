//! The first root along a stretch of a ray, between bounds of the rate at which it comes nearer to the surface.

use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::polynomial::UNIT;
use crate::ray::ray::{Aim, Root};
use crate::ray::way::Way;
use crate::surface::bounds::{Surface, SurfaceBounds};

/// Stretches that wait at most: every split halves one.
const WAITING: usize = 64;

/// Splits after which the slopes are bounded anew.
const SPLITS: u32 = 8;

/// Length of the shortest stretch over a rough surface, in parts of the shortest over a smooth one.
const ROUGH_PART: f64 = 1.0 / 64.0;

/// Evaluations that one search for a single root makes at most.
const EVALUATIONS: u32 = 100;

/// Evaluations that bounds count as.
const BOUNDS: u32 = 2;

/// A stretch, a bound of the rate over it, and what is known of the height at its ends.
#[derive(Clone, Copy)]
struct Stretch {
    span: Interval,
    rate: Interval,
    /// Signed lower bounds of the distance at the ends; 0 where nothing is known.
    clear: [f64; 2],
    splits: u32,
}

/// Stretches left to search, the nearest last.
pub(crate) struct Stretches {
    waiting: [Stretch; WAITING],
    filled: usize,
    /// More than the rounding of t.
    slack: f64,
}

impl Stretches {
    pub(crate) fn new() -> Self {
        let none = Stretch { span: Interval::EMPTY, rate: Interval::ENTIRE, clear: [0.0; 2], splits: 0 };
        Self { waiting: [none; WAITING], filled: 0, slack: 0.0 }
    }

    /// The first root in a stretch, or any.
    pub(crate) fn first<S: Surface + ?Sized>(
        &mut self,
        way: &mut Way<'_, S>,
        span: Interval,
        rate: Interval,
        aim: Aim,
    ) -> Option<Root> {
        self.filled = 0;
        self.slack = 4.0 * UNIT * (span.lo.abs() + span.hi.abs());
        self.push(Stretch { span, rate, clear: [0.0; 2], splits: 0 });
        while let Some(&stretch) = self.waiting.get(..self.filled).and_then(<[_]>::last) {
            self.filled -= 1;
            let Stretch { span: Interval { lo, hi }, rate, clear, splits } = stretch;
            let width = hi - lo;
            let speed = rate.magnitude();
            let rough = !speed.is_finite();
            if rough && aim == Aim::First && width > way.close && way.budget > 0 {
                // Heights at the ends exclude nothing in between; bounds of the parts do.
                self.split(way, stretch);
                continue;
            }
            let coarse = if speed.is_finite() { 0.0625 * speed * width } else { way.surface.range().width() };
            let low = if clear[0] == 0.0 { distance(way, lo, coarse) } else { clear[0] };
            if low == 0.0 {
                return Some(way.proven(lo));
            }
            let high = if clear[1] == 0.0 { distance(way, hi, coarse) } else { clear[1] };
            let crosses = (low < 0.0) != (high < 0.0) && high != 0.0;
            if crosses && aim == Aim::Any {
                return Some(Root { t: lo, certain: true });
            }
            if rate.lo > 0.0 || rate.hi < 0.0 {
                if crosses {
                    return Some(Root { t: self.root(way, stretch.span, rate, low), certain: true });
                }
                if high == 0.0 {
                    return Some(way.proven(hi));
                }
                continue;
            }
            if crosses && (width <= way.close || way.budget == 0) {
                let certain = width <= way.close;
                return Some(Root { t: self.root(way, stretch.span, Interval::ENTIRE, low), certain });
            }
            // From either end the surface comes nearer at these rates at most.
            let (fall, rise) = if low > 0.0 { (-rate.lo, rate.hi) } else { (rate.hi, -rate.lo) };
            let from = lo + low.abs() / fall - self.slack;
            let from = if from > lo { from } else { lo };
            let to = if crosses || high == 0.0 { hi } else { hi - high.abs() / rise + self.slack };
            let to = if to < hi { to } else { hi };
            if from > to {
                continue;
            }
            let finest = if rough { ROUGH_PART * way.finest } else { way.finest };
            if width <= finest || way.budget == 0 {
                // Nothing may tell whether the ray dips in and out again.
                if way.lost.is_none() && bounded(way, stretch).is_some() {
                    way.lost = Some(lo);
                }
                continue;
            }
            let kept = |end: f64, old: f64, clear: f64| if end == old { clear } else { 0.0 };
            let clear = [kept(from, lo, low), kept(to, hi, high)];
            let left = Stretch { span: Interval::new(from, to), rate, clear, splits };
            if to - from <= 0.5 * width {
                self.push(left);
            } else {
                self.split(way, left);
            }
        }
        None
    }

    fn push(&mut self, stretch: Stretch) {
        if let Some(place) = self.waiting.get_mut(self.filled) {
            *place = stretch;
            self.filled += 1;
        }
    }

    /// Both halves, with new bounds once they are much smaller than what the old ones are for.
    fn split<S: Surface + ?Sized>(&mut self, way: &mut Way<'_, S>, stretch: Stretch) {
        let Stretch { span, rate, clear, splits } = stretch;
        let middle = span.middle();
        let halves = [
            (Interval::new(middle, span.hi), [0.0, clear[1]]),
            (Interval::new(span.lo, middle), [clear[0], 0.0]),
        ];
        for (half, clear) in halves {
            let part = Stretch { span: half, rate, clear, splits: splits + 1 };
            if !rate.magnitude().is_finite() || (splits + 1).is_multiple_of(SPLITS) {
                if let Some(part) = bounded(way, part) {
                    self.push(part);
                }
            } else {
                self.push(part);
            }
        }
    }

    /// The root in a stretch at whose ends the signs differ; the only one, if the rate excludes 0.
    fn root<S: Surface + ?Sized>(
        &self,
        way: &mut Way<'_, S>,
        span: Interval,
        rate: Interval,
        low: f64,
    ) -> f64 {
        let sign = if low < 0.0 { 1.0 } else { -1.0 };
        // The height times the sign grows over the stretch.
        let rate = rate.scaled(sign);
        let (pace, most) = (rate.lo.max(0.0), rate.hi);
        let (mut lo, mut hi) = (span.lo, span.hi);
        let mut t = span.middle();
        let mut last: Option<(f64, f64)> = None;
        for step in 0..EVALUATIONS {
            let width = hi - lo;
            let enough = if way.exact { self.slack } else { way.close };
            if width <= enough || t <= lo || t >= hi {
                break;
            }
            let wanted = 0.03125 * pace * width;
            let Bounded { value, bound } = way.above(t, wanted);
            way.budget = way.budget.saturating_sub(1);
            let (value, at) = (sign * value, t);
            if value.abs() <= bound && wanted <= 2.0 * bound {
                return t;
            }
            // The root lies between these: at the least rate it is far, at the greatest near.
            let (below, over) = (value - bound, value + bound);
            let quick = |v: f64| if most.is_finite() { v / most } else { 0.0 };
            let slow = |v: f64| if pace > 0.0 { v / pace } else { v * f64::INFINITY };
            let before = at - if over > 0.0 { slow(over) } else { quick(over) } - self.slack;
            let after = at - if below < 0.0 { slow(below) } else { quick(below) } + self.slack;
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
}

/// The ray's height above the surface, moved towards 0 by its bound: 0 only where the sign cannot be told.
fn distance<S: Surface + ?Sized>(way: &mut Way<'_, S>, t: f64, tolerance: f64) -> f64 {
    const FINER: f64 = 1.0 / 4096.0;
    let mut tolerance = tolerance;
    loop {
        let Bounded { value, bound } = way.above(t, tolerance);
        way.budget = way.budget.saturating_sub(1);
        if value.abs() > bound {
            return if value < 0.0 { value + bound } else { value - bound };
        }
        if tolerance <= 0.0 || tolerance.is_nan() || value.is_nan() {
            return 0.0;
        }
        tolerance = if bound < 0.5 * tolerance { 0.0 } else { tolerance * FINER };
    }
}

/// The stretch with bounds over its own rectangle; `None` where the ray is over or under all of that.
fn bounded<S: Surface + ?Sized>(way: &mut Way<'_, S>, stretch: Stretch) -> Option<Stretch> {
    way.budget = way.budget.saturating_sub(BOUNDS);
    let (a, b) = (way.ray.at(stretch.span.lo), way.ray.at(stretch.span.hi));
    let side = |a: f64, b: f64, pad: f64| {
        if a < b { Interval::new(a - pad, b + pad) } else { Interval::new(b - pad, a + pad) }
    };
    let SurfaceBounds { height, slopes } =
        way.surface.bounds(side(a.x, b.x, way.pad.x), side(a.y, b.y, way.pad.y));
    let span = way.within(stretch.span, height);
    let kept = |end: f64, old: f64, clear: f64| if end == old { clear } else { 0.0 };
    let clear =
        [kept(span.lo, stretch.span.lo, stretch.clear[0]), kept(span.hi, stretch.span.hi, stretch.clear[1])];
    let rate = way.rate(slopes).intersection(stretch.rate);
    (span.lo <= span.hi).then_some(Stretch { span, rate, clear, splits: stretch.splits })
}
