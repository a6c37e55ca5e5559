//! The GGX (Trowbridge–Reitz) NDF, isotropic and anisotropic, in closed form.

use core::f32::consts::{PI, SQRT_2};

use glam::{Vec2, Vec3};

use crate::closed_form::Formulas;
use crate::coordinates::{FARTHEST, GaussianSplit, bounded};
use crate::density::closed_form::{closed_form, probabilities, stretched, unit};
use crate::density::roughness::{Roughness, roughness_parameters};
use crate::microfacet::{Microfacet, VisibleWarp, above};
use crate::ndf::Ndf;
use crate::radial::Radial;
use asperity_core::lanes::elementary::{cos_sin_turns, exp, ln, ln_1p, one_minus_exp_ratio};
use asperity_core::lanes::{Arithmetic, Scalar};
use asperity_core::math;

/// The GGX NDF with the roughnesses `alpha_x`, `alpha_y`.
///
/// ```text
/// D(m) = 1 / (π αx αy (mx²/αx² + my²/αy² + mz²)²)                                  in sr⁻¹
/// T(z): s = (αx z₁, αy z₂) · √(expm1(ρ²/2)/ρ²),  ρ² = z₁² + z₂²,  m = (s_x, s_y, 1)/√(1 + |s|²)
/// T⁻¹:  ρ² = 2 ln(1 + (s_x/αx)² + (s_y/αy)²),  direction of (s_x/αx, s_y/αy)
/// ```
///
/// - **Domain:** `αx, αy` in [`MIN_ALPHA`](Self::MIN_ALPHA)`..=`[`MAX_ALPHA`](Self::MAX_ALPHA);
///   unit `m`, used as given; `D = 0` for `m.z ≤ 0` and NaN.
/// - **Sign:** `s` is the slope of the normal, `s_x = m_x/m_z`. The height decreases where it is
///   positive.
/// - **Accuracy:** `D` 1e-6 relative to the exact value of the `f32` input. Visible normals 5e-7 of
///   the terms of their sum, `α (|c| + |v|)` across and `c_z + v_z`, which cancel where `u₂ → 1`
///   and `c` faces away from the view. `T⁻¹(T(z)) = z` within 4e-6 for `|z| ≤ 6` and roughness 1e-4
///   to 1.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, glam::Vec3};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// assert!((ggx.d(Vec3::Z) - 1.0 / (core::f32::consts::PI * 0.08)).abs() < 1e-5);
/// assert!(Ggx::new(f32::NAN, 0.4).is_err());
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Samples for reflections come from a smaller cap of directions, Eto and Tokuyoshi 2023, "Bounded
/// VNDF Sampling for Smith–GGX Reflections", with the smaller roughness for anisotropic NDFs as in
/// Tokuyoshi and Eto 2024.
///
/// Walter et al. 2007, eq. 33; anisotropic form Burley 2012, eq. 13. The map is the radial Gaussian
/// map of this slope density: `P(|s/α| ≤ t) = t²/(1 + t²) = 1 − exp(−ρ²/2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "trowbridge")]
#[doc(alias = "reitz")]
#[doc(alias = "trowbridge-reitz")]
#[doc(alias = "specular")]
pub struct Ggx {
    pub(crate) alpha: Roughness,
}

roughness_parameters!(Ggx);

closed_form!(Ggx);

impl Formulas for Ggx {
    #[inline(always)]
    fn normal<S: Arithmetic>(&self, s: S, [z1, z2]: [S::F; 2]) -> [S::F; 3] {
        let (z1, z2) = (s.bounded(z1, FARTHEST), s.bounded(z2, FARTHEST));
        let half = (z1 * z1 + z2 * z2) * s.float(0.5);
        let up = exp(s, half * s.float(-0.5));
        let scale = s.sqrt(one_minus_exp_ratio(s, half, up) * s.float(0.5));
        let x = z1 * scale * s.float(self.alpha.x);
        let y = z2 * scale * s.float(self.alpha.y);
        unit(s, [x, y, up])
    }

    #[inline(always)]
    fn gaussian<S: Arithmetic>(&self, s: S, [x, y, z]: [S::F; 3]) -> [S::F; 2] {
        let up = s.at_least(z, f32::MIN_POSITIVE);
        let (x, y) = (x / s.float(self.alpha.x), y / s.float(self.alpha.y));
        let length = s.sqrt(x * x + y * y);
        // Beyond 10¹⁹ the square would overflow. The coordinate reaches its bound long before.
        let t = s.at_most(length / up, 1e19);
        let rho = s.sqrt(ln_1p(s, t * t) * s.float(2.0));
        // Below 10⁻⁵ ln(1 + t²) is t² to the last bit, and t² may underflow.
        let rho = s.select(s.less(t, s.float(1e-5)), t * s.float(SQRT_2), rho);
        let per_length = rho / length;
        [s.bounded(x * per_length, FARTHEST), s.bounded(y * per_length, FARTHEST)]
    }

    #[inline(always)]
    fn density_in_lanes<S: Arithmetic>(&self, s: S, [x, y, z]: [S::F; 3]) -> [S::F; 1] {
        let (x, y) = (x / s.float(self.alpha.x), y / s.float(self.alpha.y));
        let t = (x * x + y * y) + z * z;
        let peak = s.float(PI * self.alpha.x * self.alpha.y);
        let zero = s.float(0.0);
        let density = s.at_most(s.float(1.0) / (peak * t * t), f32::MAX);
        let finite = s.less(t, s.float(f32::INFINITY));
        [s.select(s.less(zero, z), s.select(finite, density, zero), zero)]
    }

    /// [`GaussianSplit::weigh`] of density and coordinates with one logarithm and one exponential.
    #[inline(always)]
    fn conditional<S: Arithmetic>(&self, s: S, split: GaussianSplit, h: [S::F; 3]) -> [S::F; 1] {
        let [density] = self.density_in_lanes(s, h);
        let [x, y] = self.gaussian(s, h);
        let GaussianSplit { z_b, root, rest } = split;
        let (x, y) = (x * s.float(root) - s.float(z_b.x), y * s.float(root) - s.float(z_b.y));
        let near = (x * x + y * y) / s.float(rest);
        // At most 84. Half of the exponent is used twice, because the whole would overflow where
        // the density is small.
        let half = exp(s, (s.float(z_b.x * z_b.x + z_b.y * z_b.y) - near) * s.float(0.25));
        [s.at_most(density * half * half / s.float(rest), f32::MAX)]
    }

    #[inline(always)]
    fn polar<S: Arithmetic>(&self, s: S, u: [S::F; 2]) -> [S::F; 3] {
        let [u1, u2] = probabilities(s, u);
        let slope = s.sqrt(u1);
        let [cos, sin] = cos_sin_turns(s, u2);
        let (x, y) = (slope * cos * s.float(self.alpha.x), slope * sin * s.float(self.alpha.y));
        unit(s, [x, y, s.sqrt(s.float(1.0) - u1)])
    }

    #[inline(always)]
    fn visible<S: Arithmetic>(&self, s: S, view: [S::F; 5]) -> [S::F; 3] {
        self.cap(s, view, None)
    }
}

impl Ggx {
    /// The normal of a uniform direction `c` of the cap `c.z ≥ −z`, or `c.z ≥ −(1 − cut) z`.
    #[inline(always)]
    fn cap<S: Arithmetic>(&self, s: S, [x, y, z, u1, u2]: [S::F; 5], cut: Option<f32>) -> [S::F; 3] {
        let [u1, u2] = probabilities(s, [u1, u2]);
        let [x, y, z] = stretched(s, self.alpha, [x, y, z]);
        let length2 = (x * x + y * y) + z * z;
        // A vector without a direction is read as the zenith.
        let directed = s.less(s.float(1e-37), length2);
        let scale = s.select(directed, s.float(1.0) / s.sqrt(length2), s.float(0.0));
        let (x, y, z) = (x * scale, y * scale, s.select(directed, z * scale, s.float(1.0)));
        // c.z = (1 − u₂)(1 + z) − z, in forms that keep sin θ.
        let one = s.float(1.0);
        // 1 − z, and with a cut cap 1 − (1 − cut) z.
        let (rest, whole, removed) = ((x * x + y * y) / (one + z), one + z, s.float(0.0));
        let (rest, whole, removed) = if let Some(cut) = cut {
            let removed = z * s.float(cut);
            (rest + removed, whole - removed, removed)
        } else {
            (rest, whole, removed)
        };
        let (below, above) = (u2 * whole, (one - u2) * whole);
        // 2 − below, as the remainders of 1 + z and 1 − z, does not cancel as u₂ → 1 near the
        // zenith.
        let sin = s.sqrt(below * (above + rest));
        let [cos_phi, sin_phi] = cos_sin_turns(s, u1);
        let x = (sin * cos_phi + x) * s.float(self.alpha.x);
        let y = (sin * sin_phi + y) * s.float(self.alpha.y);
        unit(s, [x, y, if cut.is_some() { above + removed } else { above }])
    }

    /// The part of the cap that reflects `v` below the horizon, at least, over its height `w_z`.
    ///
    /// `1 − k` of Eto and Tokuyoshi 2023, eq. 5 and 6, without the difference.
    fn cut(&self, v: Vec3) -> f32 {
        let alpha = self.alpha.x.min(self.alpha.y).min(1.0);
        let reach = 1.0 + math::sqrt(v.x * v.x + v.y * v.y);
        let (a2, s2, z2) = (alpha * alpha, reach * reach, v.z * v.z);
        a2 * (s2 + z2) / (s2 + a2 * z2)
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
        self.visible(Scalar, [v.x, v.y, v.z, u.x, u.y]).into()
    }

    fn sample_reflecting(&self, v: Vec3, u: Vec2) -> Vec3 {
        let v = above(v);
        self.cap(Scalar, [v.x, v.y, v.z, u.x, u.y], Some(self.cut(v))).into()
    }

    fn reflecting_pdf(&self, v: Vec3, m: Vec3) -> f32 {
        let v = above(v);
        let (w, cut, cosine) = (self.alpha.stretch(v), self.cut(v), v.dot(m));
        let length = math::sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
        let is_up = 2.0 * cosine * m.z >= v.z;
        // The direction c of the normal is 2 (w·k) k/(|w| |k|²) − w/|w|, c_z ≥ (cut − 1) w_z/|w|.
        let k = Vec3::new(m.x / self.alpha.x, m.y / self.alpha.y, m.z);
        if !is_up && 2.0 * w.dot(k) * k.z < cut * w.z * k.length_squared() {
            return 0.0;
        }
        let density = self.d(m) * cosine.max(0.0) / (0.5 * ((1.0 - cut) * w.z + length));
        if density >= 0.0 { density.min(f32::MAX) } else { 0.0 }
    }
}

impl Ggx {
    /// The view in the space where the NDF is a hemisphere, of unit length.
    #[inline]
    fn stretched_view(&self, v: Vec3) -> Vec3 {
        let w = self.alpha.stretch(above(v));
        // By a division: the rounding of the reciprocal shows in `T_v⁻¹` at grazing views.
        w / math::sqrt(w.x * w.x + w.y * w.y + w.z * w.z)
    }
}

/// The map of spherical caps, with `exp(−ρ²/2)` and the azimuth of `z` as its uniform numbers.
///
/// ```text
/// w = unit(αx v_x, αy v_y, v_z),  e = exp(−ρ²/2)
/// c: c_z = e (1 + w_z) − w_z,  azimuth of z          m = unit(αx h_x, αy h_y, h_z),  h = c + w
/// T_v⁻¹: k = unit(m_x/αx, m_y/αy, m_z),  c = 2 (w·k) k − w,  e = (c_z + w_z)/(1 + w_z)
/// ```
///
/// Accuracy: `T_v⁻¹(T_v(z)) = z` within 2e-5 for `|z| ≤ 4` and views up to 89.95° from the normal.
///
/// Dupuy, Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps", read as a map of
/// Gaussian numbers.
impl VisibleWarp for Ggx {
    fn warp_visible(&self, v: Vec3, z: Vec2) -> Vec3 {
        let (w, z) = (self.stretched_view(v), bounded(z));
        let half = 0.5 * (z.x * z.x + z.y * z.y);
        let root = exp(Scalar, -0.5 * half);
        // (1 − e)/(ρ²/2)
        let ratio = one_minus_exp_ratio(Scalar, half, root);
        // Above 0, so that a normal at the horizon keeps its azimuth; reached at ρ = 11.7.
        let up = (root * root).max(1e-30) * (1.0 + w.z);
        // |c_xy|² = (1 − c_z)(1 + c_z) = (1 − e)(1 + w_z) (up + (1 − w_z))
        let sin = math::sqrt(0.5 * ratio * (1.0 + w.z) * (up + (w.x * w.x + w.y * w.y) / (1.0 + w.z)));
        let m = Vec3::new((z.x * sin + w.x) * self.alpha.x, (z.y * sin + w.y) * self.alpha.y, up);
        // The squares of the largest component neither vanish nor overflow.
        unit(Scalar, (m / m.abs().max_element()).to_array()).into()
    }

    fn invert_visible(&self, v: Vec3, m: Vec3) -> Vec2 {
        let w = self.stretched_view(v);
        let k = Vec3::new(m.x / self.alpha.x, m.y / self.alpha.y, m.z);
        let length2 = k.length_squared();
        if !(length2 > 0.0 && length2 < f32::INFINITY) {
            return Vec2::ZERO;
        }
        // All of these are multiples of |k|².
        let twice = 2.0 * w.dot(k);
        let (x, y) = (twice * k.x - length2 * w.x, twice * k.y - length2 * w.y);
        let (up, cos) = (twice * k.z, twice * k.z - length2 * w.z);
        let length = math::sqrt(x * x + y * y);
        // 1 − e by the sine where the cap is above its middle, where 1 − c_z would cancel.
        let whole = 1.0 + w.z;
        let square = if cos > 0.0 {
            let rest = length * length / (length2 * (length2 + cos) * whole);
            -2.0 * ln_1p(Scalar, -rest.min(0.999_999_94))
        } else {
            -2.0 * ln(Scalar, (up / (length2 * whole)).max(f32::MIN_POSITIVE))
        };
        if length > 0.0 {
            bounded(Vec2::new(x, y) * (math::sqrt(square.max(0.0)) / length))
        } else {
            Vec2::ZERO
        }
    }
}

impl Radial for Ggx {
    fn exponent(&self, slope: f64) -> Option<f64> {
        let t = slope / f64::from(self.alpha.x);
        (self.alpha.x == self.alpha.y).then(|| math::ln_1p_f64(t * t))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn from_gaussian_of_small_roughness_keeps_relative_accuracy() {
        let m = Ggx::isotropic(1e-4).unwrap().warp_gaussian(Vec2::new(0.01, -0.02));
        assert_abs_diff_eq!(m.x / 7.071e-7, 1.0, epsilon = 1e-3);
        assert_abs_diff_eq!(m.y / -1.4142e-6, 1.0, epsilon = 1e-3);
    }

    #[test]
    fn round_trip_holds_up_to_the_coordinate_bound() {
        let ggx = Ggx::new(0.3, 1.0).unwrap();
        for k in 1..=48 {
            let z = Vec2::new(0.6, -0.8) * (k as f32 * 0.25);
            assert_abs_diff_eq!(ggx.invert(ggx.warp_gaussian(z)), z, epsilon = 4e-6);
        }
    }

    /// Visible normal in `f64`, and the size of its terms over the length of their sum.
    fn visible(alpha: [f64; 2], v: [f64; 3], [u1, u2]: [f64; 2]) -> ([f64; 3], f64) {
        let (x, y) = (alpha[0] * v[0], alpha[1] * v[1]);
        let length = (x * x + y * y + v[2] * v[2]).sqrt();
        let (x, y, z) = (x / length, y / length, v[2] / length);
        let below = u2 * (1.0 + z);
        let (sin, turn) = ((below * (2.0 - below)).max(0.0).sqrt(), core::f64::consts::TAU * u1);
        let up = (1.0 - u2) * (1.0 + z);
        let terms = alpha[0].max(alpha[1]) * (sin + (x * x + y * y).sqrt()) + up;
        let (x, y) = (alpha[0] * (sin * turn.cos() + x), alpha[1] * (sin * turn.sin() + y));
        let length = (x * x + y * y + up * up).sqrt();
        ([x, y, up].map(|c| c / length), terms / length)
    }

    #[test]
    fn sample_visible_is_accurate_near_u2_one() {
        let v = Vec3::new(0.038_226_18, 0.032_197_46, 0.998_750_4);
        let m = Ggx::new(0.05, 0.6).unwrap().sample_visible(v, Vec2::new(0.95, 0.999));
        // The digits of the view are rounded.
        assert_abs_diff_eq!(m.y, -0.169_988, epsilon = 2e-6);
        let mut worst = (0.0_f64, Vec3::Z, Vec2::ZERO);
        for (alpha, tilt) in [[0.05, 0.6], [0.6, 0.05], [1e-4, 1e-4], [1e-3, 1.0], [1.0, 1.0]]
            .into_iter()
            .flat_map(|alpha| [0.0_f32, 1e-3, 0.05, 0.6, 1.0, 1.5, 1.57].map(|tilt| (alpha, tilt)))
        {
            let ggx = Ggx::new(alpha[0], alpha[1]).unwrap();
            for (k, j) in (0..40).flat_map(|k| (1..24).map(move |j| (k, j))) {
                let azimuth = k as f32 * 2.4;
                let v = Vec3::new(tilt.sin() * azimuth.cos(), tilt.sin() * azimuth.sin(), tilt.cos());
                let u = Vec2::new(k as f32 / 40.0, 1.0 - 0.5_f32.powi(j));
                let (exact, terms) =
                    visible(alpha.map(f64::from), v.to_array().map(f64::from), u.to_array().map(f64::from));
                let got = ggx.sample_visible(v, u).to_array();
                for (got, exact) in got.into_iter().zip(exact) {
                    let error = (f64::from(got) - exact).abs() / terms;
                    if error > worst.0 {
                        worst = (error, v, u);
                    }
                }
            }
        }
        assert!(worst.0 < 5e-7, "{worst:?}");
    }
}
