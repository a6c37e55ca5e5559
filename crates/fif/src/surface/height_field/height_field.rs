//! The height field of a tensor product, its gradient and its normal.

use glam::{DVec2, DVec3};

use crate::math::sqrt;
use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::polynomial::UNIT;
use crate::surface::height_field::axis::Axis;

/// The surface `z = f(x) g(y)`; `f` and `g` may be different systems on different knots.
///
/// ```text
/// h(x, y) = f(x) g(y)      ∂h/∂x = f′(x) g(y)      ∂h/∂y = f(x) g′(y)      N = (−∂h/∂x, −∂h/∂y, 1) / |…|
/// ```
///
/// An axis is a [`Fif`](crate::Fif) (continuous: heights and hits) or a [`Smooth`](crate::Smooth) (continuously
/// differentiable: gradient and normal too), alone or within a [`Cached`](crate::Cached), which makes hits fast.
/// Points outside the domain are clamped to it, NaN gives NaN.
///
/// Cochran, Lewis, Hart 2000, eq. 41–45; the normal there is not of unit length, here it is.
///
/// ```
/// use asperity_fif::{FixedSmooth, HeightField, paper};
/// let axis = FixedSmooth::<2, 3, 2>::integral(paper::f()?, 0.0)?;
/// let surface = HeightField::new(axis, axis);
/// assert_eq!(surface.height(1.0, 1.0), 1.0);
/// let gradient = surface.gradient(1.0, 1.0).unwrap();
/// assert_eq!((gradient.x, gradient.y), (1.0, 1.0));
/// assert!((surface.normal(0.3, 1.7).unwrap().length() - 1.0).abs() < 1e-15);
/// # Ok::<(), asperity_fif::SystemError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct HeightField<X, Y> {
    /// `f`, along x.
    pub x: X,
    /// `g`, along y.
    pub y: Y,
}

impl<X: Axis, Y: Axis> HeightField<X, Y> {
    /// The tensor product of `x` and `y`.
    #[inline]
    #[must_use]
    pub const fn new(x: X, y: Y) -> Self {
        Self { x, y }
    }

    /// `h` with a bound of its error; `tolerance` is asked of each factor, relative to the other's magnitude.
    ///
    /// ```text
    /// |h − f g| ≤ |f| δ_g + |g| δ_f + δ_f δ_g
    /// ```
    #[inline]
    #[must_use]
    pub fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        let share = |other: Interval| 0.5 * tolerance / other.magnitude().max(f64::MIN_POSITIVE);
        product(self.x.evaluate(x, share(self.y.range())), self.y.evaluate(y, share(self.x.range())))
    }

    /// `h` to the rounding error of the point.
    #[inline]
    pub(crate) fn near(&self, x: f64, y: f64) -> Bounded {
        product(self.x.near(x), self.y.near(y))
    }

    /// `h` to the rounding error; the value of [`HeightField::evaluate`] at tolerance 0.
    #[inline]
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.evaluate(x, y, 0.0).value
    }

    /// `(∂h/∂x, ∂h/∂y)`, or `None` unless both axes are differentiable.
    #[inline]
    #[must_use]
    pub fn gradient(&self, x: f64, y: f64) -> Option<DVec2> {
        let (f_slope, g_slope) = (self.x.slope(x)?, self.y.slope(y)?);
        let (f, g) = (self.x.evaluate(x, 0.0).value, self.y.evaluate(y, 0.0).value);
        Some(DVec2::new(f_slope * g, f * g_slope))
    }

    /// The unit normal, upward, or `None` unless both axes are differentiable.
    #[inline]
    #[must_use]
    pub fn normal(&self, x: f64, y: f64) -> Option<DVec3> {
        self.gradient(x, y).map(upward_normal)
    }
}

fn product(f: Bounded, g: Bounded) -> Bounded {
    let value = f.value * g.value;
    let bound = f.value.abs() * g.bound + g.value.abs() * f.bound + f.bound * g.bound;
    Bounded { value, bound: bound * 1.0001 + UNIT * value.abs() }
}

/// `(−h_x, −h_y, 1)` scaled to length one; steep slopes do not overflow.
pub(crate) fn upward_normal(gradient: DVec2) -> DVec3 {
    let largest = gradient.x.abs().max(gradient.y.abs()).max(1.0);
    let (x, y, z) = (-gradient.x / largest, -gradient.y / largest, 1.0 / largest);
    let length = sqrt(x * x + y * y + z * z);
    DVec3::new(x / length, y / length, z / length)
}
