//! Exact Fresnel reflectance of a conductor, unpolarized.

use glam::Vec3;

use crate::error::ShadingError;
use crate::math::{clamp_to, sqrt};
use crate::parameter::{not_negative, positive};
use crate::reflectance::fresnel::interface::{Fresnel, channels, reflectance_or_mirror};

/// A smooth metal surface with the complex refractive index `η + i k` relative to the incident
/// side.
///
/// The index depends on the wavelength. A colored metal is three of these, one for each channel.
///
/// ```
/// use asperity_shading::Conductor;
///
/// let silver = Conductor::new(0.2, 3.0)?;
/// assert!(silver.reflectance(1.0) > 0.9);
/// // Without absorption it is the dielectric.
/// assert!((Conductor::new(1.5, 0.0)?.reflectance(1.0) - 0.04).abs() < 1e-7);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "metal")]
#[doc(alias = "complex ior")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    eta: f32,
    k: f32,
}

impl Conductor {
    /// Creates the metal of index `eta` and extinction coefficient `k`.
    ///
    /// Both are relative to the index of the incident side.
    ///
    /// # Errors
    /// [`ShadingError`] unless `eta` is finite and positive, and `k` finite and not negative.
    pub fn new(eta: f32, k: f32) -> Result<Self, ShadingError> {
        Ok(Self { eta: positive("eta", eta)?, k: not_negative("k", k)? })
    }

    /// The index `η`, dimensionless.
    #[must_use]
    pub const fn eta(&self) -> f32 {
        self.eta
    }

    /// The extinction coefficient `k`, dimensionless.
    #[must_use]
    pub const fn k(&self) -> f32 {
        self.k
    }

    /// The reflectance for unpolarized light.
    ///
    /// ```text
    /// a + i b = √((η + i k)² − sin² θ),   c = cos θ
    /// R_s = ((a − c)² + b²) / ((a + c)² + b²)
    /// R_p = R_s ((a c − sin² θ)² + b² c²) / ((a c + sin² θ)² + b² c²)
    /// F = ½ (R_s + R_p)
    /// ```
    ///
    /// - **Domain:** `cos_theta` is clamped to `[0, 1]`; NaN is read as 0, the horizon.
    /// - **Range:** `[0, 1]`, dimensionless; 1 at the horizon, and 0 everywhere for the index 1
    ///   without absorption.
    /// - **Accuracy:** 3·10⁻⁷ against 20-digit references.
    ///
    /// Born and Wolf, *Principles of Optics*, §13.2 (absorbing media), in the form without complex
    /// numbers.
    #[must_use]
    pub fn reflectance(&self, cos_theta: f32) -> f32 {
        let Self { eta, k } = *self;
        if eta == 1.0 && k == 0.0 {
            return 0.0;
        }
        let c = clamp_to(cos_theta, 1.0);
        let sin_squared = 1.0 - c * c;
        let real = (eta - k) * (eta + k) - sin_squared;
        let half_imaginary = eta * k;
        let modulus = sqrt(real * real + 4.0 * half_imaginary * half_imaginary);
        // Of a² = (|w| + Re w)/2 and b² = (|w| − Re w)/2 one cancels; it follows from a b = Im w /
        // 2.
        let large = 0.5 * (modulus + real.abs());
        let small = if large > 0.0 { half_imaginary * half_imaginary / large } else { 0.0 };
        let (a_squared, b_squared) = if real >= 0.0 { (large, small) } else { (small, large) };
        let a = sqrt(a_squared);
        let r_s = ((a - c) * (a - c) + b_squared) / ((a + c) * (a + c) + b_squared);
        let (minus, plus, rest) = (a * c - sin_squared, a * c + sin_squared, b_squared * c * c);
        let r_p = r_s * ((minus * minus + rest) / (plus * plus + rest));
        reflectance_or_mirror(0.5 * (r_s + r_p))
    }
}

channels!(Conductor);
