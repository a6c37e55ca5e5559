//! Means of heights and slopes of a height field over a rectangle, in closed form.

use asperity_core::Interval;

use crate::numeric::estimate::Estimate;
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;
use crate::system::error::FifError;

/// Means of a height field over the area of a rectangle.
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
/// The mean and covariance of the slopes are the normal and the roughness of the unresolved part of
/// a pixel footprint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlopeMeans {
    /// The means of `h_x` and of `h_y`.
    pub slope: [Estimate; 2],
    /// The means of `h_x²` and of `h_y²`.
    pub squared: [Estimate; 2],
    /// The mean of `h_x h_y`.
    pub product: Estimate,
}

impl<F: Function, G: Function> HeightField<F, G> {
    /// The means of heights and slopes over the rectangle `x × y`, clamped to the domain.
    ///
    /// ```text
    /// ⟨h⟩ = ⟨f⟩⟨g⟩       ⟨h²⟩ = ⟨f²⟩⟨g²⟩       ⟨h_x⟩ = ⟨f′⟩⟨g⟩       ⟨h_x²⟩ = ⟨f′²⟩⟨g²⟩       ⟨h_x h_y⟩ = ⟨f f′⟩⟨g g′⟩
    /// ```
    ///
    /// Each factor is a mean over an interval, [`System::mean`](crate::System::mean) and
    /// [`System::mean_square`](crate::System::mean_square). A rectangle without area returns the
    /// values along its line or at its point.
    ///
    /// - **Accuracy:** measured against exact rationals, 45 rectangles: within 5e-14 relative times
    ///   `condition`.
    ///
    /// ```
    /// use asperity_fif::{HeightField, Interval, cochran_2000};
    /// let whole = Interval::new(0.0, 2.0);
    /// let means = HeightField::new(cochran_2000::f_hat()?, cochran_2000::f_hat()?).area_means(whole, whole)?;
    /// assert!((means.height.value - 1.0).abs() < 1e-14);
    /// assert!((means.slopes.unwrap().slope[0].value - 1.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FifError`] if the degree of the polynomials is too large.
    pub fn area_means(&self, x: Interval, y: Interval) -> Result<AreaMeans, FifError> {
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
