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

/// The stretches of a ray that are left to be searched, from the first on, divided where the ray may come nearer and go away again.
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

    /// Whether no stretch waits behind the last one.
    #[cfg(feature = "simd")]
    #[inline(always)]
    pub(crate) fn is_done(&self) -> bool {
        self.left == 0
    }

    /// The next stretch with its rates; where these are of both signs, tables are at their end.
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
                // No root as near as this before and behind.
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

/// Whether a ray with these rates comes nearer all along, or goes away.
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

    /// The stretch over which the ray is as high as the surface may be, and the rates at which it comes nearer there.
    #[inline(always)]
    pub(crate) fn approach(&self) -> (Interval, Interval) {
        let mut span = self.span;
        let ranges = self.ranges(span);
        let rate = self.narrow(&mut span, ranges);
        (span, rate)
    }

    /// The first hit in what is left, or any.
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
    pub(crate) fn descend(&self, span: Interval) -> Option<Root> {
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
