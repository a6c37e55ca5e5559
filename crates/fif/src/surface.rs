//! What bounds and rays need of any surface over the plane.

use glam::DVec2;

use crate::folded::FoldedSurface;
use crate::folded_node::FoldedNode;
use crate::interval::{Bounded, Interval};
use crate::torus::TorusSurface;
use crate::torus_node::TorusNode;

/// Enclosures of the heights and slopes of a surface over a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceBounds {
    /// Of the heights.
    pub height: Interval,
    /// Of `∂f/∂x` and `∂f/∂y`.
    pub slopes: [Interval; 2],
}

/// A surface `z = f(x, y)` over a rectangle, as far as bounds of it and rays against it need.
pub trait Surface {
    /// The rectangle.
    #[must_use]
    fn domain(&self) -> [Interval; 2];

    /// A rigorous enclosure of the heights.
    #[must_use]
    fn range(&self) -> Interval;

    /// The height with a bound of its error, to `tolerance` or the rounding error. Points outside the domain stand for some
    /// point of it; one at its border may be rounded to the outside.
    #[must_use]
    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded;

    /// Rigorous enclosures of heights and slopes over a rectangle, [`Interval::ENTIRE`] for unknown slopes.
    #[must_use]
    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds;

    /// The gradient at a point that is known to `distance`, or `None` where there is none.
    #[must_use]
    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2>;
}

const PERIOD: Interval = Interval::new(0.0, 1.0);

/// Over one period, the unit square.
impl<S: AsRef<[TorusNode]>> Surface for TorusSurface<S> {
    fn domain(&self) -> [Interval; 2] {
        [PERIOD; 2]
    }

    fn range(&self) -> Interval {
        self.range()
    }

    #[inline]
    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        self.evaluate(x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        self.bounds(x, y)
    }

    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2> {
        let tolerance = if distance > 0.0 { self.gradient_modulus(distance) } else { 0.0 };
        let [x, y] = self.evaluate_gradient(x, y, tolerance);
        Some(DVec2::new(x.value, y.value))
    }
}

impl<S: AsRef<[FoldedNode]>> Surface for FoldedSurface<S> {
    fn domain(&self) -> [Interval; 2] {
        self.domain()
    }

    fn range(&self) -> Interval {
        self.range()
    }

    #[inline]
    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        self.evaluate(x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        self.bounds(x, y)
    }

    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2> {
        let tolerance = if distance > 0.0 { 2.0 * self.gradient_modulus(distance) } else { 0.0 };
        let [x, y] = self.evaluate_gradient(x, y, tolerance);
        Some(DVec2::new(x.value, y.value))
    }
}
