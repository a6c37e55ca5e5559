//! Means of heights and slopes of a height field over a rectangle, in closed form.

use crate::calculus::moment_basis::MomentError;
use crate::numeric::estimate::Estimate;
use crate::numeric::interval::Interval;
use crate::surface::height_field::axis::{Axis, Smooth};
use crate::surface::height_field::height_field::HeightField;
#[cfg(feature = "alloc")]
use crate::surface::height_field::tabulated::Cached;
use crate::system::fif::Fif;
use crate::system::map::Piece;

/// Means of a function over an interval, and of its slope when it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineMeans {
    /// The mean of `f`.
    pub value: Estimate,
    /// The mean of `f²`.
    pub value_squared: Estimate,
    /// The means of `f′`, of `f′²` and of `f f′`.
    pub slope: Option<[Estimate; 3]>,
}

/// An [`Axis`] whose means over intervals are known in closed form.
pub trait AxisMeans: Axis {
    /// The means over the interval between `l` and `r`, clamped to the domain; the values at `l` when both are equal.
    ///
    /// # Errors
    /// [`MomentError`], when the polynomials' degree is too large.
    fn means(&self, l: f64, r: f64) -> Result<LineMeans, MomentError>;
}

impl<S: AsRef<[Piece<C>]>, const C: usize> AxisMeans for Fif<S, C> {
    fn means(&self, l: f64, r: f64) -> Result<LineMeans, MomentError> {
        Ok(LineMeans { value: self.mean(l, r), value_squared: self.mean_square(l, r)?, slope: None })
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize, T: AsRef<[Piece<D>]>, const D: usize> AxisMeans
    for Smooth<S, C, T, D>
{
    fn means(&self, l: f64, r: f64) -> Result<LineMeans, MomentError> {
        let slope = self.derivative().mean(l, r);
        // ∫ f f′ = (f(r)² − f(l)²)/2 = (f(r) + f(l))/2 · ∫ f′: the second form does not cancel.
        let [a, b] = [l, r].map(|x| self.value().evaluate(x, 0.0));
        let ends = Estimate::new(
            0.5 * (a.value + b.value),
            0.5 * (a.value.abs() + b.value.abs()),
            a.bound + b.bound,
        );
        let slope = [slope, self.derivative().mean_square(l, r)?, ends.product(slope)];
        Ok(LineMeans { slope: Some(slope), ..self.value().means(l, r)? })
    }
}

#[cfg(feature = "alloc")]
impl<A: AxisMeans> AxisMeans for Cached<A> {
    fn means(&self, l: f64, r: f64) -> Result<LineMeans, MomentError> {
        self.axis().means(l, r)
    }
}

impl<A: AxisMeans> AxisMeans for &A {
    fn means(&self, l: f64, r: f64) -> Result<LineMeans, MomentError> {
        A::means(self, l, r)
    }
}

/// Means over a rectangle of a height field, each over the area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaMeans {
    /// The mean height `h`.
    pub height: Estimate,
    /// The mean of `h²`.
    pub height_squared: Estimate,
    /// Means of the slopes; `None` unless both axes are differentiable.
    pub slopes: Option<SlopeMeans>,
}

/// Means of the slopes `h_x = ∂h/∂x` and `h_y = ∂h/∂y` over a rectangle.
///
/// Mean and covariance of the slopes, that is the normal and the roughness of what a pixel's footprint does not resolve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlopeMeans {
    /// The means of `h_x` and of `h_y`.
    pub slope: [Estimate; 2],
    /// The means of `h_x²` and of `h_y²`.
    pub squared: [Estimate; 2],
    /// The mean of `h_x h_y`.
    pub product: Estimate,
}

impl<X: AxisMeans, Y: AxisMeans> HeightField<X, Y> {
    /// The means of heights and slopes over the rectangle `x × y`, clamped to the domain.
    ///
    /// ```text
    /// ⟨h⟩ = ⟨f⟩⟨g⟩       ⟨h²⟩ = ⟨f²⟩⟨g²⟩       ⟨h_x⟩ = ⟨f′⟩⟨g⟩       ⟨h_x²⟩ = ⟨f′²⟩⟨g²⟩       ⟨h_x h_y⟩ = ⟨f f′⟩⟨g g′⟩
    /// ```
    ///
    /// Each factor is a mean over an interval, [`Fif::mean`] and [`Fif::mean_square`]; a rectangle without area gives the
    /// values along its line or at its point.
    ///
    /// - **Accuracy:** measured against exact rationals, 45 rectangles: within 5e-14 relative times `condition`.
    ///
    /// ```
    /// use asperity_fif::{FixedSmooth, HeightField, Interval, paper};
    /// let axis = FixedSmooth::<2, 3, 2>::integral(paper::f()?, 0.0)?;
    /// let whole = Interval::new(0.0, 2.0);
    /// let means = HeightField::new(axis, axis).area_means(whole, whole)?;
    /// assert!((means.height.value - 1.0).abs() < 1e-14);
    /// assert!((means.slopes.unwrap().slope[0].value - 1.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MomentError`], when the polynomials' degree is too large.
    pub fn area_means(&self, x: Interval, y: Interval) -> Result<AreaMeans, MomentError> {
        let (f, g) = (self.x.means(x.lo, x.hi)?, self.y.means(y.lo, y.hi)?);
        let slopes = f.slope.zip(g.slope).map(|([fx, fx_squared, ffx], [gy, gy_squared, ggy])| SlopeMeans {
            slope: [fx.product(g.value), f.value.product(gy)],
            squared: [fx_squared.product(g.value_squared), f.value_squared.product(gy_squared)],
            product: ffx.product(ggy),
        });
        Ok(AreaMeans {
            height: f.value.product(g.value),
            height_squared: f.value_squared.product(g.value_squared),
            slopes,
        })
    }
}
