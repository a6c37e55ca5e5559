//! Rays and smooth height fields with tables: ranges over shorter and shorter intervals, then
//! Newton steps.

use asperity_core::Interval;
use asperity_core::math::sqrt_f64;
use glam::DVec3;

use crate::numeric::polynomial::UNIT;
use crate::ray::ray::{Aim, Ray, Root};
use crate::ray::traversal::Context;
use crate::surface::height_field::axis_tables::{AxisTables, BothAxes};
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;

/// The tables of a surface and the tolerance of a search.
pub(crate) struct Tracer<'a, F: Function, G: Function> {
    pub(crate) surface: &'a HeightField<F, G>,
    pub(crate) x: &'a AxisTables<F::Rows>,
    pub(crate) y: &'a AxisTables<G::Rows>,
    both: &'a BothAxes,
    tolerance: f64,
    /// Number of steps for the slopes of the hit.
    pub(crate) slope_steps: usize,
}

/// State of one ray.
pub(crate) struct Path<'a, F: Function, G: Function> {
    pub(crate) tracer: &'a Tracer<'a, F, G>,
    pub(crate) ray: Ray,
    pub(crate) span: Interval,
    /// Origin and direction of the ray along both axes, in units of the domain.
    pub(crate) from: [f64; 2],
    pub(crate) direction: [f64; 2],
    /// More than the rounding of these.
    late: [f64; 2],
    /// `1/d_z`
    pub(crate) inverse: f64,
    pub(crate) pad: f64,
    /// More than the rounding of the rate of approach.
    pub(crate) rate_pad: f64,
    /// More than the effect of the rounding of the coordinates on the height.
    pub(crate) blur: f64,
    /// Accepted errors of `t`.
    pub(crate) reach: f64,
}

impl<'a, F: Function, G: Function> Tracer<'a, F, G> {
    /// `None` unless both axes have tables.
    pub(crate) fn new(surface: &'a HeightField<F, G>, tolerance: f64) -> Option<Self> {
        let (x, y, both) = (surface.x.top()?, surface.y.top()?, surface.both.as_ref()?);
        let (wide, deep) = (x.domain.width(), y.domain.width());
        // Over a cell of the size of the tolerance, all slopes are equivalent.
        let tolerance = if tolerance > 0.0 { tolerance } else { 0.0 };
        let part = tolerance / if wide > deep { wide } else { deep };
        let (p, q) = (x.jets.cells_within(part), y.jets.cells_within(part));
        Some(Self { surface, x, y, both, tolerance, slope_steps: if p > q { p } else { q } })
    }

    /// Prepares a ray; `None` for rays with components that are zero, extreme, or NaN.
    #[inline(always)]
    pub(crate) fn path(&'a self, ray: &Ray, t: Interval) -> Option<Path<'a, F, G>> {
        let (o, d) = (ray.origin, ray.direction);
        let inverse = DVec3::new(1.0 / d.x, 1.0 / d.y, 1.0 / d.z);
        let (magnitude, speed) = (o.abs(), d.abs());
        let sizes = (inverse.x.abs() + inverse.y.abs()) + (speed.x + speed.y + speed.z);
        let sane = sizes + (magnitude.x + magnitude.y + magnitude.z) < 1e100;
        if !sane {
            return None;
        }
        let (x, y, both) = (self.x, self.y, self.both);
        let pads = [
            16.0 * f64::EPSILON * magnitude.x + x.pad,
            16.0 * f64::EPSILON * magnitude.y + y.pad,
            16.0 * f64::EPSILON * magnitude.z + both.pad,
        ];
        // NaN as the end leaves nothing.
        let end = if t.hi >= 0.0 { t.hi } else { f64::NEG_INFINITY };
        let mut span = Interval::new(if t.lo > 0.0 { t.lo } else { 0.0 }, end);
        for (side, o, inverse, pad) in
            [(x.domain, o.x, inverse.x, pads[0]), (y.domain, o.y, inverse.y, pads[1])]
        {
            let (a, b) = ((side.lo - pad - o) * inverse, (side.hi + pad - o) * inverse);
            span = span.intersection(if a < b { Interval::new(a, b) } else { Interval::new(b, a) });
        }
        let blur = both.falls[0] * pads[0] + both.falls[1] * pads[1];
        let rate = speed.z + speed.x * both.falls[0] + speed.y * both.falls[1];
        Some(Path {
            tracer: self,
            ray: *ray,
            span,
            from: [(o.x - x.domain.lo) * x.per_width, (o.y - y.domain.lo) * y.per_width],
            direction: [d.x * x.per_width, d.y * y.per_width],
            late: [pads[0] * x.per_width, pads[1] * y.per_width],
            inverse: inverse.z,
            pad: pads[2],
            rate_pad: 16.0 * f64::EPSILON * rate,
            blur: pads[2] + blur,
            reach: if self.tolerance > 0.0 {
                self.tolerance / sqrt_f64(d.x * d.x + d.y * d.y + d.z * d.z)
            } else {
                0.0
            },
        })
    }

    #[inline]
    pub(crate) fn finest(&self) -> usize {
        self.both.finest
    }

    /// Error bound of a height, without the rounding of the ray.
    #[inline]
    pub(crate) fn error(&self, steps: usize) -> f64 {
        self.both.errors.get(steps).copied().unwrap_or(self.both.best)
    }

    /// Position of a ray at `t`, clamped to the domain.
    #[inline(always)]
    pub(crate) fn place(&self, ray: &Ray, t: f64) -> [f64; 2] {
        let within = |x: f64, domain: Interval| {
            let x = if x > domain.lo { x } else { domain.lo };
            if x < domain.hi { x } else { domain.hi }
        };
        let (o, d) = (ray.origin, ray.direction);
        [within(o.x + t * d.x, self.x.domain), within(o.y + t * d.y, self.y.domain)]
    }

    /// More steps than these, if more improve the result.
    #[inline]
    pub(crate) fn better(&self, steps: usize) -> usize {
        if steps == 1 && self.both.finest > 2 { 2 } else { self.both.finest }
    }
}

impl<F: Function, G: Function> Path<'_, F, G> {
    /// The fractions of the domains from the beginning of an interval to its end, in order.
    #[inline(always)]
    fn parts(&self, axis: usize, span: Interval) -> [f64; 2] {
        let (from, direction, late) = (self.from[axis], self.direction[axis], self.late[axis]);
        let (a, b) = (from + span.lo * direction, from + span.hi * direction);
        if direction > 0.0 { [a - late, b + late] } else { [b - late, a + late] }
    }

    /// Ranges of values and slopes along both axes over an interval, from the tables.
    #[inline(always)]
    pub(crate) fn ranges(&self, span: Interval) -> [[Interval; 2]; 2] {
        [self.tracer.x.over(self.parts(0, span)), self.tracer.y.over(self.parts(1, span))]
    }

    /// Narrower ranges, below the cells of the tables.
    #[inline]
    pub(crate) fn finer(&self, span: Interval) -> Option<[[Interval; 2]; 2]> {
        let (x, y) = (self.tracer.x, self.tracer.y);
        let (along_x, along_y) = (self.parts(0, span), self.parts(1, span));
        let short = |[a, b]: [f64; 2], cells: f64| (b - a) * cells <= 1.0;
        if !(short(along_x, x.cells) && short(along_y, y.cells)) {
            return None;
        }
        Some([x.finer(along_x)?, y.finer(along_y)?])
    }

    /// Value and slope of both axes at the hit, the slopes over cells of the size of the tolerance.
    #[inline(always)]
    pub(crate) fn jets(&self, t: f64) -> [[f64; 2]; 2] {
        self.above(t, self.tracer.slope_steps).0
    }

    /// Bound of the error of a height.
    #[inline]
    pub(crate) fn error(&self, steps: usize) -> f64 {
        self.tracer.error(steps) + self.blur
    }

    /// The jets at `t`, the height of the ray above the surface, and its rate of change.
    #[inline(always)]
    pub(crate) fn above(&self, t: f64, steps: usize) -> ([[f64; 2]; 2], f64, f64) {
        let (o, d) = (self.ray.origin, self.ray.direction);
        let (x, y) = (self.from[0] + t * self.direction[0], self.from[1] + t * self.direction[1]);
        let (f, g) = (&self.tracer.x.jets, &self.tracer.y.jets);
        // The numbers of steps as constants, which saves half the time of a loop.
        let (f, g) = match steps {
            1 => (f.jet(x, 1), g.jet(y, 1)),
            2 => (f.jet(x, 2), g.jet(y, 2)),
            _ => (f.jet(x, steps), g.jet(y, steps)),
        };
        let z = o.z + t * d.z;
        ([f, g], z - f[0] * g[0], d.z - d.x * f[1] * g[0] - d.y * f[0] * g[1])
    }
}

/// Maximum number of pending intervals; more are left to the descent of boxes.
const WAITING: usize = 32;

/// Divisions of intervals before the descent of boxes takes over.
const DIVISIONS: u32 = 256;

/// The remaining intervals of a ray, divided where the ray may approach and recede again.
pub(crate) struct Division {
    span: Interval,
    rate: Interval,
    waiting: [Interval; WAITING],
    left: usize,
    divisions: u32,
}

impl Division {
    #[inline(always)]
    pub(crate) fn new(span: Interval, rate: Interval) -> Self {
        Self { span, rate, waiting: [Interval::EMPTY; WAITING], left: 0, divisions: 0 }
    }

    /// Whether no interval follows the last one.
    #[cfg(feature = "simd")]
    #[inline(always)]
    pub(crate) fn is_done(&self) -> bool {
        self.left == 0
    }

    /// The next interval with its rates; if these have both signs, the tables are exhausted.
    #[inline(always)]
    pub(crate) fn next<F: Function, G: Function>(
        &mut self,
        path: &Path<'_, F, G>,
    ) -> Option<(Interval, Interval)> {
        loop {
            if self.span.lo <= self.span.hi {
                let (span, rate) = (self.span, self.rate);
                if keeps_sign(rate) || self.divisions >= DIVISIONS || self.left >= WAITING {
                    self.span = Interval::EMPTY;
                    return Some((span, rate));
                }
                self.divisions += 1;
                let middle = 0.5 * span.lo + 0.5 * span.hi;
                let (_, value, _) = path.above(middle, 1);
                let free = value.abs() - path.error(1);
                // No root is this close before and behind.
                let (mut before, mut behind) = (0.0, 0.0);
                if free > 0.0 {
                    let (rise, fall) = (0.999 * free / rate.hi, 0.999 * free / -rate.lo);
                    (before, behind) = if value > 0.0 { (rise, fall) } else { (fall, rise) };
                }
                let next = Interval::new(middle + behind, span.hi);
                if next.lo <= next.hi
                    && let Some(place) = self.waiting.get_mut(self.left)
                {
                    *place = next;
                    self.left += 1;
                }
                self.span.hi = middle - before;
                if self.span.lo <= self.span.hi {
                    self.rate = path.narrow_well(&mut self.span);
                    continue;
                }
            }
            self.span = *self.waiting.get(self.left.wrapping_sub(1))?;
            self.left -= 1;
            self.rate = path.narrow_well(&mut self.span);
        }
    }
}

/// Whether a ray with these rates approaches or recedes monotonically.
#[inline(always)]
pub(crate) fn keeps_sign(rate: Interval) -> bool {
    rate.lo > 0.0 || rate.hi < 0.0
}

impl<F: Function, G: Function> Path<'_, F, G> {
    /// The first hit, or any.
    #[inline(always)]
    pub(crate) fn search(&self, aim: Aim) -> Option<Root> {
        let (span, rate) = self.approach();
        if span.lo > span.hi {
            None
        } else if keeps_sign(rate) {
            Search::new(span, rate).finish(self, aim)
        } else {
            self.rest(&mut Division::new(span, rate), aim)
        }
    }

    /// The interval in which the ray is in the height range of the surface, and the rates of
    /// approach there.
    #[inline(always)]
    pub(crate) fn approach(&self) -> (Interval, Interval) {
        let mut span = self.span;
        let ranges = self.ranges(span);
        let rate = self.narrow(&mut span, ranges);
        (span, rate)
    }

    /// The first hit in the rest, or any.
    pub(crate) fn rest(&self, parts: &mut Division, aim: Aim) -> Option<Root> {
        while let Some((span, rate)) = parts.next(self) {
            let root =
                if keeps_sign(rate) { Search::new(span, rate).finish(self, aim) } else { self.descend(span) };
            if root.is_some() {
                return root;
            }
        }
        None
    }

    /// [`Path::narrow`] as accurately as tables permit.
    #[inline(always)]
    fn narrow_well(&self, span: &mut Interval) -> Interval {
        let ranges = self.ranges(*span);
        let rate = self.narrow(span, ranges);
        if span.lo <= span.hi
            && rate.lo <= 0.0
            && rate.hi >= 0.0
            && let Some(ranges) = self.finer(*span)
        {
            return self.narrow(span, ranges);
        }
        rate
    }

    /// By boxes, as without tables.
    #[cold]
    pub(crate) fn descend(&self, span: Interval) -> Option<Root> {
        let context = Context::new(self.tracer.surface);
        let (mut traversal, _) = context.ray(&self.ray, span, 0.0)?;
        traversal.boxes(span, Aim::First)
    }

    /// Removes the parts above or below all heights of an interval; returns the rates of approach
    /// over it.
    #[inline(always)]
    fn narrow(&self, span: &mut Interval, [[f, f_slope], [g, g_slope]]: [[Interval; 2]; 2]) -> Interval {
        let h = times(f, g);
        let (o, d) = (self.ray.origin, self.ray.direction);
        // Infinite for a horizontal ray, and NaN, which removes nothing, on the border of the
        // heights.
        let (a, b) = ((h.lo - self.pad - o.z) * self.inverse, (h.hi + self.pad - o.z) * self.inverse);
        let (a, b) = if self.inverse > 0.0 { (a, b) } else { (b, a) };
        span.lo = if a > span.lo { a } else { span.lo };
        span.hi = if b < span.hi { b } else { span.hi };
        let (u, v) = (spread(times(f_slope, g), d.x), spread(times(f, g_slope), d.y));
        Interval::new(d.z - u.hi - v.hi - self.rate_pad, d.z - u.lo - v.lo + self.rate_pad)
    }
}

/// The product, rounded to nearest.
#[inline(always)]
fn times(a: Interval, b: Interval) -> Interval {
    let (p, q, r, s) = (a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi);
    let least = |a: f64, b: f64| if a < b { a } else { b };
    let most = |a: f64, b: f64| if a > b { a } else { b };
    Interval::new(least(least(p, q), least(r, s)), most(most(p, q), most(r, s)))
}

#[inline(always)]
fn spread(a: Interval, s: f64) -> Interval {
    let (p, q) = (a.lo * s, a.hi * s);
    if p < q { Interval::new(p, q) } else { Interval::new(q, p) }
}

/// Maximum number of evaluations of a search.
const EVALUATIONS: u32 = 80;

/// Search for the only possible root in an interval with monotonic approach.
///
/// Uses Newton steps with rates within their bounds, and occasional bisection. A value and the
/// bounds of the rate enclose the root. Once the enclosure is within reach and inside the interval,
/// the root is certain.
pub(crate) struct Search {
    span: Interval,
    /// `±1`, so that the height above the surface times this increases.
    sign: f64,
    least: f64,
    most: f64,
    /// The bracket of the root if it is in the interval, and whether it is known not to lie before
    /// or behind.
    lo: f64,
    hi: f64,
    starts: bool,
    ends: bool,
}

impl Search {
    #[inline(always)]
    pub(crate) fn new(span: Interval, rate: Interval) -> Self {
        let (sign, least, most) =
            if rate.lo > 0.0 { (1.0, rate.lo, rate.hi) } else { (-1.0, -rate.hi, -rate.lo) };
        Self { span, sign, least, most, lo: span.lo, hi: span.hi, starts: false, ends: false }
    }

    /// The root, or none; for [`Aim::Any`] only a point close to it.
    #[inline(always)]
    pub(crate) fn finish<F: Function, G: Function>(
        mut self,
        path: &Path<'_, F, G>,
        aim: Aim,
    ) -> Option<Root> {
        // More than the rounding of `t`.
        let slack = 4.0 * UNIT * (self.span.lo.abs() + self.span.hi.abs());
        let reach = path.reach + slack;
        let (slow, fast) = (1.0 / self.least, 1.0 / self.most);
        let spread = 1.0001 * (slow - fast);
        let (mut steps, mut bound) = (1, path.error(1));
        let mut t = 0.5 * self.span.lo + 0.5 * self.span.hi;
        let mut evaluated = 0_u32;
        loop {
            let (_, value, slope) = path.above(t, steps);
            let (value, slope) = (self.sign * value, self.sign * slope);
            evaluated += 1;
            let slope = if slope < self.least { self.least } else { slope };
            let slope = if slope > self.most { self.most } else { slope };
            let mut next = t - value / slope;
            let size = value.abs();
            // The distances from `t` to the root and to the next position are at most the value
            // over one of the rates.
            if size * spread + 1.0001 * (bound * slow) <= path.reach {
                return self.settle(path, next, reach);
            }
            let before = steps;
            if size <= 4.0 * bound {
                if size <= bound && steps >= path.tracer.finest() {
                    return self.settle(path, next, 2.0 * bound * slow + slack);
                }
                steps = path.tracer.better(steps);
            }
            if size > bound {
                if value > 0.0 {
                    (self.hi, self.ends) = (t, true);
                } else {
                    (self.lo, self.starts) = (t, true);
                }
            }
            if aim == Aim::Any && self.starts && self.ends {
                return Some(Root { t, certain: true });
            }
            if !(next > self.lo && next < self.hi && !evaluated.is_multiple_of(8)) {
                let (end, known) = if value > 0.0 { (self.lo, self.starts) } else { (self.hi, self.ends) };
                let past = size > bound && !(next > self.lo && next < self.hi);
                if past && !known {
                    // Either the root lies outside, or the end of the interval decides.
                    if t == end || (size - bound) * fast > (t - end).abs() + slack {
                        return None;
                    }
                    next = end;
                } else {
                    next = 0.5 * self.lo + 0.5 * self.hi;
                }
            }
            if evaluated >= EVALUATIONS || (steps == before && (next == t || self.hi - self.lo <= slack)) {
                return self.settle(path, t, slack);
            }
            bound = path.error(steps);
            t = next;
        }
    }

    /// The root, once it is known to lie close enough to `t` or outside the interval.
    #[inline(always)]
    fn settle<F: Function, G: Function>(&self, path: &Path<'_, F, G>, t: f64, near: f64) -> Option<Root> {
        if (self.starts || t - near >= self.span.lo) && (self.ends || t + near <= self.span.hi) {
            return Some(Root { t, certain: true });
        }
        self.prove(path, t)
    }

    /// Tests the ends of the interval that are not known to lie on the right side of the root.
    #[cold]
    #[inline(never)]
    fn prove<F: Function, G: Function>(&self, path: &Path<'_, F, G>, t: f64) -> Option<Root> {
        for (known, end, sign) in
            [(self.starts, self.span.lo, self.sign), (self.ends, self.span.hi, -self.sign)]
        {
            if !known {
                let (_, value, _) = path.above(end, path.tracer.finest());
                if value.abs() <= path.error(path.tracer.finest()) {
                    let context = Context::new(path.tracer.surface);
                    let traversal = context.ray(&path.ray, self.span, 0.0);
                    return Some(traversal.map_or(Root { t: end, certain: false }, |(t, _)| t.proven(end)));
                }
                if sign * value > 0.0 {
                    return None;
                }
            }
        }
        Some(Root { t: self.span.nearest(t), certain: true })
    }
}
