//! The Student-t NDF, between GGX and Beckmann and beyond, isotropic and anisotropic.

use core::f64::consts::SQRT_2;

use glam::{Vec2, Vec3};

use crate::coordinates::bounded;
use crate::density::roughness::{Roughness, roughness_accessors};
use crate::density::student_distribution::StudentDistribution;
use crate::density::view_axis::ViewAxis;
use crate::error::{NdfError, in_range};
use crate::microfacet::{Microfacet, VisibleWarp};
use crate::ndf::{Ndf, unit_square};
use crate::radial::Radial;
use crate::serde::written;
use asperity_core::lanes::Scalar;
use asperity_core::lanes::elementary::cos_sin_turns;
use asperity_core::math;

/// The Student-t NDF with the roughnesses `alpha_x`, `alpha_y` and the exponent `gamma`.
///
/// ```text
/// D(m) = (1 + q²/(γ − 1))^(−γ) / (π αx αy mz⁴),   q² = (mx²/αx² + my²/αy²)/mz²          in sr⁻¹
/// T(z): q² = (γ − 1) expm1(ρ²/(2(γ − 1))),  s = (αx z₁, αy z₂) q/ρ,  m = (s_x, s_y, 1)/√(1 + |s|²),  ρ² = z₁² + z₂²
/// Λ(v) = E(z)/z,   z = √2 v_z/√(αx²vx² + αy²vy²),   E(z) = E[max(0, t − z)] for Student's t with 2γ − 2 degrees of freedom
/// ```
///
/// `γ = 2` is GGX, `γ → ∞` is Beckmann, and `γ = n/2 + 2` with `α² = 2/(n + 2)` is Blinn–Phong's
/// `cosⁿ θ`. Smaller `γ` has longer tails than GGX.
///
/// - **Domain:** `αx, αy` in [`MIN_ALPHA`](Self::MIN_ALPHA)`..=`[`MAX_ALPHA`](Self::MAX_ALPHA),
///   `γ` in [`MIN_GAMMA`](Self::MIN_GAMMA)`..=` [`MAX_GAMMA`](Self::MAX_GAMMA); unit `m`, only its
///   slope matters; `D = 0` for `m.z ≤ 0` and NaN. For `γ < 2` the density is unbounded at the
///   horizon, where it is clamped to `f32::MAX`. Normals have `m.z ≥ 2⁻¹²⁶`.
/// - **Visible normals:** the slope along the view by inversion of its distribution, to 1e-12 in
///   `u`. The slope across it by the quantile of Student's t, its conditional distribution. `u`
///   below 2⁻³² is read as 2⁻³².
/// - **Accuracy:** `D` 1e-6 + 5e-7 a relative, with the exponent `a = γ ln(1 + q²/(γ − 1))`; Λ 1e-6
///   relative.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, StudentT, glam::Vec3};
///
/// let (student, ggx) = (StudentT::new(0.2, 0.4, 2.0)?, Ggx::new(0.2, 0.4)?);
/// let m = Vec3::new(0.3, -0.2, 0.93).normalize();
/// assert!((student.d(m) / ggx.d(m) - 1.0).abs() < 1e-5);
/// assert!(StudentT::new(0.2, 0.4, 1.5).is_err());
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Ribardière et al. 2017, "STD: Student's t-Distribution of Slopes for Microfacet Based BSDFs",
/// eq. 12 for `D`. Their Λ approximates the integral by a rational function; here it is exact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "std")]
#[doc(alias = "gtr")]
pub struct StudentT {
    alpha: Roughness,
    gamma: f32,
    /// The slopes along a direction, in units of α/√2.
    along: StudentDistribution,
    /// The slopes across a direction, given the slopes along it.
    across: StudentDistribution,
}

roughness_accessors!(StudentT);
written!(StudentT, |density| {
    alpha_x: density.alpha.x,
    alpha_y: density.alpha.y,
    gamma: density.gamma
});
#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; StudentT: density => density.alpha.x, density.alpha.y, density.gamma; }

impl StudentT {
    /// The smallest exponent; at 3/2 the projected area of the facets diverges.
    pub const MIN_GAMMA: f32 = 1.51;

    /// The largest exponent; above 10⁷ the NDF is Beckmann within the rounding of `f32`.
    pub const MAX_GAMMA: f32 = 1e12;

    /// Creates the NDF with the roughnesses `alpha_x` and `alpha_y` and the exponent `gamma`.
    ///
    /// # Errors
    /// A roughness that is invalid in [`Ggx::new`](crate::Ggx::new); an exponent that is not finite
    /// or out of range. The error contains the name and the value of the parameter.
    pub fn new(alpha_x: f32, alpha_y: f32, gamma: f32) -> Result<Self, NdfError> {
        let alpha = Roughness::new(alpha_x, alpha_y)?;
        in_range("gamma", gamma, [Self::MIN_GAMMA, Self::MAX_GAMMA]).map(|gamma| Self::with(alpha, gamma))
    }

    /// Creates the NDF with clamped parameters; a NaN roughness becomes 1, a NaN exponent 2.
    #[must_use]
    pub fn new_clamped(alpha_x: f32, alpha_y: f32, gamma: f32) -> Self {
        let gamma = if gamma.is_nan() { 2.0 } else { gamma.clamp(Self::MIN_GAMMA, Self::MAX_GAMMA) };
        Self::with(Roughness::new_clamped(alpha_x, alpha_y), gamma)
    }

    fn with(alpha: Roughness, gamma: f32) -> Self {
        let freedom = 2.0 * f64::from(gamma) - 2.0;
        Self {
            alpha,
            gamma,
            along: StudentDistribution::new(freedom),
            across: StudentDistribution::new(freedom + 1.0),
        }
    }

    /// The exponent γ.
    #[inline]
    #[must_use]
    pub const fn gamma(self) -> f32 {
        self.gamma
    }

    /// The normal in the stretched space with the azimuth of `z`, which is in standard deviations.
    ///
    /// The fraction `exp(−|z|²/2)` of the normals is tilted more.
    fn tilted(self, z: Vec2) -> Vec3 {
        let scale = self.gamma - 1.0;
        let rho2 = z.x * z.x + z.y * z.y;
        let t = 0.5 * rho2 / scale;
        // √(expm1(t) (γ−1)/ρ²) times exp(−t/2), which does not overflow.
        let per_rho = math::sqrt(if t < 1e-7 { 0.5 } else { -math::exp_m1(-t) * scale / rho2 });
        let up = math::exp(-0.5 * t).max(f32::MIN_POSITIVE);
        let m = self.alpha.normal(z.x * per_rho, z.y * per_rho, up);
        Vec3::new(m.x, m.y, m.z.max(f32::MIN_POSITIVE))
    }

    /// The degrees of freedom of the slopes along a direction.
    fn freedom(self) -> f64 {
        2.0 * f64::from(self.gamma) - 2.0
    }

    /// The normal with these slopes along and across a view, in standard deviations of Beckmann.
    fn sloped(self, axis: ViewAxis, along: f64, across: f64) -> Vec3 {
        // Proportional to the slope along the view, whether that is clamped or not.
        let [x, y] = axis.to_surface(along, across.clamp(-1e40 * STEEPEST, 1e40 * STEEPEST));
        let (x, y) = (x * f64::from(self.alpha.x), y * f64::from(self.alpha.y));
        let up = 1.0 / math::sqrt_f64(0.5 * (x * x + y * y) + 1.0);
        let (x, y) = (x * up / SQRT_2, y * up / SQRT_2);
        Vec3::new(x as f32, y as f32, (up as f32).max(f32::MIN_POSITIVE))
    }
}

impl Ndf for StudentT {
    fn d(&self, m: Vec3) -> f32 {
        let [x, y, z] = m.to_array().map(f64::from);
        let (ax, ay, gamma) = (f64::from(self.alpha.x), f64::from(self.alpha.y), f64::from(self.gamma));
        let q2 = ((x / ax) * (x / ax) + (y / ay) * (y / ay)) / (z * z);
        let exponent = gamma * math::ln_1p_f64(q2 / (gamma - 1.0)) + 4.0 * math::ln_f64(z);
        let density = math::exp_f64(-exponent) / (core::f64::consts::PI * ax * ay);
        if z > 0.0 && density >= 0.0 { density.min(f64::from(f32::MAX)) as f32 } else { 0.0 }
    }

    #[inline]
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        self.tilted(bounded(z))
    }

    fn invert(&self, m: Vec3) -> Vec2 {
        let up = m.z.max(f32::MIN_POSITIVE);
        let q = Vec2::new(m.x / self.alpha.x / up, m.y / self.alpha.y / up);
        let (x, y) = (f64::from(q.x), f64::from(q.y));
        let (q2, scale) = (x * x + y * y, f64::from(self.gamma) - 1.0);
        let per_length = if q2 < 1e-14 * scale {
            SQRT_2
        } else {
            math::sqrt_f64(2.0 * scale * math::ln_1p_f64(q2 / scale) / q2)
        };
        bounded(Vec2::new((x * per_length) as f32, (y * per_length) as f32))
    }

    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        let u = unit_square(u);
        self.tilted(Vec2::from(cos_sin_turns(Scalar, u.y)) * math::sqrt(-2.0 * math::ln_1p(-u.x)))
    }
}

impl Microfacet for StudentT {
    fn lambda(&self, v: Vec3) -> f32 {
        self.alpha.lambda(v, |z| self.along.excess(z))
    }

    fn projected_area(&self, v: Vec3) -> f32 {
        self.alpha.projected_area(v, |z| self.along.excess(z))
    }

    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        let (u, axis) = (unit_square(u), ViewAxis::new(self.alpha, v));
        let along = self.along.visible_slope(axis.cotangent, f64::from(u.x)).clamp(-STEEPEST, STEEPEST);
        let freedom = self.freedom();
        let spread = math::sqrt_f64((freedom + along * along) / (freedom + 1.0));
        self.sloped(axis, along, self.across.quantile(f64::from(u.y)) * spread)
    }
}

/// The slope along the view by the quantile of its seen distribution. The slope across is scaled by
/// the width of its conditional distribution, which the view does not change.
///
/// ```text
/// t = √2 s/α, along and across the view;   (t₁, t₂) of T(z);   ν = 2γ − 2
/// T_v(z): t₁′ = Q(F(t₁)),  t₂′ = t₂ √((ν + t₁′²)/(ν + t₁²));   F: all slopes, Q: quantile of the seen ones
/// ```
///
/// Accuracy: `T_v⁻¹(T_v(z)) = z` within 2e-6 for `|z| ≤ 4` and views up to 89.95° from the normal.
impl VisibleWarp for StudentT {
    fn warp_visible(&self, v: Vec3, z: Vec2) -> Vec3 {
        let (axis, z, freedom) = (ViewAxis::new(self.alpha, v), bounded(z), self.freedom());
        let [x, y] = axis.to_view(f64::from(z.x), f64::from(z.y));
        let t = (x * x + y * y) / freedom;
        let per_rho = if t < 1e-14 { 1.0 } else { math::sqrt_f64(math::exp_m1_f64(t) / t) };
        let (x, y) = (x * per_rho, y * per_rho);
        let along = self.along.visible_of_slope(axis.cotangent, x).clamp(-STEEPEST, STEEPEST);
        let widening = math::sqrt_f64((freedom + along * along) / (freedom + x * x));
        self.sloped(axis, along, y * widening)
    }

    fn invert_visible(&self, v: Vec3, m: Vec3) -> Vec2 {
        let (axis, freedom) = (ViewAxis::new(self.alpha, v), self.freedom());
        let up = SQRT_2 / f64::from(m.z.max(f32::MIN_POSITIVE));
        let (x, y) = (f64::from(m.x / self.alpha.x) * up, f64::from(m.y / self.alpha.y) * up);
        let [along, across] = axis.to_view(x, y);
        let x = self.along.slope_of_visible(axis.cotangent, along).clamp(-STEEPEST, STEEPEST);
        let y = across * math::sqrt_f64((freedom + x * x) / (freedom + along * along));
        let t = (x * x + y * y) / freedom;
        let per_length = if t < 1e-14 { 1.0 } else { math::sqrt_f64(math::ln_1p_f64(t) / t) };
        let [x, y] = axis.to_surface(x * per_length, y * per_length);
        bounded(Vec2::new(x as f32, y as f32))
    }
}

impl Radial for StudentT {
    fn exponent(&self, slope: f64) -> Option<f64> {
        let (t, scale) = (slope / f64::from(self.alpha.x), f64::from(self.gamma) - 1.0);
        (self.alpha.x == self.alpha.y).then(|| scale * math::ln_1p_f64(t * t / scale))
    }
}

/// The steepest slope over the roughness, at the horizon in `f32`.
///
/// With the smallest γ some are greater, and their squares leave the range of `f64`.
const STEEPEST: f64 = 1e100;

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn visible_normals_of_the_heaviest_tail_are_unit() {
        let ends = [0.0, f32::from_bits(1), 0.5, 1.0_f32.next_down(), 1.0];
        for (alpha, gamma) in [(1e-6, 1.51), (0.3, 1.51), (1e6, 1.51), (1e6, 1.6)] {
            let facets = StudentT::new(alpha, alpha, gamma).unwrap();
            for v in [Vec3::NEG_X, Vec3::Y, Vec3::new(0.6, 0.0, 0.8), Vec3::Z] {
                for u in ends.iter().flat_map(|&x| ends.map(|y| Vec2::new(x, y))) {
                    let m = facets.sample_visible(v, u);
                    assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-5, "{facets:?} {v} {u}: {m}");
                }
            }
        }
    }
    use crate::{Beckmann, Ggx};

    #[test]
    fn special_cases_are_ggx_and_beckmann() {
        let (ggx, beckmann) = (Ggx::new(0.2, 0.4).unwrap(), Beckmann::new(0.2, 0.4).unwrap());
        for (gamma, other) in [(2.0, &ggx as &dyn Microfacet), (1e10, &beckmann)] {
            let student = StudentT::new(0.2, 0.4, gamma).unwrap();
            for z in [Vec2::new(0.7, -1.2), Vec2::ZERO, Vec2::new(-3.0, 0.1)] {
                let (m, v) = (other.warp_gaussian(z), Vec3::new(z.y, z.x, 0.8).normalize());
                assert_abs_diff_eq!(student.warp_gaussian(z), m, epsilon = 1e-6);
                assert_abs_diff_eq!(student.invert(m), z, epsilon = 4e-6);
                assert_abs_diff_eq!(student.d(m) / other.d(m), 1.0, epsilon = 5e-6, "{gamma} {z}");
                let lambda = other.lambda(v);
                assert_abs_diff_eq!(student.lambda(v), lambda, epsilon = 2e-6 * lambda, "{gamma} {z}");
                let [area, expected] = [student.projected_area(v), other.projected_area(v)];
                assert_abs_diff_eq!(area / expected, 1.0, epsilon = 1e-6, "{gamma} {z}");
                let u = Vec2::new(0.3, 0.8);
                assert_abs_diff_eq!(student.sample(u), other.sample(u), epsilon = 1e-6, "{gamma}");
            }
        }
        let v = Vec3::new(-0.8, 0.3, 0.2);
        let student = StudentT::new(0.2, 0.4, 1e10).unwrap();
        let [a, b] =
            [&student as &dyn Microfacet, &beckmann].map(|ndf| ndf.sample_visible(v, Vec2::new(0.3, 0.8)));
        assert_abs_diff_eq!(a, b, epsilon = 1e-6);
    }
}
