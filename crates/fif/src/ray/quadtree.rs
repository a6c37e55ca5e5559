//! The first hit of a ray with any surface: ordered descent of boxes, and stretches between bounds of the rate.

use crate::numeric::interval::Interval;
use crate::ray::interval_newton::Stretches;
use crate::ray::ray::{Aim, Hit, Ray, Root};
use crate::ray::way::{Way, padded};
use crate::surface::bounds::{Surface, SurfaceBounds};

/// A square of the quartered domain.
#[derive(Clone, Copy)]
pub(crate) struct Square {
    pub(crate) level: u32,
    pub(crate) at: [u32; 2],
}

impl Square {
    pub(crate) const WHOLE: Self = Self { level: 0, at: [0; 2] };

    /// Its side along an axis.
    #[inline]
    pub(crate) fn side(self, axis: usize, domain: Interval) -> Interval {
        let step = domain.width() / f64::from(1_u32 << self.level);
        let index = f64::from(if axis == 0 { self.at[0] } else { self.at[1] });
        Interval::new(domain.lo + step * index, domain.lo + step * (index + 1.0))
    }

    #[inline]
    fn quarter(self, right: u32, far: u32) -> Self {
        Self { level: self.level + 1, at: [2 * self.at[0] + right, 2 * self.at[1] + far] }
    }
}

/// Bounds over the squares of the quartered domain.
pub(crate) trait Squares {
    /// The level of the smallest squares.
    fn finest(&self) -> u32;

    /// Bounds over a square, whose sides are `x` and `y`.
    fn heights(&self, square: Square, x: Interval, y: Interval) -> Interval;

    /// Bounds with those of the slopes over a smallest square.
    fn leaf(&self, square: Square, x: Interval, y: Interval) -> SurfaceBounds;
}

/// A surface without a table: bounds are computed when asked for.
pub(crate) struct Unbounded<'a, S: ?Sized>(pub(crate) &'a S);

impl<S: Surface + ?Sized> Squares for Unbounded<'_, S> {
    fn finest(&self) -> u32 {
        5
    }

    fn heights(&self, square: Square, x: Interval, y: Interval) -> Interval {
        if square.level < 2 { self.0.range() } else { self.0.bounds(x, y).height }
    }

    fn leaf(&self, _: Square, x: Interval, y: Interval) -> SurfaceBounds {
        self.0.bounds(x, y)
    }
}

impl<S: Surface + ?Sized> Way<'_, S> {
    /// The least root in the squares along the ray, or any.
    fn descend(&mut self, squares: &impl Squares, span: Interval, aim: Aim) -> Option<Root> {
        const PLACES: usize = 64;
        let [x, y] = self.surface.domain();
        let finest = squares.finest().min(12);
        let (o, d) = (self.ray.origin, self.ray.direction);
        let inverse = [1.0 / d.x, 1.0 / d.y];
        let late = [self.pad.x * inverse[0].abs(), self.pad.y * inverse[1].abs()];
        let mut stack = [(Square::WHOLE, span); PLACES];
        let mut filled = 1_usize;
        let mut stretches = Stretches::new();
        while filled > 0 {
            filled -= 1;
            let Some(&(square, span)) = stack.get(filled) else { break };
            let sides = [square.side(0, x), square.side(1, y)];
            let around = [padded(sides[0], self.pad.x), padded(sides[1], self.pad.y)];
            if square.level >= finest {
                let SurfaceBounds { height, slopes } = squares.leaf(square, around[0], around[1]);
                let span = self.within(span, height);
                if span.lo <= span.hi
                    && let Some(root) = stretches.first(self, span, self.rate(slopes), aim)
                {
                    return Some(root);
                }
                continue;
            }
            let span = self.within(span, squares.heights(square, around[0], around[1]));
            if span.lo.is_nan() || span.hi.is_nan() || span.lo > span.hi {
                continue;
            }
            // The stretch before and behind the middle of either side, whichever way the ray goes.
            let halves = |axis: usize| {
                let (origin, step) = if axis == 0 { (o.x, d.x) } else { (o.y, d.y) };
                let (side, pad, inverse, late) = if axis == 0 {
                    (sides[0], self.pad.x, inverse[0], late[0])
                } else {
                    (sides[1], self.pad.y, inverse[1], late[1])
                };
                let middle = side.middle();
                let backward = u32::from(step < 0.0);
                if step == 0.0 {
                    let at = |near: bool| if near { span } else { Interval::EMPTY };
                    return [(0, at(origin <= middle + pad)), (1, at(origin >= middle - pad))];
                }
                let t = (middle - origin) * inverse;
                let slack = late + 4.0 * f64::EPSILON * t.abs();
                [
                    (backward, span.intersection(Interval::new(span.lo, t + slack))),
                    (1 - backward, span.intersection(Interval::new(t - slack, span.hi))),
                ]
            };
            let (across, along) = (halves(0), halves(1));
            let quarter = |i: usize, j: usize| {
                let ((right, s), (far, t)) = (across[i & 1], along[j & 1]);
                (square.quarter(right, far), s.intersection(t))
            };
            let (mut second, mut third) = (quarter(0, 1), quarter(1, 0));
            if third.1.lo < second.1.lo {
                (second, third) = (third, second);
            }
            for part in [quarter(1, 1), third, second, quarter(0, 0)] {
                if part.1.lo <= part.1.hi
                    && let Some(place) = stack.get_mut(filled)
                {
                    *place = part;
                    filled += 1;
                }
            }
        }
        None
    }

    fn meets(&mut self, squares: &impl Squares, span: Interval, aim: Aim) -> Option<Root> {
        if self.is_vertical() {
            return self.vertical(span);
        }
        let found = self.descend(squares, span, aim);
        // What is left undecided just before a root is as near to it as rounding may put another.
        let near = |t: f64| self.lost.is_none_or(|lost| t - lost <= self.finest);
        let found = found.map(|root| Root { certain: root.certain && near(root.t), ..root });
        found.or(self.lost.map(|t| Root { t, certain: false }))
    }
}

/// The first hit of the ray with `t` in the interval.
pub(crate) fn first<S: Surface + ?Sized>(
    surface: &S,
    squares: &impl Squares,
    ray: &Ray,
    t: Interval,
    tolerance: f64,
) -> Option<Hit> {
    let (mut way, span) = Way::new(surface, ray, t, tolerance)?;
    let root = way.meets(squares, span, Aim::First)?;
    way.hit(root, tolerance)
}

/// Whether the ray meets the surface with `t` in the interval.
pub(crate) fn any<S: Surface + ?Sized>(surface: &S, squares: &impl Squares, ray: &Ray, t: Interval) -> bool {
    let Some((mut way, span)) = Way::new(surface, ray, t, 0.0) else { return false };
    way.meets(squares, span, Aim::Any).is_some_and(|Root { t, .. }| t.is_finite() && ray.at(t).is_finite())
}
