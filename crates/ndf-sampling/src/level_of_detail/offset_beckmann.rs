//! Gaussian slopes with any mean and covariance, e.g. a partially resolved Beckmann NDF.

use core::f32::consts::{FRAC_1_SQRT_2, TAU};

use glam::{Vec2, Vec3};

use crate::coordinates::{GaussianSplit, bounded};
use crate::density::beckmann::Beckmann;
use crate::error::{NdfError, in_range};
use crate::ndf::Ndf;
use asperity_core::math;

/// A Beckmann NDF around any slope and along any axes: slopes `s = (m_x, m_y)/m_z` are `N(μ, Σ)`.
///
/// ```text
/// D(m) = exp(−½ (s − μ)ᵀ Σ⁻¹ (s − μ)) / (2π √|Σ| m_z⁴)                              in sr⁻¹
/// T(z): s = μ + L z,  Σ = L Lᵀ,  L lower triangular;      T⁻¹: z = L⁻¹ (s − μ)
/// ```
///
/// [`OffsetBeckmann::conditional`] is the density `p_s(h | z_b)` that a pixel sees of a
/// [`Beckmann`] surface, in a special form:
///
/// ```text
/// μ = √s (αx z_b,1, αy z_b,2)/√2,      Σ = (1 − s)/2 · diag(αx², αy²)
/// ```
///
/// a Beckmann NDF of the roughness `α√(1 − s)` around the resolved slope. As `s → 1` nothing
/// cancels, because the exponent is a difference of slopes.
/// [`residual_ndf`](crate::residual_ndf) weights `D(h)` by a ratio instead.
///
/// - **Domain:** unit `m`, used as given; `D = 0` for `m.z ≤ 0` and NaN. Coordinates as in [`Ndf`].
/// - **Accuracy:** `D` 2e-6 relative plus the slope of the exponent times the rounding of `m`:
///   1.2e-7 |s| |s − μ|/σ².
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, Ndf, OffsetBeckmann, residual_ndf, glam::Vec2};
///
/// let beckmann = Beckmann::new(0.2, 0.4)?;
/// let (z_b, s) = (Vec2::new(0.5, 1.5), 0.75);
/// let seen = OffsetBeckmann::conditional(beckmann, z_b, s);
/// let h = beckmann.warp_gaussian(Vec2::new(0.3, 1.1));
/// assert!((seen.d(h) / residual_ndf(&beckmann, h, z_b, s) - 1.0).abs() < 1e-5);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Olano, Baker 2010, "LEAN Mapping", eq. 5, with the normalization `∫ D cos θ dω = 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "lean")]
#[doc(alias = "leadr")]
#[doc(alias = "toksvig")]
pub struct OffsetBeckmann {
    mean: Vec2,
    /// `L`: its first column, and the last entry.
    lower: [f32; 3],
}

/// The smallest and the largest standard deviation of slopes; the largest also bounds the mean.
const DEVIATIONS: [f32; 2] = [1e-12, 1e9];

#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; OffsetBeckmann: density => density.mean, Vec3::from(density.covariance()); }

impl OffsetBeckmann {
    /// Creates the NDF of slopes with this mean and the covariance `[xx, xy, yy]`.
    ///
    /// # Errors
    /// A number that is not finite or beyond 10⁹ (variances: 10¹⁸); a covariance that is not
    /// positive definite, or whose standard deviation along y given x is below 10⁻¹².
    pub fn new(mean: Vec2, covariance: [f32; 3]) -> Result<Self, NdfError> {
        let [least, largest] = DEVIATIONS;
        in_range("mean.x", mean.x, [-largest, largest])?;
        in_range("mean.y", mean.y, [-largest, largest])?;
        let refused = NdfError::Covariance { value: covariance };
        let in_range = covariance.iter().all(|c| c.abs() <= largest * largest);
        // In f64, because the difference of products would lose the smaller axis of a thin ellipse.
        let [xx, xy, yy] = covariance.map(f64::from);
        let rest = yy - xy * xy / xx;
        let least = f64::from(least * least);
        if in_range && xx >= least && rest >= least {
            let first = math::sqrt_f64(xx);
            Ok(Self { mean, lower: [first, xy / first, math::sqrt_f64(rest)].map(|l| l as f32) })
        } else {
            Err(refused)
        }
    }

    /// Creates the conditional NDF of a Beckmann surface for resolved `z_b` with the fraction `s`.
    ///
    /// Accepts every input and equals [`residual_ndf`](crate::residual_ndf).
    #[inline]
    #[must_use]
    pub fn conditional(beckmann: Beckmann, z_b: Vec2, s: f32) -> Self {
        let s = if s.is_nan() { 0.0 } else { s.clamp(0.0, GaussianSplit::MAX_RESOLVED_VARIANCE) };
        let z_b = bounded(z_b) * math::sqrt(s);
        let [x, y] = [beckmann.alpha_x(), beckmann.alpha_y()].map(|alpha| alpha * FRAC_1_SQRT_2);
        let rest = math::sqrt(1.0 - s);
        Self { mean: Vec2::new(x * z_b.x, y * z_b.y), lower: [x * rest, 0.0, y * rest] }
    }

    /// The mean of the slopes.
    #[inline]
    #[must_use]
    pub const fn mean(self) -> Vec2 {
        self.mean
    }

    /// The covariance of the slopes, `[xx, xy, yy]`.
    #[inline]
    #[must_use]
    pub const fn covariance(self) -> [f32; 3] {
        let [a, b, c] = self.lower;
        [a * a, a * b, b * b + c * c]
    }

    /// `L⁻¹ (s − μ)`.
    #[inline]
    fn coordinates(self, slope: Vec2) -> Vec2 {
        let [a, b, c] = self.lower;
        let x = (slope.x - self.mean.x) / a;
        Vec2::new(x, (slope.y - self.mean.y - b * x) / c)
    }
}

impl Ndf for OffsetBeckmann {
    #[inline]
    fn d(&self, m: Vec3) -> f32 {
        let z = self.coordinates(Vec2::new(m.x / m.z, m.y / m.z));
        let falloff = math::exp(-0.5 * (z.x * z.x + z.y * z.y));
        if m.z > 0.0 && falloff > 0.0 {
            let [a, _, c] = self.lower;
            let z2 = m.z * m.z;
            // In two steps, because the product of both deviations may leave the range of f32.
            (falloff / (TAU * a * z2) / (c * z2)).min(f32::MAX)
        } else {
            0.0
        }
    }

    #[inline]
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        let (z, [a, b, c]) = (bounded(z), self.lower);
        let (x, y) = (self.mean.x + a * z.x, self.mean.y + b * z.x + c * z.y);
        let up = 1.0 / math::sqrt(x * x + y * y + 1.0);
        Vec3::new(x * up, y * up, up)
    }

    #[inline]
    fn invert(&self, m: Vec3) -> Vec2 {
        let up = m.z.max(f32::MIN_POSITIVE);
        bounded(self.coordinates(Vec2::new(m.x / up, m.y / up)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ndf::totality;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn zero_offset_is_beckmann() {
        let beckmann = Beckmann::new(0.2, 0.6).unwrap();
        let same = OffsetBeckmann::new(Vec2::ZERO, [0.02, 0.0, 0.18]).unwrap();
        for k in 0..60 {
            let z = Vec2::new(0.2 * k as f32 - 6.0, 3.0 - 0.1 * k as f32);
            let m = beckmann.warp_gaussian(z);
            assert_abs_diff_eq!(same.warp_gaussian(z), m, epsilon = 1e-6);
            assert_abs_diff_eq!(same.d(m) / beckmann.d(m), 1.0, epsilon = 5e-5, "{z}");
        }
    }

    #[test]
    fn samples_have_the_oblique_covariance() {
        let covariance = [0.09, -0.05, 0.04];
        let ndf = OffsetBeckmann::new(Vec2::new(0.3, -0.8), covariance).unwrap();
        let got = ndf.covariance();
        for (got, expected) in got.into_iter().zip(covariance) {
            assert_abs_diff_eq!(got, expected, epsilon = 1e-7);
        }
        for k in 0..40 {
            let z = Vec2::new(0.2 * k as f32 - 4.0, 0.1 * k as f32 - 1.0);
            assert_abs_diff_eq!(ndf.invert(ndf.warp_gaussian(z)), z, epsilon = 3e-5);
        }
        // The peak over slopes is 1/(2π √|Σ|).
        let peak = ndf.slope_density(ndf.mean()) * TAU * (0.09_f32 * 0.04 - 0.0025).sqrt();
        assert_abs_diff_eq!(peak, 1.0, epsilon = 1e-5, "{peak}");
    }

    #[test]
    fn accepts_every_input() {
        totality::check(&OffsetBeckmann::new(Vec2::splat(1e9), [1e18, 0.0, 1e18]).unwrap());
        totality::check(&OffsetBeckmann::conditional(Beckmann::isotropic(1e-6).unwrap(), Vec2::NAN, 1.0));
    }
}
