//! The first hit of a ray with a height field, by ordered descent of boxes.

use glam::{DVec2, DVec3};

use crate::axis::Axis;
use crate::height_field::{HeightField, upward_normal};
use crate::interval::{Bounded, Interval};

/// A half line, `origin + t direction` for `t ≥ 0`; the direction need not have unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins.
    pub origin: DVec3,
    /// Where it goes; the unit of `t`.
    pub direction: DVec3,
}

impl Ray {
    /// `origin + t direction`.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        DVec3::new(
            self.origin.x + t * self.direction.x,
            self.origin.y + t * self.direction.y,
            self.origin.z + t * self.direction.z,
        )
    }
}

/// Where a ray meets a height field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray's parameter, in units of its direction.
    pub t: f64,
    /// Position along the first axis, within the domain.
    pub x: f64,
    /// Position along the second axis, within the domain.
    pub y: f64,
    /// The surface's height at `(x, y)`.
    pub height: f64,
    /// `(∂h/∂x, ∂h/∂y)`, where the surface is differentiable.
    pub gradient: Option<DVec2>,
    /// The upward unit normal, where the surface is differentiable.
    pub normal: Option<DVec3>,
}

/// Cells of one axis that a box is split into, one within the other, at most.
const LEVELS: u32 = 96;

/// Boxes that one ray visits at most before it takes them as they are.
const BUDGET: u32 = 1 << 16;

/// Length of a stretch of the ray, relative to the domain, that is decided by the signs at its ends.
const CLOSE: f64 = 1e-12;

impl<X: Axis, Y: Axis> HeightField<X, Y> {
    /// The first point of the ray on the surface, `t ≥ 0`; a ray that starts on the surface hits at `t = 0`.
    ///
    /// ```text
    /// least t ≥ 0 with o_z + t d_z = f(o_x + t d_x) g(o_y + t d_y) over the closed domain
    /// ```
    ///
    /// Boxes of rigorous value ranges are visited in the order of the ray, split along one axis at a time. Where the
    /// slope ranges show that the ray comes nearer to the surface all along, there is one root at most: two evaluations
    /// decide, and a bracketed secant finds it to the last places of `t`. A continuous surface is followed down to
    /// stretches of 10⁻¹² of the domain, where a change of sign is a root.
    ///
    /// No hit is passed by, but a pair of roots within one such stretch: a ray that dips into the surface and out again.
    /// Rounding counts as that of the ray: the result belongs to a ray within a few units in the last place, and one that
    /// grazes nearer than the rounding error of `h` counts as a hit. Two limits keep every ray bounded: a box is split
    /// at most 96 times per axis (that binds where a horizontal factor is over 0.75) and a ray visits at most 2¹⁶ boxes;
    /// beyond, a box is decided like a stretch.
    ///
    /// `None` for a ray that misses, a zero direction, and any component that is NaN or infinite.
    ///
    /// Cochran, Lewis, Hart 2000, §4 and Algorithm 3, corrected: the intervals of eq. 50 are sorted and clipped to
    /// `t ≥ 0`, `t = 0` is a hit, the boxes' heights count and not their contraction alone, and the hit lies on the
    /// surface and not amid a box.
    ///
    /// ```
    /// use asperity_fif::{HeightField, Ray, paper};
    /// use glam::DVec3;
    /// let surface = HeightField::new(paper::f()?, paper::f()?);
    /// let ray = Ray { origin: DVec3::new(-1.0, -1.0, 3.0), direction: DVec3::new(1.0, 1.0, -1.0) };
    /// let hit = surface.first_hit(&ray).unwrap();
    /// assert!((ray.at(hit.t).z - hit.height).abs() < 1e-9);
    /// # Ok::<(), asperity_fif::SystemError>(())
    /// ```
    #[must_use]
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        self.first_hit_between(ray, 0.0, f64::INFINITY)
    }

    /// The first hit with `t_min ≤ t ≤ t_max`; a small `t_min` keeps a reflected ray from hitting where it starts.
    ///
    /// A negative or NaN `t_min` stands for 0; `None` when `t_max` is NaN or less.
    #[must_use]
    pub fn first_hit_between(&self, ray: &Ray, t_min: f64, t_max: f64) -> Option<Hit> {
        let t_min = if t_min > 0.0 { t_min } else { 0.0 };
        let (o, d) = (ray.origin, ray.direction);
        if !o.is_finite() || !d.is_finite() || d == DVec3::ZERO {
            return None;
        }
        let (x, y) = (self.x.domain(), self.y.domain());
        let pad = |origin: f64, extent: Interval| 16.0 * f64::EPSILON * (origin.abs() + extent.magnitude());
        let height = self.x.range().product(self.y.range());
        let mut walk = Walk {
            surface: self,
            o,
            d,
            pad: DVec3::new(pad(o.x, x), pad(o.y, y), pad(o.z, height)),
            close: CLOSE * x.width().max(y.width()) / d.x.abs().max(d.y.abs()).max(d.z.abs()),
            budget: BUDGET,
        };
        let span = Interval::new(t_min, t_max);
        let span = span.intersection(slab(o.x, d.x, x.inflated(walk.pad.x)));
        let span = span.intersection(slab(o.y, d.y, y.inflated(walk.pad.y)));
        let t = if d.x == 0.0 && d.y == 0.0 {
            walk.vertical(span)?
        } else {
            let x = Level::root(&self.x);
            let y = Level::root(&self.y);
            walk.visit(&x, &y, span)?
        };
        let at = ray.at(t);
        let (x, y) = (at.x.clamp(x.lo, x.hi), at.y.clamp(y.lo, y.hi));
        let gradient = self.gradient(x, y);
        Some(Hit { t, x, y, height: self.height(x, y), gradient, normal: gradient.map(upward_normal) })
    }
}

/// A cell of one axis: where it lies and what bounds the function there.
struct Level<Cell> {
    cell: Cell,
    left: f64,
    width: f64,
    value: Interval,
    slope: Interval,
    depth: u32,
}

impl<Cell: Copy> Level<Cell> {
    fn root<A: Axis<Cell = Cell>>(axis: &A) -> Self {
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
struct Walk<'a, X, Y> {
    surface: &'a HeightField<X, Y>,
    o: DVec3,
    d: DVec3,
    /// More than the rounding of a coordinate on the ray within the domain.
    pad: DVec3,
    close: f64,
    budget: u32,
}

impl<X: Axis, Y: Axis> Walk<'_, X, Y> {
    /// The least root within the box over two cells and a stretch of the ray.
    fn visit(&mut self, x: &Level<X::Cell>, y: &Level<Y::Cell>, span: Interval) -> Option<f64> {
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
            let middle = 0.5 * (t0 + t1);
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
        Some(0.5 * (t0 + t1))
    }

    /// The height of the ray above the surface at `t`.
    fn above(&self, t: f64) -> Bounded {
        let z = self.o.z + t * self.d.z;
        let h = self.surface.evaluate(self.o.x + t * self.d.x, self.o.y + t * self.d.y, 0.0);
        Bounded { value: z - h.value, bound: h.bound + f64::EPSILON * (self.o.z.abs() + z.abs()) }
    }

    /// A ray along z meets the surface at one height.
    fn vertical(&self, span: Interval) -> Option<f64> {
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
fn slab(origin: f64, direction: f64, side: Interval) -> Interval {
    if direction == 0.0 {
        return if side.contains(origin) { Interval::ENTIRE } else { Interval::EMPTY };
    }
    let (a, b) = ((side.lo - origin) / direction, (side.hi - origin) / direction);
    if a < b { Interval::new(a, b) } else { Interval::new(b, a) }
}
