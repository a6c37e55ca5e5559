//! Schlick's approximation with a tint near 82°, for the dip of metals.

use glam::Vec3;

use crate::error::ShadingError;
use crate::math::clamp_to;
use crate::parameter::as_share;
use crate::reflectance::fresnel::interface::{Fresnel, channels};

/// Schlick's approximation, reduced to a given tint at `cos θ = 1/7`, about 82° from the normal.
///
/// ```
/// use asperity_shading::reflectance::SchlickF82;
///
/// // Aluminum reflects less just before the horizon than straight down.
/// let aluminium = SchlickF82::new(0.91, 0.94)?;
/// assert!(aluminium.reflectance(1.0 / 7.0) < 0.94 * 0.96);
/// assert_eq!(aluminium.reflectance(0.0), 1.0);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchlickF82 {
    f0: f32,
    /// The weight of `cos θ (1 − cos θ)⁶`.
    dip: f32,
}

impl SchlickF82 {
    /// Creates the approximation with reflectance `f0` at normal incidence, and `tint` at 82°.
    ///
    /// `tint` is a factor of Schlick's approximation at `cos θ = 1/7`.
    ///
    /// # Errors
    /// [`ShadingError`] unless both are within `[0, 1]`.
    pub fn new(f0: f32, tint: f32) -> Result<Self, ShadingError> {
        as_share("f0", f0)?;
        as_share("tint", tint)?;
        // In f64, because (6/7)⁵ and (6/7)⁶ amplify the rounding of their dividends.
        let sixth = 6.0_f64 / 7.0;
        let fifth_power = sixth * sixth * sixth * sixth * sixth;
        let schlick = f64::from(f0) + (1.0 - f64::from(f0)) * fifth_power;
        let dip = schlick * (1.0 - f64::from(tint)) * 7.0 / (fifth_power * sixth);
        Ok(Self { f0, dip: dip as f32 })
    }

    /// The weight `a` of `cos θ (1 − cos θ)⁶`, dimensionless.
    #[must_use]
    pub const fn dip(&self) -> f32 {
        self.dip
    }

    /// The reflectance.
    ///
    /// ```text
    /// F = F₀ + (1 − F₀) (1 − c)⁵ − a c (1 − c)⁶,   c = cos θ,   a such that F(1/7) is the tint's
    /// ```
    ///
    /// - **Domain:** `cos_theta` is clamped to `[0, 1]`; NaN is read as 0, the horizon.
    /// - **Range:** `[0, 1]`; 0 where the last term is larger.
    /// - **Accuracy:** 3·10⁻⁷ compared with the formula.
    ///
    /// Kutz, Hašan, Edmondson 2021, *Novel aspects of the Adobe Standard Material*, §2.3.
    #[must_use]
    pub fn reflectance(&self, cos_theta: f32) -> f32 {
        let c = clamp_to(cos_theta, 1.0);
        let x = 1.0 - c;
        let x2 = x * x;
        let x5 = x2 * x2 * x;
        clamp_to(self.f0 + (1.0 - self.f0) * x5 - self.dip * c * (x5 * x), 1.0)
    }
}

channels!(SchlickF82);
