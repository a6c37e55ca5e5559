//! The energy-preserving rough diffuse BRDF (EON).

use core::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;

use crate::error::ShadingError;
use crate::math::{atan2, clamp_to};
use crate::reflectance::brdf::{Brdf, are_above, finite};
use crate::reflectance::diffuse::rough::{checked, sine, stretched};

/// A rough diffuse BRDF that preserves energy: light that hits other facets leaves eventually.
///
/// ```text
/// f_r  = ρ/π A (1 + r s/t)  +  ρ_ms/π A r (k − G(θ_i)/π) (k − G(θ_o)/π) / (k − k̄)
/// A    = 1 / (1 + k r),   k = 1/2 − 2/(3π),   k̄ = 2/3 − 28/(15π)
/// ρ_ms = ρ² Ē / (1 − ρ (1 − Ē)),   Ē = A (1 + k̄ r)
/// G(θ) = sin θ (θ − sin θ cos θ) + 2/3 (sin θ cos θ (1 + sin θ + sin² θ)/(1 + sin θ) − sin θ)
/// s, t as in Fujii's form
/// ```
///
/// - **Domain:** roughness r within `[0, 1]`; 0 is Lambertian.
/// - **Range:** at least 0. Reciprocal.
/// - **Energy:** the albedo for ρ = 1 is 1 from every direction; measured within the error of a
///   quadrature, 2·10⁻⁵.
/// - **Accuracy:** 10⁻⁶ relative to the formula in directions up to 1.5 rad from the normal.
///
/// Portsmouth, Kutz, Hill 2024, *EON: A practical energy-preserving rough diffuse BRDF*, eq. 12–19.
/// The source divides `(1 − E(θ_i)) (1 − E(θ_o))` by `1 − Ē`, which is 0/0 for r = 0. Here `A r` is
/// cancelled from all three, and `G` has no `1/cos θ`.
///
/// ```
/// use asperity_shading::{Brdf, EnergyPreservingOrenNayar, glam::Vec3};
///
/// let white = EnergyPreservingOrenNayar::new(Vec3::ONE, 1.0)?;
/// let (wi, wo) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -0.8, 0.6));
/// assert_eq!(white.eval(wo, wi), white.eval(wi, wo));
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "eon")]
#[doc(alias = "oren-nayar")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyPreservingOrenNayar {
    albedo: Vec3,
    roughness: f32,
    /// ρ_ms A r / (π (k − k̄)).
    multiple: Vec3,
}

/// `1/2 − 2/(3π)`.
const K: f32 = 0.5 - 2.0 / (3.0 * PI);

/// `k − k̄ = 1/2 − 2/(3π) − 2/3 + 28/(15π)`.
const K_APART: f32 = 6.0 / (5.0 * PI) - 1.0 / 6.0;

impl EnergyPreservingOrenNayar {
    /// Creates the surface of albedo ρ and roughness r.
    ///
    /// # Errors
    /// [`ShadingError`] unless the roughness and every component of the albedo are within `[0,
    /// 1]`.
    pub fn new(albedo: Vec3, roughness: f32) -> Result<Self, ShadingError> {
        checked(albedo, roughness, 1.0).map(|(albedo, roughness)| Self::of(albedo, roughness))
    }

    fn of(albedo: Vec3, roughness: f32) -> Self {
        let single = 1.0 / (1.0 + K * roughness);
        // 1 − Ē.
        let lost = single * roughness * K_APART;
        let multiple = albedo * albedo * (1.0 - lost) / (Vec3::ONE - albedo * lost)
            * (single * roughness * FRAC_1_PI / K_APART);
        Self { albedo, roughness, multiple }
    }

    /// Creates the surface with clamped albedo and roughness; NaN is read as 0.
    #[must_use]
    pub fn new_clamped(albedo: Vec3, roughness: f32) -> Self {
        let albedo = albedo.map(|c| clamp_to(c, 1.0));
        Self::of(albedo, clamp_to(roughness, 1.0))
    }

    /// The albedo ρ of the facets.
    #[must_use]
    pub const fn albedo(&self) -> Vec3 {
        self.albedo
    }

    /// The roughness r.
    #[must_use]
    pub const fn roughness(&self) -> f32 {
        self.roughness
    }
}

/// `k − G(θ)/π`: the energy missing from single scattering, at least 0.
fn lacking(w: Vec3) -> f32 {
    let s = sine(w);
    let sc = s * w.z;
    let theta = atan2(s, w.z);
    let g = s * (theta - sc) + 2.0 / 3.0 * (sc * (1.0 + s + s * s) / (1.0 + s) - s);
    (K - g * FRAC_1_PI).max(0.0)
}

impl Brdf for EnergyPreservingOrenNayar {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return Vec3::ZERO;
        }
        let single = FRAC_1_PI * (1.0 + self.roughness * stretched(wi, wo)) / (1.0 + K * self.roughness);
        // Cosines below 1e-38 overflow the ratio.
        self.albedo * finite(single) + self.multiple * (lacking(wi) * lacking(wo))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn missing_energy_is_not_negative() {
        // Largest straight down; k − G(π/2)/π = 1/2 − 2/(3π) − (π/2 − 2/3)/π = 0 at the horizon.
        assert_abs_diff_eq!(lacking(Vec3::Z), K, epsilon = 1e-7);
        assert!(lacking(Vec3::X) < 1e-6);
    }
}
