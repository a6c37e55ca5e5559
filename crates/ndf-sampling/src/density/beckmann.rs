//! The Beckmann NDF, isotropic and anisotropic, in closed form.

use core::f32::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

use glam::{Vec2, Vec3};

use crate::closed_form::Formulas;
use crate::coordinates::{FARTHEST, GaussianSplit, bounded};
use crate::density::closed_form::{closed_form, probabilities, stretched, unit};
use crate::density::gaussian_lanes;
use crate::density::roughness::{Roughness, roughness_parameters};
use crate::density::view_axis::ViewAxis;
use crate::density::visible_slopes::{
    LEAST_U, excess, gaussian_of_visible, visible_of_gaussian, visible_slope,
};
use crate::microfacet::{Microfacet, VisibleWarp};
use crate::ndf::unit_square;
use crate::numeric::normal_distribution::inverse_gaussian_cdf;
use crate::radial::Radial;
use asperity_core::lanes::Arithmetic;
use asperity_core::lanes::elementary::{cos_sin_turns, exp, ln_1p};

/// The Beckmann NDF with the roughnesses `alpha_x`, `alpha_y`.
///
/// ```text
/// D(m) = exp(−(mx²/αx² + my²/αy²)/mz²) / (π αx αy mz⁴)                              in sr⁻¹
/// T(z): s = (αx z₁, αy z₂)/√2,  m = (s_x, s_y, 1)/√(1 + |s|²);     T⁻¹: z = √2 (s_x/αx, s_y/αy)
/// ```
///
/// Its slopes are Gaussian with the variances `αx²/2`, `αy²/2`, so `T` is linear in the slopes.
///
/// - **Domain:** `αx, αy` in [`MIN_ALPHA`](Self::MIN_ALPHA)`..=`[`MAX_ALPHA`](Self::MAX_ALPHA);
///   unit `m`, used as given; `D = 0` for `m.z ≤ 0` and NaN.
/// - **Sign:** `s` is the slope of the normal, `s_x = m_x/m_z`. The height decreases where it is
///   positive.
/// - **Accuracy:** `D` 1e-6 + 5e-7 a relative, with the exponent `a`, wherever `D` is a normal
///   `f32`. `T⁻¹(T(z)) = z` within 4e-6 for `|z| ≤ 6` and roughness 1e-4 to 1.
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, Ndf, glam::Vec3};
///
/// let beckmann = Beckmann::isotropic(0.3)?;
/// assert!((beckmann.d(Vec3::Z) - 1.0 / (core::f32::consts::PI * 0.09)).abs() < 1e-5);
/// assert!(Beckmann::new(0.3, 0.0).is_err());
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Walter et al. 2007, eq. 25, in its anisotropic form.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "gaussian slopes")]
pub struct Beckmann {
    pub(crate) alpha: Roughness,
}

/// Up to this exponent `exp(−a)` times the smallest peak, of [`MAX_ALPHA`](Beckmann::MAX_ALPHA), is
/// a normal `f32`.
const NEAR: f32 = 40.0;

/// Beyond every slope of bounded coordinates.
const STEEPEST: f64 = 20.0;

roughness_parameters!(Beckmann);

closed_form!(Beckmann);

impl Formulas for Beckmann {
    #[inline(always)]
    fn normal<S: Arithmetic>(&self, s: S, [z1, z2]: [S::F; 2]) -> [S::F; 3] {
        let x = s.bounded(z1, FARTHEST) * s.float(self.alpha.x * FRAC_1_SQRT_2);
        let y = s.bounded(z2, FARTHEST) * s.float(self.alpha.y * FRAC_1_SQRT_2);
        unit(s, [x, y, s.float(1.0)])
    }

    #[inline(always)]
    fn gaussian<S: Arithmetic>(&self, s: S, [x, y, z]: [S::F; 3]) -> [S::F; 2] {
        let up = s.float(SQRT_2) / s.at_least(z, f32::MIN_POSITIVE);
        let z1 = (x / s.float(self.alpha.x)) * up;
        let z2 = (y / s.float(self.alpha.y)) * up;
        [s.bounded(z1, FARTHEST), s.bounded(z2, FARTHEST)]
    }

    #[inline(always)]
    fn density_in_lanes<S: Arithmetic>(&self, s: S, [x, y, z]: [S::F; 3]) -> [S::F; 1] {
        self.lobe(s, Vec2::ZERO, 1.0, [x, y, z])
    }

    /// A Beckmann NDF of the roughness `α√(1 − s)` around the resolved slope, with one exponential:
    ///
    /// ```text
    /// exp(−((x/αx − μx)² + (y/αy − μy)²)/(1 − s)) / (π αx αy (1 − s) h_z⁴),   (x, y) = (h_x, h_y)/h_z,   μ = √s z_b/√2
    /// ```
    #[inline(always)]
    fn conditional<S: Arithmetic>(&self, s: S, split: GaussianSplit, h: [S::F; 3]) -> [S::F; 1] {
        self.lobe(s, split.z_b * (split.root * FRAC_1_SQRT_2), split.rest, h)
    }

    #[inline(always)]
    fn polar<S: Arithmetic>(&self, s: S, u: [S::F; 2]) -> [S::F; 3] {
        let [u1, u2] = probabilities(s, u);
        let slope = s.sqrt(-ln_1p(s, -u1));
        let [cos, sin] = cos_sin_turns(s, u2);
        let (x, y) = (slope * cos * s.float(self.alpha.x), slope * sin * s.float(self.alpha.y));
        unit(s, [x, y, s.float(1.0)])
    }

    #[inline(always)]
    fn visible<S: Arithmetic>(&self, s: S, [x, y, z, u1, u2]: [S::F; 5]) -> [S::F; 3] {
        let [u1, u2] = probabilities(s, [u1, u2]);
        let [x, y, z] = stretched(s, self.alpha, [x, y, z]);
        let lateral = s.sqrt(x * x + y * y);
        let per_lateral = s.float(1.0) / lateral;
        let aside = s.less(s.float(0.0), lateral);
        let cos = s.select(aside, x * per_lateral, s.float(1.0));
        let sin = s.select(aside, y * per_lateral, s.float(0.0));
        let along = gaussian_lanes::visible_slope(s, z * per_lateral * s.float(SQRT_2), u1);
        let across = gaussian_lanes::inverse_gaussian_cdf(s, s.at_least(u2, gaussian_lanes::LEAST_U));
        let x = (along * cos - across * sin) * s.float(self.alpha.x * FRAC_1_SQRT_2);
        let y = (along * sin + across * cos) * s.float(self.alpha.y * FRAC_1_SQRT_2);
        unit(s, [x, y, s.float(1.0)])
    }
}

impl Beckmann {
    /// The normal with these slopes along and across a view, in standard deviations.
    fn sloped(self, axis: ViewAxis, along: f64, across: f64) -> Vec3 {
        let [x, y] = axis.to_surface(along, across);
        self.alpha.normal(x as f32 * FRAC_1_SQRT_2, y as f32 * FRAC_1_SQRT_2, 1.0)
    }

    /// The density around the slope `mean`, in units of the roughnesses, with `rest` times the
    /// variance.
    #[inline(always)]
    fn lobe<S: Arithmetic>(&self, s: S, mean: Vec2, rest: f32, [x, y, z]: [S::F; 3]) -> [S::F; 1] {
        let (x, y) = (x / s.float(self.alpha.x) / z, y / s.float(self.alpha.y) / z);
        let (x, y) = (x - s.float(mean.x), y - s.float(mean.y));
        let (zero, one) = (s.float(0.0), s.float(1.0));
        let exponent = -(x * x + y * y) / s.float(rest);
        // Far out the peak or z⁴ compensate for an exponential that would underflow: D =
        // (exp(−a/2)/z²)² peak.
        let near = s.less(s.float(-NEAR), exponent);
        let falloff = exp(s, s.select(near, exponent, exponent * s.float(0.5)));
        let z2 = z * z;
        let peak = s.float(1.0 / (PI * self.alpha.x * self.alpha.y * rest));
        let ratio = falloff * s.select(near, peak, one) / s.select(near, z2 * z2, z2);
        let density = s.at_most(s.select(near, ratio, ratio * (ratio * peak)), f32::MAX);
        // Next to the horizon the exponential is 0 long before z⁴ underflows.
        [s.select(s.less(zero, z), s.select(s.less(zero, falloff), density, zero), zero)]
    }
}

impl Microfacet for Beckmann {
    fn lambda(&self, v: Vec3) -> f32 {
        self.alpha.lambda(v, excess)
    }

    fn projected_area(&self, v: Vec3) -> f32 {
        self.alpha.projected_area(v, excess)
    }

    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        let (u, axis) = (unit_square(u), ViewAxis::new(self.alpha, v));
        let along = visible_slope(axis.cotangent, f64::from(u.x));
        self.sloped(axis, along, inverse_gaussian_cdf(f64::from(u.y).max(LEAST_U)))
    }
}

/// The slope along the view by the quantile of its seen distribution; the slope across is unchanged.
///
/// ```text
/// t = √2 s/α = z, along and across the view
/// T_v(z): t₁ = Q(Φ(z₁)),  t₂ = z₂;   Q: the quantile of the seen slopes, of density ∝ (b + t) φ(t) for t ≥ −b
/// T_v⁻¹:  z₁ = Φ⁻¹((b Φ(t₁) − φ(t₁) − b Φ(−b) + φ(b))/(b Φ(b) + φ(b))),  z₂ = t₂
/// ```
///
/// Here `b` is the cotangent of the view's angle in standard deviations.
///
/// Accuracy: `T_v⁻¹(T_v(z)) = z` within 2e-6 for `|z| ≤ 4` and views up to 89.95° from the normal.
impl VisibleWarp for Beckmann {
    fn warp_visible(&self, v: Vec3, z: Vec2) -> Vec3 {
        let (axis, z) = (ViewAxis::new(self.alpha, v), bounded(z));
        let [along, across] = axis.to_view(f64::from(z.x), f64::from(z.y));
        self.sloped(axis, visible_of_gaussian(axis.cotangent, along), across)
    }

    fn invert_visible(&self, v: Vec3, m: Vec3) -> Vec2 {
        let axis = ViewAxis::new(self.alpha, v);
        let up = core::f64::consts::SQRT_2 / f64::from(m.z.max(f32::MIN_POSITIVE));
        let (x, y) = (f64::from(m.x / self.alpha.x) * up, f64::from(m.y / self.alpha.y) * up);
        let [along, across] = axis.to_view(x, y);
        let along = gaussian_of_visible(axis.cotangent, along).clamp(-STEEPEST, STEEPEST);
        let [x, y] = axis.to_surface(along, across);
        bounded(Vec2::new(x as f32, y as f32))
    }
}

impl Radial for Beckmann {
    fn exponent(&self, slope: f64) -> Option<f64> {
        let t = slope / f64::from(self.alpha.x);
        (self.alpha.x == self.alpha.y).then_some(t * t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ndf::Ndf;
    use asperity_core::assert_abs_diff_eq;

    fn exact(alpha: [f32; 2], m: Vec3) -> (f64, f64) {
        let ([ax, ay], [x, y, z]) = (alpha.map(f64::from), m.to_array().map(f64::from));
        let a = ((x / ax / z).powi(2) + (y / ay / z).powi(2)).abs();
        (a, libm::exp(-a) / (core::f64::consts::PI * ax * ay * z.powi(4)))
    }

    #[test]
    fn density_is_relatively_accurate_down_to_the_smallest_normal_number() {
        let m = Vec3::new(0.920_338_1, -0.332_970_1, 0.205_204);
        let got = Beckmann::isotropic(0.5).unwrap().d(m);
        assert_abs_diff_eq!(got / 2.181_27e-37, 1.0, epsilon = 5e-5, "{got:e}");
        let mut farthest = 0.0_f64;
        for alpha in [[0.5; 2], [1e-6; 2], [1e-3; 2], [1.0; 2], [1e6; 2], [1e6, 1e-6], [0.02, 3.0]] {
            let beckmann = Beckmann::new(alpha[0], alpha[1]).unwrap();
            for (k, turn) in (1..=1400).flat_map(|k| [0.0_f32, 0.3, 1.0].map(|turn| (k, turn))) {
                let q = k as f32 * 0.01;
                let slope = Vec2::new(alpha[0] * q * turn.cos(), alpha[1] * q * turn.sin());
                let m = slope.extend(1.0) / slope.extend(1.0).length();
                let (a, exact) = exact(alpha, m);
                let got = f64::from(beckmann.d(m));
                if exact >= f64::from(f32::MIN_POSITIVE) {
                    assert_abs_diff_eq!(
                        got / exact,
                        1.0,
                        epsilon = 1e-6 + 5e-7 * a,
                        "{alpha:?} at {m}: {got:e}"
                    );
                    farthest = farthest.max(a);
                } else {
                    assert!(got <= 1.2e-38, "{alpha:?} at {m}: {got:e}");
                }
            }
        }
        assert!(farthest > 140.0, "{farthest}");
    }
}
