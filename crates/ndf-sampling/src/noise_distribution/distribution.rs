//! The `NoiseDistribution` trait.

use crate::coordinates::bounded_coordinate;
use crate::ndf::forward;
use crate::numeric::normal_distribution::{inverse_phi, phi};
use crate::range_error::RangeError;

/// The distribution `G` of a noise, which maps its values to Gaussian coordinates and back.
///
/// ```text
/// gaussian(r) = Φ⁻¹(G(r)),   warp_gaussian(z) = G⁻¹(Φ(z)),   uniform(r) = G(r),   inverse(u) = G⁻¹(u)
/// ```
///
/// Both maps are nondecreasing, finite and accept every input. NaN is read as the median. The trait
/// is dyn-compatible.
///
/// ```
/// use asperity_ndf_sampling::{GaussianDistribution, KurtoticDistribution, NoiseCdfRef, NoiseDistribution};
///
/// let (measured, gaussian) = (NoiseCdfRef::new(1.0, &[0.0, 0.2, 0.8, 1.0])?, GaussianDistribution::new(0.4)?);
/// let fitted = KurtoticDistribution::new(0.4, -0.46)?;
/// for g in [&measured as &dyn NoiseDistribution, &gaussian, &fitted] {
///     assert!(g.gaussian(0.0).abs() < 1e-6 && g.gaussian(0.3) > 0.5);
///     assert!((g.warp_gaussian(g.gaussian(0.3)) - 0.3).abs() < 1e-6);
/// }
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[expect(
    clippy::wrong_self_convention,
    reason = "from_gaussian is a map of this distribution, not a constructor"
)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `NoiseDistribution`",
    note = "pass `GaussianNoise`, `KurtoticNoise` or a `NoiseCdfRef` of measured values"
)]
pub trait NoiseDistribution {
    /// `Φ⁻¹(G(r))`: the noise value as a standard Gaussian.
    #[must_use]
    fn gaussian(&self, r: f32) -> f32;

    /// `G⁻¹(Φ(z))`: the noise value whose Gaussian coordinate is `z`.
    #[must_use]
    fn warp_gaussian(&self, z: f32) -> f32;

    /// `G(r)`, in [0, 1].
    #[must_use]
    fn uniform(&self, r: f32) -> f32 {
        phi(f64::from(self.gaussian(r))) as f32
    }

    /// `G⁻¹(u)`; `u` is clamped to [0, 1], NaN is read as ½.
    #[must_use]
    fn inverse(&self, u: f32) -> f32 {
        let u = if u.is_nan() { 0.5 } else { f64::from(u).clamp(0.0, 1.0) };
        self.warp_gaussian(bounded_coordinate(inverse_phi(u) as f32))
    }
}

impl<G: NoiseDistribution + ?Sized> NoiseDistribution for &G {
    forward! { |noise| **noise;
        gaussian(r: f32) -> f32;
        warp_gaussian(z: f32) -> f32;
        uniform(r: f32) -> f32;
        inverse(u: f32) -> f32;
    }
}

/// A Gaussian noise with mean 0: `G(r) = Φ(r/σ)` only changes the scale.
///
/// Its `uniform` and `inverse` are [`phi`] and [`inverse_phi`]. Values are clamped to ±13 σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianDistribution {
    deviation: f32,
}

#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; GaussianDistribution: noise => noise.deviation; }

impl GaussianDistribution {
    /// Creates the distribution with the standard deviation `σ`.
    ///
    /// # Errors
    /// A standard deviation that is not positive, normal and finite.
    pub fn new(deviation: f32) -> Result<Self, RangeError> {
        check(deviation).map(|deviation| Self { deviation })
    }
}

impl NoiseDistribution for GaussianDistribution {
    #[inline]
    fn gaussian(&self, r: f32) -> f32 {
        bounded_coordinate(r / self.deviation)
    }

    #[inline]
    fn warp_gaussian(&self, z: f32) -> f32 {
        bounded_coordinate(z) * self.deviation
    }
}

/// Returns `σ` if it is positive and finite.
pub(crate) fn check(deviation: f32) -> Result<f32, RangeError> {
    RangeError::check("deviation", deviation, [f32::MIN_POSITIVE, f32::MAX])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::KurtoticDistribution;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn gaussian_noise_equals_zero_kurtosis() {
        let (gaussian, kurtotic) =
            (GaussianDistribution::new(0.7).unwrap(), KurtoticDistribution::new(0.7, 0.0).unwrap());
        for r in [-3.0, -0.1, 0.0, 0.5, 2.0] {
            assert_eq!(gaussian.gaussian(r), kurtotic.gaussian(r));
            assert_abs_diff_eq!(gaussian.uniform(r), phi(f64::from(r) / 0.7) as f32, epsilon = 1e-7);
        }
    }
}
