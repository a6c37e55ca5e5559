//! The GGX (Trowbridge–Reitz) normal density, isotropic and anisotropic, in closed form.

use core::f32::consts::{PI, SQRT_2};

use glam::{Vec2, Vec3};

use crate::math;
use crate::microfacet::{Microfacet, above, unit_square};
use crate::ndf::{Ndf, bounded};
use crate::roughness::{Roughness, roughness_parameters};
use crate::turn::turn;

/// The GGX normal density with the roughnesses `alpha_x`, `alpha_y`.
///
/// ```text
/// D(m) = 1 / (π αx αy (mx²/αx² + my²/αy² + mz²)²)                                  in sr⁻¹
/// T(z): s = (αx z₁, αy z₂) · √(expm1(ρ²/2)/ρ²),  ρ² = z₁² + z₂²,  m = (s_x, s_y, 1)/√(1 + |s|²)
/// T⁻¹:  ρ² = 2 ln(1 + (s_x/αx)² + (s_y/αy)²),  direction of (s_x/αx, s_y/αy)
/// ```
///
/// - **Domain:** `αx, αy` in [`MIN_ALPHA`](crate::MIN_ALPHA)`..=`[`MAX_ALPHA`](crate::MAX_ALPHA); unit `m`, used as given;
///   `D = 0` for `m.z ≤ 0` and NaN.
/// - **Sign:** `s` is the slope of the normal, `s_x = m_x/m_z`; the height falls where it is positive.
/// - **Accuracy:** `D` 1e-6 relative to the exact value of the `f32` input. `T⁻¹(T(z)) = z` within 4e-6 for `|z| ≤ 6` and
///   roughness 1e-4 to 1.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, glam::Vec3};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// assert!((ggx.density(Vec3::Z) - 1.0 / (core::f32::consts::PI * 0.08)).abs() < 1e-5);
/// assert!(Ggx::new(f32::NAN, 0.4).is_err());
/// # Ok::<(), asperity_ndf_sampling::RoughnessError>(())
/// ```
///
/// Walter et al. 2007, eq. 33; anisotropic form Burley 2012, eq. 13. The map is the radial Gaussian map of that slope density:
/// `P(|s/α| ≤ t) = t²/(1 + t²) = 1 − exp(−ρ²/2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    pub(crate) alpha: Roughness,
}

roughness_parameters!(Ggx);

impl Ndf for Ggx {
    #[inline]
    fn density(&self, m: Vec3) -> f32 {
        let (x, y) = (m.x / self.alpha.x, m.y / self.alpha.y);
        let t = x * x + y * y + m.z * m.z;
        if m.z > 0.0 && t.is_finite() {
            (1.0 / (PI * self.alpha.x * self.alpha.y * t * t)).min(f32::MAX)
        } else {
            0.0
        }
    }

    #[inline]
    fn from_gaussian(&self, z: Vec2) -> Vec3 {
        let z = bounded(z);
        let rho2 = z.x * z.x + z.y * z.y;
        // The formula times exp(−ρ²/4): expm1 overflows beyond ρ² = 177, this form does not.
        let scale = if rho2 < 1e-10 { 1.0 / SQRT_2 } else { math::sqrt(-math::exp_m1(-0.5 * rho2) / rho2) };
        let (x, y) = (self.alpha.x * z.x * scale, self.alpha.y * z.y * scale);
        let up = math::exp(-0.25 * rho2);
        let length = math::sqrt(x * x + y * y + up * up);
        Vec3::new(x / length, y / length, up / length)
    }

    #[inline]
    fn to_gaussian(&self, m: Vec3) -> Vec2 {
        let (x, y) = (m.x / self.alpha.x, m.y / self.alpha.y);
        let q = math::sqrt(x * x + y * y);
        let t = (q / m.z.max(f32::MIN_POSITIVE)).min(f32::MAX);
        // Beyond 10⁹ the 1 in ln(1 + t²) is below half an ulp, and beyond 10¹⁹ t² overflows.
        let rho2 = if t < 1e9 { 2.0 * math::ln_1p(t * t) } else { 4.0 * math::ln(t) };
        let per_length = if t < 1e-5 { t * SQRT_2 / q } else { math::sqrt(rho2) / q };
        // The flat normal and NaN are 0/0 here, which is read as 0.
        bounded(Vec2::new(x * per_length, y * per_length))
    }

    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        let u = unit_square(u);
        let q = turn(u.y) * math::sqrt(u.x);
        self.alpha.normal(q.x, q.y, math::sqrt(1.0 - u.x))
    }
}

impl Microfacet for Ggx {
    #[inline]
    fn lambda(&self, v: Vec3) -> f32 {
        let (x, y) = (self.alpha.x * v.x / v.z, self.alpha.y * v.y / v.z);
        let t = x * x + y * y;
        // (√(1 + t) − 1)/2 without the difference.
        let lambda = 0.5 * t / (1.0 + math::sqrt(1.0 + t));
        if v.z > 0.0 && lambda.is_finite() { lambda } else { f32::INFINITY }
    }

    #[inline]
    fn projected_area(&self, v: Vec3) -> f32 {
        let w = self.alpha.stretch(above(v));
        0.5 * (w.z + math::sqrt(w.x * w.x + w.y * w.y + w.z * w.z))
    }

    #[inline]
    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        let u = unit_square(u);
        let w = self.alpha.stretch(above(v)).try_normalize().unwrap_or(Vec3::Z);
        // The cap of directions c with c.z ≥ −w.z, uniform: c.z = (1 − u₂)(1 + w.z) − w.z, in forms that keep sin θ.
        let (below, above) = (u.y * (1.0 + w.z), (1.0 - u.y) * (1.0 + w.z));
        let sin = math::sqrt(below * (2.0 - below).max(0.0));
        let c = turn(u.x) * sin;
        self.alpha.normal(c.x + w.x, c.y + w.y, above)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::roughness::{MAX_ALPHA, MIN_ALPHA};

    #[test]
    fn flat_normal_is_the_origin() {
        let ggx = Ggx::new(0.2, 0.4).unwrap();
        assert_eq!(ggx.from_gaussian(Vec2::ZERO), Vec3::Z);
        assert_eq!(ggx.to_gaussian(Vec3::Z), Vec2::ZERO);
    }

    #[test]
    fn small_roughness_keeps_its_slopes() {
        let m = Ggx::isotropic(1e-4).unwrap().from_gaussian(Vec2::new(0.01, -0.02));
        assert!((m.x / 7.071e-7 - 1.0).abs() < 1e-3 && (m.y / -1.4142e-6 - 1.0).abs() < 1e-3, "{m}");
    }

    #[test]
    fn far_tail_is_inverted_to_the_bound() {
        let ggx = Ggx::new(0.3, 1.0).unwrap();
        for k in 1..=48 {
            let z = Vec2::new(0.6, -0.8) * (k as f32 * 0.25);
            assert!(ggx.to_gaussian(ggx.from_gaussian(z)).abs_diff_eq(z, 4e-6), "{z}");
        }
    }

    #[test]
    fn total_on_every_input() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, 1e-40, 1e38, -1.0];
        for alpha in [MIN_ALPHA, 1e-4, 1.0, MAX_ALPHA] {
            let ggx = Ggx::isotropic(alpha).unwrap();
            for (x, y) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))) {
                let m = ggx.from_gaussian(Vec2::new(x, y));
                assert!((m.length() - 1.0).abs() < 1e-6 && m.z > 0.0, "{alpha} {x} {y}: {m}");
                for z in bad {
                    let m = Vec3::new(x, y, z);
                    assert!(ggx.density(m).is_finite() && ggx.density(m) >= 0.0, "{alpha}: {m}");
                    assert!(ggx.to_gaussian(m).is_finite(), "{alpha}: {m}");
                }
            }
        }
    }

    #[test]
    fn below_the_horizon_is_zero() {
        let ggx = Ggx::isotropic(0.5).unwrap();
        assert_eq!(ggx.density(Vec3::NEG_Z), 0.0);
        assert_eq!(ggx.density(Vec3::X), 0.0);
        assert_eq!(ggx.density(Vec3::NAN), 0.0);
    }
}
