//! Ordered descent of a ray through the boxes of a height field.

use crate::numeric::double::Double;
use crate::numeric::interval::{Bounded, Interval};
use crate::ray::ray::Root;
use crate::ray::way::Way;
use crate::surface::height_field::curve::{Below, Cell, Curve};
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;

/// Cells of one axis that a box is split into, one within the other, at most.
const LEVELS: u32 = 192;

/// Width of the cells, in parts of the domain, down to which a ray's place is known: 2⁻⁹⁶.
const FINEST: f64 = f64::EPSILON * f64::EPSILON / 256.0;

/// Boxes visited at most behind a place where the ray touches the surface.
const FURTHER: u32 = 1 << 10;

/// Boxes that decide at most whether rough stretches hide a pair of roots: of a ray along an axis, and of any other.
const DEEPER: [u32; 2] = [1 << 14, 1 << 7];

/// A cell of one axis: where it lies and what bounds the function there.
struct Level<F: Function> {
    cell: Cell<Below<F>>,
    left: Double,
    width: Double,
    value: Interval,
    slope: Interval,
    depth: u32,
}

impl<F: Function> Level<F> {
    /// The domain, or the one place that a ray keeps to.
    fn root(axis: &Curve<F>, origin: f64, direction: f64) -> Self {
        let domain = axis.domain();
        let width = Double::from(domain.hi).minus(Double::from(domain.lo));
        let whole = Self::new(axis, axis.root(), Double::from(domain.lo), width, 0);
        if direction == 0.0 {
            return Self { value: axis.near(origin).interval(), depth: LEVELS, ..whole };
        }
        whole
    }

    #[inline]
    fn new(axis: &Curve<F>, cell: Cell<Below<F>>, left: Double, width: Double, depth: u32) -> Self {
        let [value, slope] = axis.bounds(&cell);
        Self { cell, left, width, value, slope, depth }
    }

    fn ends(&self, axis: &Curve<F>, other: f64) -> bool {
        // Beside a place that is kept to, cells need no place of their own.
        self.depth >= LEVELS || (other != 0.0 && self.width.hi <= FINEST * axis.domain().width())
    }

    fn knot(&self, axis: &Curve<F>, j: usize) -> Double {
        self.left.plus(self.width.times(axis.function().knot(j)))
    }

    /// The children that a stretch of the ray goes through, in its order, each made when it is asked for, and the part
    /// of the stretch over each; from the ray's origin and direction along the axis.
    #[inline]
    fn children<'a>(
        &'a self,
        axis: &'a Curve<F>,
        [origin, direction]: [f64; 2],
        [mut lo, hi]: [Double; 2],
    ) -> impl Iterator<Item = (impl Fn() -> Self + 'a, [Double; 2])> + 'a {
        let (count, mut done) = (axis.count(), false);
        (0..count).filter_map(move |k| {
            let (j, far) = if direction < 0.0 { (count - 1 - k, count - 1 - k) } else { (k, k + 1) };
            let end = || self.knot(axis, far).minus(Double::from(origin)).over(direction);
            let end = if k + 1 == count { hi } else { end().min(hi) };
            // A stretch that only ends where the next child begins belongs to that.
            if done || (end <= lo && k + 1 < count) {
                return None;
            }
            let span = [lo, end.max(lo)];
            (lo, done) = (span[1], end >= hi);
            let part = move || {
                let share = axis.function().knot(j + 1).minus(axis.function().knot(j));
                let (left, width) = (self.knot(axis, j), self.width.times(share));
                Self::new(axis, axis.child(&self.cell, j), left, width, self.depth + 1)
            };
            Some((part, span))
        })
    }
}

/// Side of the surface on which the ray is, as far as it is known.
struct Sight {
    /// `±1` where it was known last, 0 at the beginning.
    side: f64,
    /// Distance at which the ray came so near that rounding hides the side.
    touched: Option<f64>,
    /// Distance at which a limit left undecided whether it passes through.
    lost: Option<f64>,
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
    way: &'b mut Way<'a, HeightField<F, G>>,
    sight: Sight,
    /// Height of a box that rounding leaves undecided.
    flat: f64,
    /// More than what rounding does to a height in the middle of a stretch.
    blur: f64,
    /// Boxes left for rough stretches, and the end that was looked at last.
    deeper: u32,
    seen: Double,
}

impl<F: Function, G: Function> Way<'_, HeightField<F, G>> {
    /// The least root along a stretch of the ray.
    pub(crate) fn boxes(&mut self, span: Interval) -> Option<Root> {
        let (surface, o, d) = (self.surface, self.ray.origin, self.ray.direction);
        let (x, y) = (Level::root(&surface.x, o.x, d.x), Level::root(&surface.y, o.y, d.y));
        let (mut lo, mut hi) = (Double::from(span.lo), Double::from(span.hi));
        let mut flat = 2.0 * self.pad.z;
        // Rounding at the border counts as the ray's where the surface is smooth.
        let rough = surface.x.derivative().is_none() || surface.y.derivative().is_none();
        for (left, width, origin, direction, value, other) in [
            (x.left, x.width, o.x, d.x, x.value, surface.y.range()),
            (y.left, y.width, o.y, d.y, y.value, surface.x.range()),
        ] {
            let at = |border: Double| border.minus(Double::from(origin)).over(direction);
            if direction == 0.0 {
                flat += 2.0 * value.width() * other.magnitude();
            } else if rough {
                let (a, b) = (at(left), at(left.plus(width)));
                (lo, hi) = (lo.max(a.min(b)), hi.min(a.max(b)));
            }
        }
        let [f, g] = [surface.x.range(), surface.y.range()].map(Interval::magnitude);
        let moved = || surface.x.function().blur() * g + surface.y.function().blur() * f;
        let blur = self.pad.z + if rough { 1.0001 * moved() } else { 0.0 };
        let sight = Sight { side: 0.0, touched: None, lost: None, close: self.finest, found: None };
        let deeper = DEEPER[usize::from(d.x != 0.0 && d.y != 0.0)];
        let mut descent = Descent { way: self, sight, flat, blur, deeper, seen: Double::from(f64::NAN) };
        descent.visit(&x, &y, [lo, hi]);
        let Sight { touched, lost, found, .. } = descent.sight;
        found.or(touched.or(lost).map(|t| Root { t, certain: false }))
    }

    /// The height of the ray above the surface at `t`.
    fn height(&self, t: f64) -> Bounded {
        self.over(t, |x, y| self.surface.near(x, y))
    }
}

impl<F: Function, G: Function> Descent<'_, '_, F, G> {
    /// Whether the search ends within the box over two cells and a stretch of the ray.
    fn visit(&mut self, x: &Level<F>, y: &Level<G>, [mut lo, mut hi]: [Double; 2]) -> bool {
        let (height, span) = (x.value.product(y.value), Interval::new(lo.hi, hi.hi));
        let inside = lo <= hi && span.lo < f64::INFINITY;
        if !inside {
            return false;
        }
        let cut = self.way.within(span, height);
        let (ray, middle) = (self.way.ray, height.middle());
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
        let (span, surface) = (Interval::new(lo.hi, hi.hi), self.way.surface);
        let slopes = [x.slope.product(y.value), x.value.product(y.slope)];
        let rate = self.way.rate(slopes);
        if rate.lo > 0.0 || rate.hi < 0.0 {
            return self.crossing(span, rate, slopes);
        }
        self.way.budget = self.way.budget.saturating_sub(1);
        let d = self.way.ray.direction;
        let (x_ends, y_ends) = (x.ends(&surface.x, d.y), y.ends(&surface.y, d.x));
        if rate.magnitude() < f64::INFINITY {
            if (x_ends && y_ends) || span.width() <= self.way.close {
                return self.crossing(span, rate, slopes);
            }
        } else {
            if height.width() <= self.flat {
                return self.touch(span.lo);
            }
            let short = span.width() <= self.way.close;
            if short && self.looked([lo, hi]) {
                return true;
            }
            if short {
                self.deeper = self.deeper.saturating_sub(1);
            }
            if (x_ends && y_ends) || (short && (self.deeper == 0 || self.sight.lost.is_some())) {
                self.sight.lost.get_or_insert(span.lo);
                return false;
            }
        }
        if self.way.budget == 0 {
            return self.give_up(span);
        }
        let o = self.way.ray.origin;
        if y_ends || (!x_ends && x.width >= y.width) {
            let mut parts = x.children(&surface.x, [o.x, d.x], [lo, hi]);
            parts.any(|(part, span)| self.visit(&part(), y, span))
        } else {
            let mut parts = y.children(&surface.y, [o.y, d.y], [lo, hi]);
            parts.any(|(part, span)| self.visit(x, &part(), span))
        }
    }

    /// Looks at the heights at both ends of a short stretch over a rough surface: whether that ends the search.
    fn looked(&mut self, ends: [Double; 2]) -> bool {
        let (ray, surface, blur) = (self.way.ray, self.way.surface, self.blur);
        let at = |t: Double, o: f64, d: f64| Double::from(o).plus(t.times(Double::from(d)));
        for t in ends {
            if t == self.seen {
                continue;
            }
            self.seen = t;
            let (x, y) = (at(t, ray.origin.x, ray.direction.x), at(t, ray.origin.y, ray.direction.y));
            let height = surface.x.at(x).product(surface.y.at(y));
            let above = ray.origin.z + t.hi * ray.direction.z - height.value;
            if above.abs() > height.bound + blur && self.sight.known(above.signum(), t.hi) {
                return true;
            }
        }
        false
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
