//! Fuzz by linearly transformed cosines.

use core::f32::consts::{FRAC_1_PI, PI};

use glam::{Vec2, Vec3};

use crate::error::ShadingError;
use crate::math::{clamp_to, exp, sqrt};
use crate::parameter::{as_roughness, color};
use crate::reflectance::brdf::{Brdf, BsdfSample, are_above, cosine_hemisphere, finite};

/// A layer of fibers with all its bounces, as a linearly transformed cosine lobe.
///
/// ```text
/// f cos θ_i = color R(cos θ_o, α) D(ωi),      D = cos θ_i/π (a/|M⁻¹ωi|²)²
/// M⁻¹ωi = (a x + b z, a y, z)                 in the frame whose x axis is the azimuth of ωo
/// ```
///
/// The fits R, a and b are functions of cos θ_o and α. The color multiplies all light.
///
/// - **Domain:** roughness α within `[0.01, 1]`; the color within `[0, 1]³`.
/// - **Range:** at least 0, finite. Not reciprocal.
/// - **Energy:** the albedo is exactly [`albedo`](Self::albedo), at most the color.
/// - **Accuracy:** 10⁻⁵ relative to the fits.
/// - **Sampling:** from D; the weight of every sample is the albedo.
///
/// Zeltner, Burley, Chiang 2022, *Practical Multiple-Scattering Sheen Using Linearly Transformed
/// Cosines*. The rational fits of its table are those of MaterialX 1.39
/// (`mx_microfacet_sheen.glsl`, Apache-2.0), the default of OpenPBR.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::reflectance::ZeltnerFuzz;
/// use asperity_shading::Brdf;
///
/// let dust = ZeltnerFuzz::new(Vec3::ONE, 0.3)?;
/// assert!(dust.albedo(0.1).x > 3.0 * dust.albedo(1.0).x);
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let sample = dust.sample(wo, 0.5, Vec2::new(0.3, 0.6)).unwrap();
/// assert!((sample.weight() - dust.albedo(wo.z)).length() < 1e-5);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "sheen")]
#[doc(alias = "fuzz")]
#[doc(alias = "cloth")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZeltnerFuzz {
    color: Vec3,
    alpha: f32,
}

impl ZeltnerFuzz {
    /// Creates the layer of this color and roughness.
    ///
    /// # Errors
    /// [`ShadingError`] unless the color is within `[0, 1]³` and the roughness within `[0.01, 1]`.
    pub fn new(color_of_fibers: Vec3, alpha: f32) -> Result<Self, ShadingError> {
        Ok(Self { color: color("color", color_of_fibers)?, alpha: as_roughness("alpha", alpha)? })
    }

    /// The fraction of light that the layer reflects seen at this angle, in each channel.
    ///
    /// The cosine is clamped to `[0, 1]`; NaN is the horizon.
    #[must_use]
    pub fn albedo(&self, cos_theta: f32) -> Vec3 {
        let (x, y) = (clamp_to(cos_theta, 1.0), self.alpha);
        let s = y * (0.020_660_7 + 1.584_91 * y) / (0.037_942_4 + y * (1.322_27 + y));
        let m = y * (-0.193_854 + y * (-1.148_85 + y * (1.793_2 - 0.959_43 * y * y))) / (0.046_391 + y);
        let o = y * (0.000_654_023 + (-0.020_781_8 + 0.119_681 * y) * y) / (1.262_64 + y * (-1.920_21 + y));
        let away = (x - m) / s;
        self.color * clamp_to(exp(-0.5 * away * away) / (s * sqrt(2.0 * PI)) + o, 1.0)
    }

    /// The fraction of light that reaches and leaves the layer beneath: `1 − max albedo`.
    ///
    /// Multiply the BRDF beneath by it.
    #[must_use]
    pub fn transmittance(&self, cos_theta: f32) -> f32 {
        1.0 - self.albedo(cos_theta).max_element()
    }

    /// `a` and `b` of the inverse transform.
    fn transform(&self, cos_theta: f32) -> [f32; 2] {
        let (x, y) = (clamp_to(cos_theta, 1.0), self.alpha);
        let a = (2.581_26 * x + 0.813_703 * y) * y / (1.0 + 0.310_327 * x * x + 2.609_94 * x * y);
        let b = sqrt(1.0 - x) * (y - 1.0) * y * y * y
            / (0.000_025_405_3 + 1.712_28 * x - 1.715_06 * x * y + 1.341_74 * y * y);
        [a, b]
    }

    /// `(a/|M⁻¹ωi|²)²/π`: the density of the lobe over the cosine.
    fn lobe(&self, wo: Vec3, wi: Vec3) -> f32 {
        let [a, b] = self.transform(wo.z);
        let x = azimuth(wo);
        let local = Vec2::new(x.dot(wi.truncate()), x.perp_dot(wi.truncate()));
        let (along, across) = (a * local.x + b * wi.z, a * local.y);
        let ratio = a / (along * along + across * across + wi.z * wi.z);
        finite(ratio * ratio * FRAC_1_PI)
    }
}

/// The direction of `w` in the plane; the x axis for the zenith.
fn azimuth(w: Vec3) -> Vec2 {
    w.truncate().try_normalize().unwrap_or(Vec2::X)
}

impl Brdf for ZeltnerFuzz {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if are_above(wi, wo) { (self.albedo(wo.z) * self.lobe(wo, wi)).map(finite) } else { Vec3::ZERO }
    }

    fn sample(&self, wo: Vec3, _: f32, u: Vec2) -> Option<BsdfSample> {
        let ([a, b], c) = (self.transform(wo.z), cosine_hemisphere(u));
        let [along, across] = [(c.x - b * c.z) / a, c.y / a];
        let x = azimuth(wo);
        let wi = (along * x + across * x.perp()).extend(c.z).normalize();
        BsdfSample::from_direction(self, wo, wi)
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if are_above(wi, wo) { finite(self.lobe(wo, wi) * wi.z) } else { 0.0 }
    }
}
