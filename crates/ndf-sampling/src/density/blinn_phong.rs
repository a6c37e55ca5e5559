//! The Blinn–Phong NDF: powers of the cosine.

use crate::density::delegate::delegate_ndf;
use crate::density::roughness::MIN_ALPHA;
use crate::density::student_t::StudentT;
use crate::error::{NdfError, in_range};
use crate::serde::written;
use asperity_core::math;

/// The Blinn–Phong NDF with the exponent `n`.
///
/// ```text
/// D(m) = (n + 2)/(2π) cosⁿ θ                                                       in sr⁻¹
/// T(z): cos θ = exp(−ρ²/(2(n + 2))), direction of z, ρ² = z₁² + z₂²;      α² = 2/(n + 2)
/// ```
///
/// Its slopes have the density `(n + 2)/(2π) (1 + |s|²)^(−n/2−2)`. This is [`StudentT`] with `γ =
/// n/2 + 2` and the roughness `α` above, which computes everything, including masking and visible
/// normals. The exponent 0 is the diffuse lobe `D = 1/π`: projected normals are uniform in the
/// disk, and normals have the density `cos θ/π` over solid angle.
///
/// - **Domain:** `n` in `[0, `[`MAX_EXPONENT`](Self::MAX_EXPONENT)`]`; unit `m`, only its slope
///   matters; `D = 0` for `m.z ≤ 0` and NaN.
/// - **Accuracy:** see [`StudentT`].
///
/// ```
/// use asperity_ndf_sampling::{BlinnPhong, Ndf, glam::Vec3};
///
/// let m = Vec3::new(0.6, 0.0, 0.8);
/// assert!((BlinnPhong::new(3.0)?.d(m) - 5.0 * 0.512 / core::f32::consts::TAU).abs() < 1e-6);
/// assert!((BlinnPhong::new(0.0)?.d(m) - core::f32::consts::FRAC_1_PI).abs() < 1e-6);
/// assert!((BlinnPhong::from_roughness(0.1)?.exponent() - 198.0).abs() < 1e-4);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Blinn 1977; Walter et al. 2007, eq. 30 (`D`) and section 5.3 (`α`). The distribution of the
/// slopes follows from `cos² θ = 1/(1 + |s|²)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "phong")]
#[doc(alias = "cosine power")]
#[doc(alias = "lambert")]
pub struct BlinnPhong {
    exponent: f32,
    facets: StudentT,
}

delegate_ndf!(BlinnPhong, facets, Microfacet, VisibleWarp, Radial);
#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; BlinnPhong: density => density.exponent; }
written!(BlinnPhong, |density| { exponent: density.exponent });

impl BlinnPhong {
    /// The largest exponent, which corresponds to the roughness 1e-6.
    pub const MAX_EXPONENT: f32 = 2e12;

    /// Creates the NDF with the exponent `exponent`.
    ///
    /// # Errors
    /// An exponent that is NaN or out of range. The error contains its name and value.
    pub fn new(exponent: f32) -> Result<Self, NdfError> {
        in_range("exponent", exponent, [0.0, Self::MAX_EXPONENT]).map(Self::with)
    }

    /// Creates the NDF that is as narrow as Beckmann with the roughness `alpha`: `n = 2/α² − 2`.
    ///
    /// # Errors
    /// A roughness that is NaN, below [`MIN_ALPHA`](crate::Beckmann::MIN_ALPHA) or above 1, for
    /// which the exponent would be negative.
    pub fn from_roughness(alpha: f32) -> Result<Self, NdfError> {
        in_range("roughness", alpha, [MIN_ALPHA, 1.0])
            .map(|alpha| Self::with((2.0 / (alpha * alpha) - 2.0).clamp(0.0, Self::MAX_EXPONENT)))
    }

    /// Creates the NDF with the exponent clamped to the valid range; NaN becomes 0.
    #[must_use]
    pub fn new_clamped(exponent: f32) -> Self {
        Self::with(if exponent.is_nan() { 0.0 } else { exponent.clamp(0.0, Self::MAX_EXPONENT) })
    }

    fn with(exponent: f32) -> Self {
        let alpha = roughness(exponent);
        Self { exponent, facets: StudentT::new_clamped(alpha, alpha, 0.5 * exponent + 2.0) }
    }

    /// The exponent `n`.
    #[inline]
    #[must_use]
    pub const fn exponent(self) -> f32 {
        self.exponent
    }

    /// The roughness `α = √(2/(n + 2))`.
    #[inline]
    #[must_use]
    pub fn roughness(self) -> f32 {
        roughness(self.exponent)
    }

    const fn facets(&self) -> &StudentT {
        &self.facets
    }
}

/// `√(2/(n + 2))`.
pub(crate) fn roughness(exponent: f32) -> f32 {
    math::sqrt(2.0 / (exponent + 2.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ggx, Ndf};
    use asperity_core::assert_abs_diff_eq;
    use glam::{Vec2, Vec3};

    #[test]
    fn exponents_and_roughnesses_convert() {
        for alpha in [1.0_f32, 0.5, 0.01, 1e-3, 2e-6] {
            let back = BlinnPhong::from_roughness(alpha).unwrap().roughness();
            assert_abs_diff_eq!(back / alpha, 1.0, epsilon = 1e-6, "{alpha}");
        }
    }

    #[test]
    fn exponent_zero_is_diffuse_and_ggx_of_roughness_one() {
        let (diffuse, ggx) = (BlinnPhong::new(0.0).unwrap(), Ggx::isotropic(1.0).unwrap());
        for z in [Vec2::new(0.7, -1.2), Vec2::ZERO, Vec2::new(-3.0, 0.1)] {
            let m = diffuse.warp_gaussian(z);
            assert_abs_diff_eq!(m, ggx.warp_gaussian(z), epsilon = 1e-6, "{m}");
            assert_abs_diff_eq!(diffuse.d(m) * core::f32::consts::PI, 1.0, epsilon = 1e-6);
        }
        assert_eq!(diffuse.d(Vec3::NEG_Z), 0.0);
    }
}
