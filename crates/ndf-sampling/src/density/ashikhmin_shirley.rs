//! The Ashikhmin–Shirley NDF: powers of the cosine that depend on the azimuth.

use core::f64::consts::{FRAC_PI_2, PI};

use glam::{Vec2, Vec3};

use crate::coordinates::bounded;
use crate::density::blinn_phong::{BlinnPhong, roughness};
use crate::density::ggx::Ggx;
use crate::density::roughness::Roughness;
use crate::density::student_distribution::StudentDistribution;
use crate::error::{NdfError, in_range};
use crate::microfacet::{Microfacet, above};
use crate::ndf::{Ndf, unit_square};
use crate::numeric::gauss_kronrod::integrate;
use crate::radial::Radial;
use crate::serde::written;
use asperity_core::SplitMix64;
use asperity_core::lanes::Scalar;
use asperity_core::lanes::elementary::cos_sin_turns;
use asperity_core::math;

/// The Ashikhmin–Shirley NDF with the exponents `n_u` along x and `n_v` along y.
///
/// ```text
/// D(m) = √((nu+2)(nv+2))/(2π) cos^e θ,   e = nu cos² φ + nv sin² φ                            in sr⁻¹
/// T(z): d = (z₁/√(nu+2), z₂/√(nv+2)),  cos θ = exp(−|d|²/2),  direction of d
/// Λ(v) = ∫ max(0, k) ∫_{v_z/k}^∞ (1 + r²)^(−e/2−1) dr dψ/(2π v_z),   k = −(vx cos φ + vy sin φ),  φ the direction of T at ψ
/// ```
///
/// `D` is the original model divided by `4(h·k) max(…)/F` and normalized to `∫ D cos θ dω = 1`,
/// which changes `+ 1` to `+ 2`. With equal exponents it equals [`BlinnPhong`].
///
/// - **Domain:** `nu, nv` in `[0, `[`MAX_EXPONENT`](crate::BlinnPhong::MAX_EXPONENT)`]`; unit `m`,
///   only its slope matters; `D = 0` for `m.z ≤ 0` and NaN.
/// - **Λ:** the inner integral exactly, by Student's t. The outer integral by adaptive quadrature
///   of the three parts between the axes and the horizon of `k`, to 1e-6 relative, with about 100
///   nodes in 20 to 40 µs.
/// - **Visible normals:** exact, by rejection. GGX with `α² = 2/(n + 2)` is everywhere at least e/4
///   of this NDF, so its visible normals are drawn until one is accepted. The expected number of
///   tries is 1.5 at the zenith and at most 2.6 at the horizon. After 64 tries, of probability
///   10⁻¹³, the last is accepted. The first try uses `u`, so low-discrepancy points keep a part of
///   their distribution. Later tries hash the bits of `u`.
/// - **Accuracy:** `D` 1e-6 + 5e-7 a relative, with the exponent `a = −e ln cos θ`.
///
/// ```
/// use asperity_ndf_sampling::{AshikhminShirley, BlinnPhong, Ndf, glam::Vec3};
///
/// let m = Vec3::new(0.3, -0.2, 0.93).normalize();
/// let (equal, phong) = (AshikhminShirley::new(50.0, 50.0)?, BlinnPhong::new(50.0)?);
/// assert!((equal.d(m) / phong.d(m) - 1.0).abs() < 1e-5);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Ashikhmin and Shirley 2000, "An Anisotropic Phong BRDF Model", eq. 4. The map is ours. The
/// azimuth of `d` has the density `∝ 1/((nu+2) cos² φ + (nv+2) sin² φ)`, as in their eq. 9 with 2
/// in place of 1. Given the azimuth, `cos^(e+2) θ` is uniform.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "phong")]
pub struct AshikhminShirley {
    n_u: f32,
    n_v: f32,
    /// `√(2/(n + 2))`.
    alpha: Roughness,
}

#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; AshikhminShirley: density => density.n_u, density.n_v; }
written!(AshikhminShirley, |density| { n_u: density.n_u, n_v: density.n_v });

impl AshikhminShirley {
    /// Creates the NDF with the exponents `n_u` and `n_v`.
    ///
    /// # Errors
    /// An exponent that is NaN or out of range. The error contains its name and value.
    pub fn new(n_u: f32, n_v: f32) -> Result<Self, NdfError> {
        let check = |parameter, n| in_range(parameter, n, [0.0, BlinnPhong::MAX_EXPONENT]);
        Ok(Self::with(check("n_u", n_u)?, check("n_v", n_v)?))
    }

    /// Creates the NDF with exponents clamped to the valid range; NaN becomes 0.
    #[must_use]
    pub fn new_clamped(n_u: f32, n_v: f32) -> Self {
        let clamp = |n: f32| if n.is_nan() { 0.0 } else { n.clamp(0.0, BlinnPhong::MAX_EXPONENT) };
        Self::with(clamp(n_u), clamp(n_v))
    }

    fn with(n_u: f32, n_v: f32) -> Self {
        Self { n_u, n_v, alpha: Roughness { x: roughness(n_u), y: roughness(n_v) } }
    }

    /// The exponent along x.
    #[inline]
    #[must_use]
    pub const fn n_u(self) -> f32 {
        self.n_u
    }

    /// The exponent along y.
    #[inline]
    #[must_use]
    pub const fn n_v(self) -> f32 {
        self.n_v
    }

    /// `T` without a bound.
    fn tilted(self, z: Vec2) -> Vec3 {
        const FRAC_1_SQRT_2: f32 = core::f32::consts::FRAC_1_SQRT_2;
        let d = Vec2::new(z.x * self.alpha.x, z.y * self.alpha.y) * FRAC_1_SQRT_2;
        let d2 = d.x * d.x + d.y * d.y;
        // sin θ/|d|, and 1 at the zenith.
        let per_length = if d2 < 1e-7 { 1.0 } else { math::sqrt(-math::exp_m1(-d2) / d2) };
        Vec3::new(d.x * per_length, d.y * per_length, math::exp(-0.5 * d2).max(f32::MIN_POSITIVE))
    }

    /// `v_z Λ(v)`: the projected area of the back-facing facets.
    fn hidden(self, v: Vec3) -> f64 {
        let [nu, nv] = [self.n_u, self.n_v].map(|n| f64::from(n) + 2.0);
        let (a, b) = (f64::from(v.x) / math::sqrt_f64(nu), f64::from(v.y) / math::sqrt_f64(nv));
        let (steepest, up) = (math::sqrt_f64(a * a + b * b), f64::from(v.z));
        if steepest <= 0.0 {
            return 0.0;
        }
        // ψ = ψ₀ + t, where ψ₀ faces away from the view. With tan t = tan θ/c, since the integrand
        // decreases like exp(−c² tan² t/2).
        let (cos, sin) = (-a / steepest, -b / steepest);
        let (z, power) = (up / steepest, 1.0 / (cos * cos / nu + sin * sin / nv));
        let c = (z / math::sqrt_f64(1.0 + z / power * z)).max(1.0);
        let inner = |theta: f64| {
            let (sin_theta, cos_theta) = (math::sin_f64(theta), math::cos_f64(theta));
            let length = math::sqrt_f64(c * c * cos_theta * cos_theta + sin_theta * sin_theta);
            let (cos_t, sin_t) = (c * cos_theta / length, sin_theta / length);
            let (x, y) = (cos * cos_t - sin * sin_t, sin * cos_t + cos * sin_t);
            // 1/|d|² of the direction ψ is e + 2.
            let power = 1.0 / (x * x / nu + y * y / nv);
            let k = steepest * cos_t * math::sqrt_f64(power);
            let student = StudentDistribution::new(power - 1.0);
            let root = math::sqrt_f64(power - 1.0);
            k * student.tail(root * up / k) / (root * student.peak) * c / (length * length)
        };
        // The axes, where e changes fastest, in θ.
        let to_axis = math::atan2_f64(sin, cos) / FRAC_PI_2;
        let axis = (math::floor_f64(to_axis) - to_axis) * FRAC_PI_2;
        let bend = |t: f64| math::atan2_f64(c * math::sin_f64(t), math::cos_f64(t));
        let cuts = [-FRAC_PI_2, bend(axis), bend(axis + FRAC_PI_2), FRAC_PI_2];
        integrate(cuts, TOLERANCE, inner) / (2.0 * PI)
    }
}

impl Ndf for AshikhminShirley {
    fn d(&self, m: Vec3) -> f32 {
        let [x, y, z] = m.to_array().map(f64::from);
        let (x2, y2) = (x * x, y * y);
        let [nu, nv] = [self.n_u, self.n_v].map(f64::from);
        let slope2 = (x2 + y2) / (z * z);
        let exponent = if slope2 > 0.0 { (nu * x2 + nv * y2) / (x2 + y2) } else { 0.0 };
        let peak = math::sqrt_f64((nu + 2.0) * (nv + 2.0)) / (2.0 * PI);
        let density = peak * math::exp_f64(-0.5 * exponent * math::ln_1p_f64(slope2));
        if z > 0.0 && density >= 0.0 { density as f32 } else { 0.0 }
    }

    #[inline]
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        self.tilted(bounded(z))
    }

    fn invert(&self, m: Vec3) -> Vec2 {
        let up = f64::from(m.z.max(f32::MIN_POSITIVE));
        let (x, y) = (f64::from(m.x) / up, f64::from(m.y) / up);
        let s2 = x * x + y * y;
        // |d|² = ln(1 + |s|²)
        let per_length = if s2 < 1e-14 { 1.0 } else { math::sqrt_f64(math::ln_1p_f64(s2) / s2) };
        let [nu, nv] = [self.n_u, self.n_v].map(|n| math::sqrt_f64(f64::from(n) + 2.0));
        bounded(Vec2::new((nu * x * per_length) as f32, (nv * y * per_length) as f32))
    }

    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        let u = unit_square(u);
        self.tilted(Vec2::from(cos_sin_turns(Scalar, u.y)) * math::sqrt(-2.0 * math::ln_1p(-u.x)))
    }
}

impl Microfacet for AshikhminShirley {
    fn lambda(&self, v: Vec3) -> f32 {
        let lambda = self.hidden(v) / f64::from(v.z);
        if v.z > 0.0 && lambda >= 0.0 { lambda as f32 } else { f32::INFINITY }
    }

    fn projected_area(&self, v: Vec3) -> f32 {
        let v = above(v);
        (f64::from(v.z) + self.hidden(v)) as f32
    }

    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        let (proposal, mut u) = (Ggx { alpha: self.alpha }, unit_square(u));
        let mut random = SplitMix64 { state: (u64::from(u.x.to_bits()) << 32) | u64::from(u.y.to_bits()) };
        let mut m = proposal.sample_visible(v, u);
        for _ in 0..MOST_TRIES {
            let (x, y, z) = (f64::from(m.x), f64::from(m.y), f64::from(m.z));
            let [ax, ay] = [self.alpha.x, self.alpha.y].map(f64::from);
            let (slope2, q2) =
                ((x * x + y * y) / (z * z), ((x / ax) * (x / ax) + (y / ay) * (y / ay)) / (z * z));
            // D over the D of GGX is cos^(e+4) θ (1 + q²)², at most 4/e, with q² = (e + 2)/2 |s|².
            let fall = (q2 / slope2 + 1.0) * math::ln_1p_f64(slope2) - 2.0 * math::ln_1p_f64(q2) + LN_MOST;
            // At the zenith 0/0 is the limit e + 2 times 0.
            let accepted = if slope2 > 0.0 { math::exp_f64(-fall) } else { math::exp_f64(-LN_MOST) };
            if random.uniform() < accepted as f32 {
                break;
            }
            u = Vec2::new(random.uniform(), random.uniform());
            m = proposal.sample_visible(v, u);
        }
        m
    }
}

/// `ln(4/e)`.
const LN_MOST: f64 = 2.0 * core::f64::consts::LN_2 - 1.0;

/// The largest accepted difference between the shorter and the longer quadrature rule.
const TOLERANCE: f64 = 1e-4;

/// The maximum number of tries.
const MOST_TRIES: u32 = 64;

impl Radial for AshikhminShirley {
    fn exponent(&self, slope: f64) -> Option<f64> {
        (self.n_u == self.n_v).then(|| (0.5 * f64::from(self.n_u) + 1.0) * math::ln_1p_f64(slope * slope))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Microfacet;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn equal_exponents_are_blinn_phong() {
        let mut worst = 0.0_f32;
        for n in [0.0, 1.0, 10.0, 1e3, 1e6] {
            let (equal, phong) = (AshikhminShirley::new(n, n).unwrap(), BlinnPhong::new(n).unwrap());
            for k in 0..=90 {
                let theta = (k as f32 * 1.001_f32).to_radians().min(core::f32::consts::FRAC_PI_2);
                let v = Vec3::new(theta.sin() * 0.6, theta.sin() * 0.8, theta.cos().max(0.0));
                let (got, expected) = (equal.lambda(v), phong.lambda(v));
                if expected > 1e-35 && expected.is_finite() {
                    worst = worst.max((got / expected - 1.0).abs());
                }
                let (got, expected) = (equal.projected_area(v), phong.projected_area(v));
                assert_abs_diff_eq!(got / expected, 1.0, epsilon = 1e-6, "{n} {k}");
                let z = Vec2::new(k as f32 / 15.0, 1.0 - k as f32 / 20.0);
                let m = phong.warp_gaussian(z);
                assert_abs_diff_eq!(equal.warp_gaussian(z), m, epsilon = 1e-6);
                assert_abs_diff_eq!(equal.invert(m), z, epsilon = 5e-6);
            }
        }
        assert!(worst < 1e-5, "{worst:e}");
    }
}
