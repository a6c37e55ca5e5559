//! Ordered descent of a ray through the boxes of a height field.

use glam::DVec3;

use crate::numeric::interval::{Bounded, Interval};
use crate::surface::height_field::axis::Axis;
use crate::surface::height_field::height_field::HeightField;

/// Cells of one axis that a box is split into, one within the other, at most.
const LEVELS: u32 = 96;

/// Boxes that one ray visits at most before it takes them as they are.
pub(crate) const BUDGET: u32 = 1 << 16;

/// Length of a stretch of the ray, relative to the domain, that is decided by the signs at its ends.
pub(crate) const CLOSE: f64 = 1e-12;

/// A cell of one axis: where it lies and what bounds the function there.
pub(crate) struct Level<Cell> {
    cell: Cell,
    left: f64,
    width: f64,
    value: Interval,
    slope: Interval,
    depth: u32,
}

impl<Cell: Copy> Level<Cell> {
    pub(crate) fn root<A: Axis<Cell = Cell>>(axis: &A) -> Self {
        let cell = axis.root();
        let [value, slope] = axis.bounds(&cell);
        let domain = axis.domain();
        Self { cell, left: domain.lo, width: domain.width(), value, slope, depth: 0 }
    }

    #[inline]
    fn child<A: Axis<Cell = Cell>>(&self, axis: &A, j: usize, s: [f64; 2]) -> Self {
        let cell = axis.child(&self.cell, j);
        let [value, slope] = axis.bounds(&cell);
        Self {
            cell,
            left: self.left + self.width * s[0],
            width: self.width * (s[1] - s[0]),
            value,
            slope,
            depth: self.depth + 1,
        }
    }
}

/// One ray on its way.
pub(crate) struct Walk<'a, X, Y> {
    pub(crate) surface: &'a HeightField<X, Y>,
    pub(crate) o: DVec3,
    pub(crate) d: DVec3,
    /// More than the rounding of a coordinate on the ray within the domain.
    pub(crate) pad: DVec3,
    /// Length of a stretch that is decided by the signs at its ends.
    pub(crate) close: f64,
    /// Boxes left to visit.
    pub(crate) budget: u32,
}

impl<X, Y> Copy for Walk<'_, X, Y> {}

impl<X, Y> Clone for Walk<'_, X, Y> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<X: Axis, Y: Axis> Walk<'_, X, Y> {
    /// The least root within the box over two cells and a stretch of the ray.
    pub(crate) fn visit(&mut self, x: &Level<X::Cell>, y: &Level<Y::Cell>, span: Interval) -> Option<f64> {
        let height = x.value.product(y.value);
        let span = span.intersection(slab(self.o.z, self.d.z, height.inflated(self.pad.z)));
        if span.lo.is_nan() || span.hi.is_nan() || span.lo > span.hi {
            return None;
        }
        let falls = x.slope.product(y.value).scaled(-self.d.x);
        let rate =
            Interval::new(self.d.z, self.d.z).sum(falls).sum(x.value.product(y.slope).scaled(-self.d.y));
        if rate.lo > 0.0 || rate.hi < 0.0 {
            return self.crossing(span);
        }
        self.budget = self.budget.saturating_sub(1);
        let (x_ends, y_ends) = (x.depth >= LEVELS, y.depth >= LEVELS);
        let whole = self.budget == 0 || (x_ends && y_ends);
        if whole || span.width() <= self.close {
            return self.crossing(span);
        }
        if y_ends || (!x_ends && x.width >= y.width) {
            let count = self.surface.x.count();
            for k in 0..count {
                let j = if self.d.x < 0.0 { count - 1 - k } else { k };
                let s = self.surface.x.part(j);
                let side =
                    Interval::new(x.left + x.width * s[0], x.left + x.width * s[1]).inflated(self.pad.x);
                let span = span.intersection(slab(self.o.x, self.d.x, side));
                if span.lo <= span.hi
                    && let Some(t) = self.visit(&x.child(&self.surface.x, j, s), y, span)
                {
                    return Some(t);
                }
            }
        } else {
            let count = self.surface.y.count();
            for k in 0..count {
                let j = if self.d.y < 0.0 { count - 1 - k } else { k };
                let s = self.surface.y.part(j);
                let side =
                    Interval::new(y.left + y.width * s[0], y.left + y.width * s[1]).inflated(self.pad.y);
                let span = span.intersection(slab(self.o.y, self.d.y, side));
                if span.lo <= span.hi
                    && let Some(t) = self.visit(x, &y.child(&self.surface.y, j, s), span)
                {
                    return Some(t);
                }
            }
        }
        None
    }

    /// A root in `span` if the ray's height above the surface changes sign, or cannot be told from 0 at an end.
    fn crossing(&self, span: Interval) -> Option<f64> {
        const STEPS: usize = 80;
        let (mut t0, mut t1) = (span.lo, span.hi);
        let (above0, above1) = (self.above(t0), self.above(t1));
        if above0.value.abs() <= above0.bound {
            return Some(t0);
        }
        if (above0.value < 0.0) == (above1.value < 0.0) {
            return (above1.value.abs() <= above1.bound).then_some(t1);
        }
        // Illinois: a secant whose older end counts half when it stays, with a bisection now and then.
        let (mut v0, mut v1) = (above0.value, above1.value);
        let mut stayed = 0_i32;
        for step in 0..STEPS {
            let secant = t1 - v1 * ((t1 - t0) / (v1 - v0));
            let middle = 0.5 * t0 + 0.5 * t1;
            let t = if step % 8 == 7 || !(t0 < secant && secant < t1) { middle } else { secant };
            if t <= t0 || t >= t1 {
                break;
            }
            let above = self.above(t);
            if above.value.abs() <= above.bound {
                return Some(t);
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
        Some(0.5 * t0 + 0.5 * t1)
    }

    /// The height of the ray above the surface at `t`.
    fn above(&self, t: f64) -> Bounded {
        let z = self.o.z + t * self.d.z;
        let h = self.surface.near(self.o.x + t * self.d.x, self.o.y + t * self.d.y);
        Bounded { value: z - h.value, bound: h.bound + f64::EPSILON * (self.o.z.abs() + z.abs()) }
    }

    /// A ray along z meets the surface at one height.
    pub(crate) fn vertical(&self, span: Interval) -> Option<f64> {
        if span.lo > span.hi {
            return None;
        }
        let above = self.above(0.0);
        let t = -above.value / self.d.z;
        let slack = above.bound / self.d.z.abs();
        let near = span.lo - slack <= t && t <= span.hi + slack;
        near.then(|| t.clamp(span.lo, span.hi))
    }
}

/// The stretch of `t` with `origin + t direction` in `side`; everything or nothing for a ray parallel to it.
#[inline]
pub(crate) fn slab(origin: f64, direction: f64, side: Interval) -> Interval {
    if direction == 0.0 {
        return if side.contains(origin) { Interval::ENTIRE } else { Interval::EMPTY };
    }
    let (a, b) = ((side.lo - origin) / direction, (side.hi - origin) / direction);
    if a < b { Interval::new(a, b) } else { Interval::new(b, a) }
}
