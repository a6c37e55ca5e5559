//! First hits of rays with a smooth height field that has tables, by ranges over ever shorter stretches.

use crate::numeric::interval::Interval;
use crate::ray::newton::Search;
use crate::ray::ray::{Aim, Root};
use crate::ray::tracer::Path;
use crate::ray::way::Way;
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;

/// Stretches that wait behind the one under search at most; more are left to the descent of boxes.
const WAITING: usize = 32;

/// Divisions of stretches before the descent of boxes takes over.
const DIVISIONS: u32 = 256;

impl<F: Function, G: Function> Path<'_, F, G> {
    /// The first hit, or any.
    #[inline(always)]
    pub(crate) fn search(&self, aim: Aim) -> Option<Root> {
        let mut span = self.span;
        let ranges = self.ranges(span);
        let rate = self.narrow(&mut span, ranges);
        if span.lo > span.hi {
            None
        } else if rate.lo > 0.0 || rate.hi < 0.0 {
            Search::new(span, rate).finish(self, aim)
        } else {
            self.divide(span, rate, aim)
        }
    }

    /// Division where the ray may come nearer and go away again.
    #[inline(always)]
    fn divide(&self, mut span: Interval, mut rate: Interval, aim: Aim) -> Option<Root> {
        let mut waiting = [Interval::EMPTY; WAITING];
        let (mut left, mut divisions) = (0, 0);
        loop {
            if span.lo <= span.hi {
                if rate.lo > 0.0 || rate.hi < 0.0 {
                    if let Some(root) = Search::new(span, rate).finish(self, aim) {
                        return Some(root);
                    }
                } else if divisions >= DIVISIONS || left >= WAITING {
                    if let Some(root) = self.descend(span) {
                        return Some(root);
                    }
                } else {
                    divisions += 1;
                    let middle = 0.5 * span.lo + 0.5 * span.hi;
                    let (_, value, _) = self.above(middle, 1);
                    let free = value.abs() - self.error(1);
                    // No root as near as this before and behind.
                    let (mut before, mut behind) = (0.0, 0.0);
                    if free > 0.0 {
                        let (rise, fall) = (0.999 * free / rate.hi, 0.999 * free / -rate.lo);
                        (before, behind) = if value > 0.0 { (rise, fall) } else { (fall, rise) };
                    }
                    let next = Interval::new(middle + behind, span.hi);
                    if next.lo <= next.hi
                        && let Some(place) = waiting.get_mut(left)
                    {
                        *place = next;
                        left += 1;
                    }
                    span.hi = middle - before;
                    if span.lo <= span.hi {
                        rate = self.narrow_well(&mut span);
                        continue;
                    }
                }
            }
            let next = waiting.get(left.wrapping_sub(1))?;
            span = *next;
            left -= 1;
            rate = self.narrow_well(&mut span);
        }
    }

    /// [`Path::narrow`] as well as tables can.
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
    fn descend(&self, span: Interval) -> Option<Root> {
        self.way(span)?.boxes(span, Aim::First)
    }

    /// The ray as without tables.
    pub(crate) fn way(&self, span: Interval) -> Option<Way<'_, HeightField<F, G>>> {
        Some(Way::new(self.tracer.surface, &self.ray, span, 0.0)?.0)
    }

    /// Cuts off what lies above or below all heights of a stretch; the rates at which the ray comes nearer over it.
    #[inline(always)]
    fn narrow(&self, span: &mut Interval, [[f, f_slope], [g, g_slope]]: [[Interval; 2]; 2]) -> Interval {
        let h = times(f, g);
        let (o, d) = (self.ray.origin, self.ray.direction);
        // Infinite for a level ray, and no number, which cuts nothing, on the border of the heights.
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
