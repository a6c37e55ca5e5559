//! The Oren–Nayar rough diffuse BRDF: full, qualitative, and Fujii's form.

use core::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;

use crate::error::ShadingError;
use crate::math::atan2;
use crate::reflectance::brdf::{Brdf, are_above, finite};
use crate::reflectance::diffuse::rough::{checked, sine, stretched};

/// The formula of an [`OrenNayar`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum OrenNayarVariant {
    /// Direct light and one interreflection between the facets of a cavity:
    ///
    /// ```text
    /// f_r = ρ/π (C₁ + cos Δφ C₂ tan β + (1 − |cos Δφ|) C₃ tan((α+β)/2))
    ///     + 0.17 ρ²/π · σ²/(σ²+0.13) (1 − cos Δφ (2β/π)²)
    /// C₁ = 1 − 0.5 σ²/(σ²+0.33)
    /// C₂ = 0.45 σ²/(σ²+0.09) (sin α,  or for cos Δφ < 0  sin α − (2β/π)³)
    /// C₃ = 0.125 σ²/(σ²+0.09) (4αβ/π²)²
    /// ```
    ///
    /// α and β are the larger and the smaller angle from the normal. Oren, Nayar 1994,
    /// *Generalization of Lambert's Reflectance Model*, eq. 30 and 31.
    #[default]
    Full,
    /// The two largest terms, with dark rims where the azimuths differ, and no color shift.
    ///
    /// ```text
    /// f_r = ρ/π (A + B max(0, cos Δφ) sin α tan β),   A = C₁,   B = 0.45 σ²/(σ²+0.09)
    /// ```
    ///
    /// Oren, Nayar 1994, §4.4.
    Qualitative,
    /// Fujii's form without the crease and the dark ring of the qualitative form; σ is a weight:
    ///
    /// ```text
    /// f_r = ρ (1 + σ s/t) / (π + (π/2 − 2/3) σ),   s = ωi·ωo − cos θ_i cos θ_o,
    /// t = max(cos θ_i, cos θ_o) for s > 0, else 1
    /// ```
    ///
    /// Fujii 2012, *A tiny improvement of Oren-Nayar reflectance model*.
    Fujii,
}

/// The Oren–Nayar rough diffuse BRDF: Lambertian facets, tilted with standard deviation σ.
///
/// - **Domain:** σ in radians for the first two forms, up to π/2; up to 1 for Fujii's.
/// - **Range:** at least 0. The full form is slightly negative for opposite azimuths near the
///   horizon, and is clamped to 0 there. Reciprocal. The first two are unbounded where both
///   directions graze the surface in one azimuth, like `tan β`.
/// - **Energy:** none of the three preserves it. With ρ = 1 they lose up to a quarter (full and
///   Fujii's form, σ = 1) or a third of it straight down. Towards the horizon the albedo of the
///   full form exceeds 1 by up to 5 % (σ = 0.3), and the albedo of the qualitative form by up to
///   1.5 % (σ = 0.2). Fujii's form stays below 1. [`EnergyPreservingOrenNayar`] preserves energy.
/// - **Accuracy:** 8·10⁻⁶ relative to the formulas in directions up to 1.5 rad from the normal.
///
/// [`EnergyPreservingOrenNayar`]: crate::EnergyPreservingOrenNayar
///
/// ```
/// use asperity_shading::reflectance::{OrenNayar, OrenNayarVariant};
/// use asperity_shading::{Brdf, glam::Vec3};
///
/// let clay = OrenNayar::new(Vec3::splat(0.7), 0.5, OrenNayarVariant::Full)?;
/// // Seen from the light, a rough surface is brighter towards its edge than a Lambertian one; not so from the other side.
/// let w = Vec3::new(0.8, 0.0, 0.6);
/// assert!(clay.eval(w, w).x > clay.eval(Vec3::new(-0.8, 0.0, 0.6), w).x);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "oren-nayar")]
#[doc(alias = "fujii")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayar {
    albedo: Vec3,
    sigma: f32,
    form: OrenNayarVariant,
}

impl OrenNayar {
    /// Creates the surface of albedo ρ and roughness σ.
    ///
    /// # Errors
    /// [`ShadingError`] unless every component is within `[0, 1]`, and σ within `[0, π/2]`, for
    /// Fujii's form `[0, 1]`.
    pub fn new(albedo: Vec3, sigma: f32, form: OrenNayarVariant) -> Result<Self, ShadingError> {
        let most = if form == OrenNayarVariant::Fujii { 1.0 } else { 0.5 * PI };
        checked(albedo, sigma, most).map(|(albedo, sigma)| Self { albedo, sigma, form })
    }

    /// The albedo ρ of the facets.
    #[must_use]
    pub const fn albedo(&self) -> Vec3 {
        self.albedo
    }

    /// The roughness σ.
    #[must_use]
    pub const fn sigma(&self) -> f32 {
        self.sigma
    }

    fn full(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        let (low, high) = if wi.z < wo.z { (wi, wo) } else { (wo, wi) };
        let (sin_alpha, sin_beta) = (sine(low), sine(high));
        let (alpha, beta) = (atan2(sin_alpha, low.z), atan2(sin_beta, high.z));
        let product = sin_alpha * sin_beta;
        let cos_phi =
            if product > 0.0 { (wi.truncate().dot(wo.truncate()) / product).clamp(-1.0, 1.0) } else { 0.0 };

        let s2 = self.sigma * self.sigma;
        let rough = s2 / (s2 + 0.09);
        let turned = 2.0 * beta * FRAC_1_PI;
        let c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
        let c2 =
            0.45 * rough * (if cos_phi >= 0.0 { sin_alpha } else { sin_alpha - turned * turned * turned });
        let both = 4.0 * alpha * beta * (FRAC_1_PI * FRAC_1_PI);
        let c3 = 0.125 * rough * (both * both);
        let mean_tangent = (sin_alpha + sin_beta) / (low.z + high.z);
        let direct = c1 + cos_phi * c2 * (sin_beta / high.z) + (1.0 - cos_phi.abs()) * c3 * mean_tangent;
        let again = 0.17 * s2 / (s2 + 0.13) * (1.0 - cos_phi * turned * turned);
        self.albedo * FRAC_1_PI * (Vec3::splat(direct) + self.albedo * again).max(Vec3::ZERO)
    }
}

impl Brdf for OrenNayar {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return Vec3::ZERO;
        }
        let value = match self.form {
            OrenNayarVariant::Full => self.full(wi, wo),
            OrenNayarVariant::Qualitative => {
                let s2 = self.sigma * self.sigma;
                let (a, b) = (1.0 - 0.5 * s2 / (s2 + 0.33), 0.45 * s2 / (s2 + 0.09));
                // sin α tan β cos Δφ = s / max(cos θ_i, cos θ_o).
                self.albedo * (FRAC_1_PI * (a + b * stretched(wi, wo).max(0.0)))
            }
            OrenNayarVariant::Fujii => {
                let scale = 1.0 / (PI + (0.5 * PI - 2.0 / 3.0) * self.sigma);
                self.albedo * (scale * (1.0 + self.sigma * stretched(wi, wo)))
            }
        };
        // Cosines below 1e-38 overflow the ratio.
        Vec3::from_array(value.to_array().map(finite))
    }
}
