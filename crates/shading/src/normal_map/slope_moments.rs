//! Slope moments of a normal map within a pixel: mean and covariance (LEAN mapping).

use asperity_ndf_sampling::{Beckmann, OffsetBeckmann};
use glam::{Vec2, Vec3};

use crate::level_of_detail::ResolvedBumps;
use crate::math::{clamp_to, sqrt};

/// The mean and the covariance of slopes `s = (n_x, n_y)/n_z` within a pixel.
///
/// ```
/// use asperity_shading::normal_map::SlopeMoments;
/// use asperity_shading::glam::Vec2;
///
/// // A ridge within a pixel: two slopes, flat on average.
/// let ridge = SlopeMoments::mixed([-0.3, 0.3].map(|x| (1.0, SlopeMoments::point(Vec2::new(x, 0.0)))));
/// assert_eq!(ridge.mean, Vec2::ZERO);
/// assert!((ridge.covariance[0] - 0.09).abs() < 1e-6);
/// ```
///
/// Olano, Baker 2010, *LEAN Mapping*, §3; here around the mean, which avoids cancellation.
#[doc(alias = "lean")]
#[doc(alias = "toksvig")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SlopeMoments {
    /// The mean.
    pub mean: Vec2,
    /// The covariance `[xx, xy, yy]`.
    pub covariance: [f32; 3],
}

impl SlopeMoments {
    /// A single value with zero covariance.
    #[inline]
    #[must_use]
    pub const fn point(value: Vec2) -> Self {
        Self { mean: value, covariance: [0.0; 3] }
    }

    /// The moments of a mixture of parts with weights, which need not sum to 1; 0 if empty.
    ///
    /// ```text
    /// μ = Σ w μᵢ/Σ w,   Σ = Σ w (Σᵢ + (μᵢ − μ)(μᵢ − μ)ᵀ)/Σ w
    /// ```
    ///
    /// Non-positive weights are ignored.
    #[must_use]
    pub fn mixed(parts: impl IntoIterator<Item = (f32, Self)>) -> Self {
        let (mut all, mut mixed) = (0.0, Self::default());
        for (weight, part) in parts {
            if weight > 0.0 {
                all += weight;
                mixed = mixed.joined(part, weight / all);
            }
        }
        mixed
    }

    /// The mixture with another part of this fraction.
    #[inline]
    pub(super) fn joined(self, other: Self, share: f32) -> Self {
        let apart = other.mean - self.mean;
        let outer = [apart.x * apart.x, apart.x * apart.y, apart.y * apart.y];
        let rest = 1.0 - share;
        let mut covariance = self.covariance;
        for ((c, o), outer) in covariance.iter_mut().zip(other.covariance).zip(outer) {
            *c = rest * *c + share * (o + rest * outer);
        }
        Self { mean: self.mean + share * apart, covariance }
    }

    /// The unit normal of the mean slope.
    #[must_use]
    pub fn normal(self) -> Vec3 {
        let normal = self.mean.extend(1.0);
        let length2 = normal.length_squared();
        if length2.is_finite() { normal / sqrt(length2) } else { Vec3::Z }
    }

    /// The approximate mean of the unit normals of these slopes, used for diffuse surfaces.
    ///
    /// ```text
    /// E[(s, 1)/√(1 + |s|²)] ≈ (μ, 1)/√(1 + |μ|² + tr Σ)
    /// ```
    ///
    /// Its length is at most 1. For Gaussian slopes around 0 it is 1.4 % too short at a standard
    /// deviation of 0.2 along both axes, 6 % at 0.5.
    #[must_use]
    pub fn mean_normal(self) -> Vec3 {
        let [xx, _, yy] = self.covariance;
        let normal = self.mean.extend(1.0);
        let length2 = normal.length_squared() + clamp_to(xx + yy, f32::MAX);
        if length2.is_finite() { normal / sqrt(length2) } else { Vec3::Z }
    }

    /// The NDF of a Beckmann surface with this bump map: around the mean slope, and rougher.
    ///
    /// ```text
    /// s ~ N(μ, Σ + diag(αx², αy²)/2)
    /// ```
    ///
    /// Exact if the slopes within the pixel are Gaussian, which is not the case at edges. Roughness
    /// is clamped to the range of [`Beckmann`]; moments out of range are ignored.
    #[must_use]
    pub fn beckmann(self, alpha_x: f32, alpha_y: f32) -> OffsetBeckmann {
        let base = Beckmann::new_clamped(alpha_x, alpha_y);
        let [xx, xy, yy] = self.covariance;
        let [x, y] = [base.alpha_x(), base.alpha_y()].map(|alpha| 0.5 * alpha * alpha);
        OffsetBeckmann::new(self.mean, [xx + x, xy, yy + y])
            .unwrap_or_else(|_| OffsetBeckmann::conditional(base, Vec2::ZERO, 0.0))
    }

    /// The NDF of this map with finer bumps that the pixel partially resolves.
    ///
    /// ```text
    /// s ~ N(μ + √t α z/√2, Σ + (1 − t) α²/2),   t the resolved fraction, for αx and αy alike
    /// ```
    ///
    /// The map is the top level. Below its texels it continues as a bump map with the NDF `fine`,
    /// from a [`BumpField`](crate::BumpField). The resolved part of the bump map moves the slopes,
    /// and the rest is roughness, as in [`LevelOfDetail::Exact`](crate::LevelOfDetail) for Gaussian
    /// slopes. The mean over the noise is [`beckmann`](Self::beckmann) for every resolved fraction.
    ///
    /// Kautz, Heidrich, Seidel 2001, *Real-Time Bump Map Synthesis*, §5 and §7.
    #[must_use]
    pub fn add_detail(self, fine: Beckmann, noise: ResolvedBumps) -> OffsetBeckmann {
        let seen = OffsetBeckmann::conditional(fine, noise.z, noise.variance);
        let [xx, xy, yy] = self.covariance;
        let [fine_xx, _, fine_yy] = seen.covariance();
        OffsetBeckmann::new(self.mean + seen.mean(), [xx + fine_xx, xy, yy + fine_yy]).unwrap_or(seen)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use asperity_ndf_sampling::Ndf as _;

    #[test]
    fn mixed_has_the_moments_of_all_values() {
        let values: [Vec2; 12] =
            core::array::from_fn(|k| Vec2::new((k * 7 % 12) as f32 * 0.1 + 1000.0, (k * 5 % 7) as f32 * 0.2));
        let part =
            |values: &[Vec2]| SlopeMoments::mixed(values.iter().map(|v| (1.0, SlopeMoments::point(*v))));
        let (all, halves) = (part(&values), [part(&values[..4]), part(&values[4..])]);
        let again = SlopeMoments::mixed([(2.0, halves[0]), (4.0, halves[1])]);
        let mean = values.iter().sum::<Vec2>() / 12.0;
        let yy = values.iter().map(|v| (v.y - mean.y) * (v.y - mean.y)).sum::<f32>() / 12.0;
        assert_abs_diff_eq!(all.mean, mean, epsilon = 1e-3);
        assert_abs_diff_eq!(all.covariance[2], yy, epsilon = 1e-6);
        for k in 0..3 {
            // For values of 1000 the variance of 0.1 remains, to the rounding of the values.
            assert_abs_diff_eq!(all.covariance[k], again.covariance[k], epsilon = 1e-3);
        }
        assert_eq!(SlopeMoments::mixed([]), SlopeMoments::default());
    }

    #[test]
    fn beckmann_adds_the_slope_variance() {
        let moments = SlopeMoments { mean: Vec2::new(0.3, -0.1), covariance: [0.02, 0.01, 0.03] };
        let rough = moments.beckmann(0.2, 0.4);
        let expected = [0.04, 0.01, 0.11];
        for (got, expected) in rough.covariance().into_iter().zip(expected) {
            assert_abs_diff_eq!(got, expected, epsilon = 1e-7, "{rough:?}");
        }
        assert_eq!(rough.mean(), moments.mean);
        assert_abs_diff_eq!(moments.normal(), Vec3::new(0.3, -0.1, 1.0).normalize(), epsilon = 1e-6);
        assert!(moments.mean_normal().length() < 0.99);
    }

    #[test]
    fn detailed_moves_and_roughens_slopes() {
        let moments = SlopeMoments { mean: Vec2::new(0.3, -0.1), covariance: [0.02, 0.01, 0.03] };
        let fine = Beckmann::new(0.2, 0.4).unwrap();
        let unresolved = moments.add_detail(fine, ResolvedBumps::FAR);
        let rough = moments.beckmann(0.2, 0.4);
        assert_abs_diff_eq!(unresolved.mean(), rough.mean(), epsilon = 1e-7);
        let resolved =
            moments.add_detail(fine, ResolvedBumps { z: Vec2::new(1.0, -2.0), variance: 0.75, blend: 1.0 });
        let slope = Vec2::new(0.2, -0.8) * (0.75_f32 / 2.0).sqrt();
        assert!((resolved.mean() - moments.mean - slope).length() < 1e-6, "{resolved:?}");
        for (got, expected) in resolved.covariance().into_iter().zip([0.025, 0.01, 0.05]) {
            assert_abs_diff_eq!(got, expected, epsilon = 1e-6, "{resolved:?}");
        }
    }

    #[test]
    fn accepts_every_input() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, 1e-40, 1e38, -1.0, 0.5];
        let fine = Beckmann::isotropic(0.3).unwrap();
        for (x, y) in bad.into_iter().flat_map(|x| bad.map(|y| (x, y))) {
            for c in bad {
                let moments = SlopeMoments { mean: Vec2::new(x, y), covariance: [c, x, y] };
                let noise = ResolvedBumps { z: Vec2::new(c, x), variance: y, blend: 1.0 };
                for h in [Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(x, y, c)] {
                    let densities = [moments.beckmann(x, y), moments.add_detail(fine, noise)].map(|d| d.d(h));
                    assert!(densities.iter().all(|d| *d >= 0.0 && d.is_finite()), "{moments:?}, {h}");
                }
                assert_abs_diff_eq!(moments.normal().length(), 1.0, epsilon = 1e-5);
                assert!(moments.mean_normal().length() <= 1.0 + 1e-5, "{moments:?}");
            }
        }
    }
}
