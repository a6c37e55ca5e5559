//! The one root there may be where a ray comes nearer to the surface all along.

use crate::numeric::interval::Interval;
use crate::numeric::polynomial::UNIT;
use crate::ray::ray::{Aim, Root};
use crate::ray::tracer::Path;
use crate::surface::height_field::function::Function;

/// Evaluations that one search makes at most.
const EVALUATIONS: u32 = 80;

/// The search for the one root there may be in a stretch over which the ray comes nearer all along.
///
/// Newton's steps with rates within their bounds, and a bisection now and then. A value and the bounds of the rate enclose the root; once
/// this is within reach and the stretch, the root is certain.
pub(crate) struct Search {
    span: Interval,
    /// `±1`, so that the height above the surface times this grows.
    sign: f64,
    least: f64,
    most: f64,
    /// The root lies between these if it lies in the stretch, and whether it is known not to lie before, and not behind.
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

    /// The root, or none; for [`Aim::Any`] only near to it.
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
            // The root and the next place both lie from `t` as far as the value over one of the rates.
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
                    // Either the root lies outside, or the end of the stretch decides.
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

    /// The root, once it is known to lie so near to `t` or outside the stretch.
    #[inline(always)]
    fn settle<F: Function, G: Function>(&self, path: &Path<'_, F, G>, t: f64, near: f64) -> Option<Root> {
        if (self.starts || t - near >= self.span.lo) && (self.ends || t + near <= self.span.hi) {
            return Some(Root { t, certain: true });
        }
        self.prove(path, t)
    }

    /// Looks at the ends of the stretch that are not known to lie on the right side of the root.
    #[cold]
    #[inline(never)]
    fn prove<F: Function, G: Function>(&self, path: &Path<'_, F, G>, t: f64) -> Option<Root> {
        for (known, end, way) in
            [(self.starts, self.span.lo, self.sign), (self.ends, self.span.hi, -self.sign)]
        {
            if !known {
                let (_, value, _) = path.above(end, path.tracer.finest());
                if value.abs() <= path.error(path.tracer.finest()) {
                    return Some(
                        path.way(self.span).map_or(Root { t: end, certain: false }, |way| way.proven(end)),
                    );
                }
                if way * value > 0.0 {
                    return None;
                }
            }
        }
        Some(Root { t: self.span.nearest(t), certain: true })
    }
}
