//! Ordered descent of a ray through the boxes of a height field.

use crate::numeric::interval::{Bounded, Interval};
use crate::ray::way::{Way, slab};
use crate::surface::height_field::curve::{Below, Cell, Curve};
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;

/// Cells of one axis that a box is split into, one within the other, at most.
const LEVELS: u32 = 96;

/// A cell of one axis: where it lies and what bounds the function there.
struct Level<F: Function> {
    cell: Cell<Below<F>>,
    left: f64,
    width: f64,
    value: Interval,
    slope: Interval,
    depth: u32,
}

impl<F: Function> Level<F> {
    fn root(axis: &Curve<F>) -> Self {
        let domain = axis.domain();
        Self::new(axis, axis.root(), domain.lo, domain.width(), 0)
    }

    #[inline]
    fn new(axis: &Curve<F>, cell: Cell<Below<F>>, left: f64, width: f64, depth: u32) -> Self {
        let [value, slope] = axis.bounds(&cell);
        Self { cell, left, width, value, slope, depth }
    }

    /// The children that a stretch of the ray goes through, in its order, each made when it is asked for, and the part
    /// of the stretch over each; from the ray's origin and direction along the axis and the rounding of its coordinates.
    #[inline]
    fn children<'a>(
        &'a self,
        axis: &'a Curve<F>,
        [origin, direction, pad]: [f64; 3],
        span: Interval,
    ) -> impl Iterator<Item = (impl Fn() -> Self + 'a, Interval)> + 'a {
        let count = axis.count();
        (0..count).filter_map(move |k| {
            let j = if direction < 0.0 { count - 1 - k } else { k };
            let [from, to] = axis.part(j);
            let (left, right) = (self.left + self.width * from, self.left + self.width * to);
            let span = span.intersection(slab(origin, direction, Interval::new(left, right).inflated(pad)));
            let width = self.width * (to - from);
            let part = move || Self::new(axis, axis.child(&self.cell, j), left, width, self.depth + 1);
            (span.lo <= span.hi).then_some((part, span))
        })
    }
}

impl<F: Function, G: Function> Way<'_, HeightField<F, G>> {
    /// The least root along a stretch of the ray.
    pub(crate) fn boxes(&mut self, span: Interval) -> Option<f64> {
        self.visit(&Level::root(&self.surface.x), &Level::root(&self.surface.y), span)
    }

    /// The least root within the box over two cells and a stretch of the ray.
    fn visit(&mut self, x: &Level<F>, y: &Level<G>, span: Interval) -> Option<f64> {
        let height = x.value.product(y.value);
        let span = self.within(span, height);
        if span.lo.is_nan() || span.hi.is_nan() || span.lo > span.hi {
            return None;
        }
        let rate = self.rate([x.slope.product(y.value), x.value.product(y.slope)]);
        if rate.lo > 0.0 || rate.hi < 0.0 {
            return self.crossing(span);
        }
        self.budget = self.budget.saturating_sub(1);
        let (x_ends, y_ends) = (x.depth >= LEVELS, y.depth >= LEVELS);
        let whole = self.budget == 0 || (x_ends && y_ends);
        if whole || span.width() <= self.close {
            return self.crossing(span);
        }
        let (o, d, pad) = (self.ray.origin, self.ray.direction, self.pad);
        if y_ends || (!x_ends && x.width >= y.width) {
            let axis = &self.surface.x;
            x.children(axis, [o.x, d.x, pad.x], span).find_map(|(part, span)| self.visit(&part(), y, span))
        } else {
            let axis = &self.surface.y;
            y.children(axis, [o.y, d.y, pad.y], span).find_map(|(part, span)| self.visit(x, &part(), span))
        }
    }

    /// A root in `span` if the ray's height above the surface changes sign, or cannot be told from 0 at an end.
    fn crossing(&self, span: Interval) -> Option<f64> {
        const STEPS: usize = 80;
        let (mut t0, mut t1) = (span.lo, span.hi);
        let (above0, above1) = (self.height(t0), self.height(t1));
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
            let above = self.height(t);
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
    fn height(&self, t: f64) -> Bounded {
        self.over(t, |x, y| self.surface.near(x, y))
    }
}
