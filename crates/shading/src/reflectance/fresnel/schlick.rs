//! Schlick's approximation of the Fresnel reflectance.

use glam::Vec3;

use crate::error::ShadingError;
use crate::math::clamp_to;
use crate::parameter::as_share;
use crate::reflectance::fresnel::interface::{Fresnel, channels};

/// Schlick's approximation with the reflectance `F₀` at normal incidence.
///
/// ```
/// use asperity_shading::Schlick;
///
/// let glass = Schlick::new(0.04)?;
/// assert_eq!(glass.reflectance(1.0), 0.04);
/// assert_eq!(glass.reflectance(0.0), 1.0);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schlick {
    f0: f32,
}

impl Schlick {
    /// Creates the approximation with the reflectance `f0` at normal incidence.
    ///
    /// # Errors
    /// [`ShadingError`] unless `f0` is within `[0, 1]`.
    pub fn new(f0: f32) -> Result<Self, ShadingError> {
        Ok(Self { f0: as_share("f0", f0)? })
    }

    /// The reflectance at normal incidence, dimensionless.
    #[must_use]
    pub const fn f0(&self) -> f32 {
        self.f0
    }

    /// The reflectance.
    ///
    /// ```text
    /// F = F₀ + (1 − F₀) (1 − cos θ)⁵
    /// ```
    ///
    /// - **Domain:** `cos_theta` is clamped to `[0, 1]`; NaN is read as 0, the horizon.
    /// - **Range:** `[F₀, 1]`, dimensionless.
    /// - **Accuracy:** 2·10⁻⁷ compared with the formula; the formula itself has no total internal
    ///   reflection.
    ///
    /// Schlick 1994, *An Inexpensive BRDF Model for Physically-Based Rendering*, eq. 15.
    #[must_use]
    pub fn reflectance(&self, cos_theta: f32) -> f32 {
        let x = 1.0 - clamp_to(cos_theta, 1.0);
        let x2 = x * x;
        (self.f0 + (1.0 - self.f0) * (x2 * x2 * x)).min(1.0)
    }
}

channels!(Schlick);
