//! The `Surface` trait: values, enclosures and gradients over a rectangle.

use asperity_core::Interval;
use asperity_core::math::sqrt_f64;
use glam::{DVec2, DVec3};

use crate::numeric::estimate::Bounded;

/// Enclosures of the heights and slopes of a surface over a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct SurfaceBounds {
    /// Enclosure of the heights.
    pub height: Interval,
    /// Enclosures of `∂f/∂x` and `∂f/∂y`.
    pub slopes: [Interval; 2],
}

/// A surface `z = f(x, y)` over a rectangle, the input of bounds and ray intersection.
///
/// Implemented by [`HeightField`](crate::HeightField), by [`SelfAffine`](crate::SelfAffine), and by
/// [`Tabulated`](crate::Tabulated) over any surface. [`Intersect`](crate::Intersect) adds ray
/// intersection.
///
/// ```
/// use asperity_fif::{HeightField, Interval, Surface, cochran_2000};
/// let surface = HeightField::new(cochran_2000::f_hat()?, cochran_2000::f_hat()?);
/// let bounds = surface.bounds(Interval::new(0.3, 0.31), Interval::new(0.7, 0.71));
/// assert!(bounds.height.contains(surface.height(0.305, 0.703)) && bounds.height.width() < 0.02);
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
pub trait Surface {
    /// The rectangle.
    fn domain(&self) -> [Interval; 2];

    /// A rigorous enclosure of the heights.
    fn range(&self) -> Interval;

    /// The height with an error bound, to `tolerance` or the rounding error.
    ///
    /// A point that rounding has moved outside the domain is read as the nearest point of the
    /// domain.
    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded;

    /// Rigorous enclosures of heights and slopes over a rectangle.
    ///
    /// Unknown slopes are [`Interval::ENTIRE`].
    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds;

    /// The gradient at a point known to `distance`, or `None` if it does not exist.
    ///
    /// Changes over smaller distances may be omitted.
    #[must_use]
    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2>;
}

impl<S: Surface + ?Sized> Surface for &S {
    fn domain(&self) -> [Interval; 2] {
        S::domain(self)
    }

    fn range(&self) -> Interval {
        S::range(self)
    }

    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        S::evaluate(self, x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        S::bounds(self, x, y)
    }

    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2> {
        S::gradient_near(self, x, y, distance)
    }
}

/// Upward normal: `(−h_x, −h_y, 1)` scaled to length one; steep slopes do not overflow.
pub(crate) fn upward_normal(gradient: DVec2) -> DVec3 {
    let largest = gradient.x.abs().max(gradient.y.abs()).max(1.0);
    let (x, y, z) = (-gradient.x / largest, -gradient.y / largest, 1.0 / largest);
    let length = sqrt_f64(x * x + y * y + z * z);
    DVec3::new(x / length, y / length, z / length)
}
