//! One ray on its way to a surface.

use glam::DVec3;

use crate::numeric::interval::{Bounded, Interval};
use crate::ray::ray::{Hit, Ray, Root};
use crate::surface::bounds::Surface;
use crate::surface::normal::upward_normal;

/// Evaluations, or boxes, that one ray takes at most; beyond, a hit is not certain.
const BUDGET: u32 = 1 << 16;

/// Length of a stretch of the ray, relative to the domain, at whose ends a change of sign is a root.
const CLOSE: f64 = 1e-12;

/// One ray on its way.
pub(crate) struct Way<'a, S: ?Sized> {
    pub(crate) surface: &'a S,
    pub(crate) ray: Ray,
    /// More than the rounding of a coordinate on the ray within the domain.
    pub(crate) pad: DVec3,
    /// Length of a stretch at whose ends a change of sign is a root, and of one that is not split any more.
    pub(crate) close: f64,
    pub(crate) finest: f64,
    /// Whether a root is wanted to the rounding error.
    pub(crate) exact: bool,
    /// Evaluations or boxes left.
    pub(crate) budget: u32,
    /// Distance at which a limit first left undecided whether the ray meets the surface.
    pub(crate) lost: Option<f64>,
}

impl<'a, S: Surface + ?Sized> Way<'a, S> {
    /// The ray ready to go, and the stretch of it over the domain, which may be empty; `None` for a ray that is none.
    pub(crate) fn new(surface: &'a S, ray: &Ray, t: Interval, tolerance: f64) -> Option<(Self, Interval)> {
        let (o, d) = (ray.origin, ray.direction);
        if !o.is_finite() || !d.is_finite() || d == DVec3::ZERO {
            return None;
        }
        let [x, y] = surface.domain();
        let pad = |origin: f64, extent: f64| 16.0 * f64::EPSILON * (origin.abs() + extent);
        let pad = DVec3::new(
            pad(o.x, x.magnitude()),
            pad(o.y, y.magnitude()),
            pad(o.z, surface.range().magnitude()),
        );
        let longest = d.x.abs().max(d.y.abs()).max(d.z.abs());
        let finest = CLOSE * x.width().max(y.width());
        let exact = tolerance <= finest || tolerance.is_nan();
        // The length of the direction is less than √3 times its longest component.
        let finest = finest / longest;
        let close = if exact { finest } else { 0.5 * tolerance / longest };
        let span = Interval::new(if t.lo > 0.0 { t.lo } else { 0.0 }, t.hi);
        let span = span.intersection(slab(o.x, d.x, padded(x, pad.x)));
        let span = span.intersection(slab(o.y, d.y, padded(y, pad.y)));
        let way = Self { surface, ray: *ray, pad, close, finest, exact, budget: BUDGET, lost: None };
        Some((way, span))
    }

    /// The height of the ray above the surface at `t`.
    #[inline]
    pub(crate) fn above(&self, t: f64, tolerance: f64) -> Bounded {
        self.over(t, |x, y| self.surface.evaluate(x, y, tolerance))
    }

    /// The height of the ray at `t` above heights.
    #[inline]
    pub(crate) fn over(&self, t: f64, height: impl Fn(f64, f64) -> Bounded) -> Bounded {
        let at = self.ray.at(t);
        let h = height(at.x, at.y);
        let rounding = f64::EPSILON * (self.ray.origin.z.abs() + at.z.abs());
        Bounded { value: at.z - h.value, bound: h.bound + rounding }
    }

    /// The stretch in which the ray is as high as the surface may be.
    #[inline]
    pub(crate) fn within(&self, span: Interval, height: Interval) -> Interval {
        span.intersection(slab(self.ray.origin.z, self.ray.direction.z, padded(height, self.pad.z)))
    }

    /// Rate at which the height above the surface changes where its slopes are in ranges.
    pub(crate) fn rate(&self, [x, y]: [Interval; 2]) -> Interval {
        let d = self.ray.direction;
        Interval::new(d.z, d.z).sum(x.scaled(-d.x)).sum(y.scaled(-d.y))
    }

    /// Whether the ray runs along z, and so meets the surface at one height.
    pub(crate) fn is_vertical(&self) -> bool {
        self.ray.direction.x == 0.0 && self.ray.direction.y == 0.0
    }

    /// The distance at which a ray along z meets the surface.
    pub(crate) fn vertical(&self, span: Interval) -> Option<Root> {
        if span.lo > span.hi {
            return None;
        }
        let above = self.above(0.0, 0.0);
        let t = -above.value / self.ray.direction.z;
        let slack = above.bound / self.ray.direction.z.abs();
        let near = span.lo - slack <= t && t <= span.hi + slack;
        let certain = span.lo + slack <= t && t <= span.hi - slack;
        near.then(|| Root { t: span.nearest(t), certain })
    }

    /// The root, certain if the signs nearby tell so.
    pub(crate) fn proven(&self, t: f64) -> Root {
        // Where rounding hides the sign for longer than the shortest stretch, farther.
        const NEARBY: [f64; 6] = [1e-3, 1e-2, 1e-1, 1.0, 4.0, 16.0];
        let apart = |near: f64| {
            let [a, b] = [t - near, t + near].map(|t| self.above(t, 0.0));
            a.value.abs() > a.bound && b.value.abs() > b.bound && (a.value < 0.0) != (b.value < 0.0)
        };
        Root { t, certain: NEARBY.iter().any(|part| apart(part * self.finest)) }
    }

    /// The hit at `t`, to the tolerance; `None` for a direction so short that t or the way to the surface overflows.
    pub(crate) fn hit(&self, Root { t, certain }: Root, tolerance: f64) -> Option<Hit> {
        let at = self.ray.at(t);
        if !t.is_finite() || !at.is_finite() {
            return None;
        }
        let [x, y] = self.surface.domain();
        let certain = certain && x.contains(at.x) && y.contains(at.y);
        let (x, y) = (x.nearest(at.x), y.nearest(at.y));
        let (near, height) = if self.exact { (0.0, 0.0) } else { (tolerance, 0.125 * tolerance) };
        let gradient = self.surface.gradient_near(x, y, near);
        let height = self.surface.evaluate(x, y, height).value;
        Some(Hit { t, x, y, height, gradient, normal: gradient.map(upward_normal), certain })
    }
}

pub(crate) fn padded(side: Interval, pad: f64) -> Interval {
    Interval::new(side.lo - pad, side.hi + pad)
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
