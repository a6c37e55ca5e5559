//! The Beckmann normal density, isotropic and anisotropic, in closed form.

use core::f32::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

use glam::{Vec2, Vec3};

use crate::math;
use crate::ndf::{Ndf, bounded};
use crate::roughness::{self, RoughnessError};

/// The Beckmann normal density with the roughnesses `alpha_x`, `alpha_y`.
///
/// ```text
/// D(m) = exp(−(mx²/αx² + my²/αy²)/mz²) / (π αx αy mz⁴)                              in sr⁻¹
/// T(z): s = (αx z₁, αy z₂)/√2,  m = (s_x, s_y, 1)/√(1 + |s|²);     T⁻¹: z = √2 (s_x/αx, s_y/αy)
/// ```
///
/// Its slopes are Gaussian with the variances `αx²/2`, `αy²/2`, so `T` is linear in the slopes.
///
/// - **Domain:** `αx, αy` in [`MIN_ALPHA`](crate::MIN_ALPHA)`..=`[`MAX_ALPHA`](crate::MAX_ALPHA); unit `m`, used as given;
///   `D = 0` for `m.z ≤ 0` and NaN.
/// - **Sign:** `s` is the slope of the normal, `s_x = m_x/m_z`; the height falls where it is positive.
/// - **Accuracy:** `D` 1e-6 + 5e-7 a relative, with the exponent `a`. `T⁻¹(T(z)) = z` within 4e-6 for `|z| ≤ 6` and roughness
///   1e-4 to 1.
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, Ndf, glam::Vec3};
///
/// let beckmann = Beckmann::isotropic(0.3)?;
/// assert!((beckmann.density(Vec3::Z) - 1.0 / (core::f32::consts::PI * 0.09)).abs() < 1e-5);
/// assert!(Beckmann::new(0.3, 0.0).is_err());
/// # Ok::<(), asperity_ndf_sampling::RoughnessError>(())
/// ```
///
/// Walter et al. 2007, eq. 25, in its anisotropic form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beckmann {
    alpha_x: f32,
    alpha_y: f32,
}

impl Beckmann {
    /// The density with the roughnesses `alpha_x` and `alpha_y`.
    ///
    /// # Errors
    /// A roughness that is not finite, not positive or out of range; the error names it and its value.
    #[inline]
    pub fn new(alpha_x: f32, alpha_y: f32) -> Result<Self, RoughnessError> {
        let [alpha_x, alpha_y] = roughness::check_both(alpha_x, alpha_y)?;
        Ok(Self { alpha_x, alpha_y })
    }

    /// The isotropic density with the roughness `alpha`.
    ///
    /// # Errors
    /// As [`Beckmann::new`]; the error names `alpha_x`.
    #[inline]
    pub fn isotropic(alpha: f32) -> Result<Self, RoughnessError> {
        Self::new(alpha, alpha)
    }

    /// The density with each roughness moved to the nearest valid one; NaN becomes 1.
    #[inline]
    #[must_use]
    pub fn clamped(alpha_x: f32, alpha_y: f32) -> Self {
        Self { alpha_x: roughness::clamp(alpha_x), alpha_y: roughness::clamp(alpha_y) }
    }

    /// The roughness along x.
    #[inline]
    #[must_use]
    pub const fn alpha_x(self) -> f32 {
        self.alpha_x
    }

    /// The roughness along y.
    #[inline]
    #[must_use]
    pub const fn alpha_y(self) -> f32 {
        self.alpha_y
    }
}

impl Ndf for Beckmann {
    #[inline]
    fn density(&self, m: Vec3) -> f32 {
        let (x, y) = (m.x / (self.alpha_x * m.z), m.y / (self.alpha_y * m.z));
        let falloff = math::exp(-(x * x + y * y));
        // At the horizon the exponential is 0 long before mz⁴ underflows; without the test it would be 0/0.
        if m.z > 0.0 && falloff > 0.0 {
            let z2 = m.z * m.z;
            (falloff / (PI * self.alpha_x * self.alpha_y * z2 * z2)).min(f32::MAX)
        } else {
            0.0
        }
    }

    #[inline]
    fn from_gaussian(&self, z: Vec2) -> Vec3 {
        let z = bounded(z);
        let (x, y) = (self.alpha_x * z.x * FRAC_1_SQRT_2, self.alpha_y * z.y * FRAC_1_SQRT_2);
        let up = 1.0 / math::sqrt(x * x + y * y + 1.0);
        Vec3::new(x * up, y * up, up)
    }

    #[inline]
    fn to_gaussian(&self, m: Vec3) -> Vec2 {
        let up = m.z.max(f32::MIN_POSITIVE);
        let z = Vec2::new(m.x / (self.alpha_x * up), m.y / (self.alpha_y * up)) * SQRT_2;
        bounded(z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_normal_is_the_origin() {
        let beckmann = Beckmann::new(0.2, 0.4).unwrap();
        assert_eq!(beckmann.from_gaussian(Vec2::ZERO), Vec3::Z);
        assert_eq!(beckmann.to_gaussian(Vec3::Z), Vec2::ZERO);
    }

    #[test]
    fn total_on_every_input() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1.0];
        for alpha in [roughness::MIN_ALPHA, 1e-4, 1.0, roughness::MAX_ALPHA] {
            let beckmann = Beckmann::isotropic(alpha).unwrap();
            for (x, y) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))) {
                let m = beckmann.from_gaussian(Vec2::new(x, y));
                assert!((m.length() - 1.0).abs() < 1e-6 && m.z > 0.0, "{alpha} {x} {y}: {m}");
                for z in bad {
                    let m = Vec3::new(x, y, z);
                    assert!(beckmann.density(m).is_finite() && beckmann.density(m) >= 0.0, "{alpha}: {m}");
                    assert!(beckmann.to_gaussian(m).is_finite(), "{alpha}: {m}");
                }
            }
        }
    }

    #[test]
    fn below_the_horizon_is_zero() {
        let beckmann = Beckmann::isotropic(0.5).unwrap();
        assert_eq!(beckmann.density(Vec3::NEG_Z), 0.0);
        assert_eq!(beckmann.density(Vec3::X), 0.0);
        assert_eq!(beckmann.density(Vec3::NAN), 0.0);
        // Just above it, where exp and mz⁴ both underflow.
        for z in [1e-3, 1e-9, 1e-20, 1e-40] {
            assert_eq!(beckmann.density(Vec3::new(1.0, 0.0, z)), 0.0, "{z}");
        }
    }
}
