//! The `NoiseDistribution` trait.

use crate::coordinates::bounded_coordinate;
use crate::error::{NdfError, in_range};
use crate::ndf::forward;
use crate::numeric::normal_distribution::{gaussian_cdf, inverse_gaussian_cdf};

/// The distribution `G` of a noise, which maps its values to Gaussian coordinates and back.
///
/// ```text
/// invert(r) = Φ⁻¹(G(r)),   warp_gaussian(z) = G⁻¹(Φ(z)),   cdf(r) = G(r),   quantile(u) = G⁻¹(u)
/// ```
///
/// With an [`Ndf`](crate::Ndf) they turn noise values into normals, `n = T(invert(r))`, and the
/// normals of an existing bump map into noise values, `r = warp_gaussian(T⁻¹(n))`. A sum of two
/// noises does not have the distribution of one noise, unless they are Gaussian. Add them in
/// Gaussian coordinates, with [`add_detail`](crate::add_detail), to keep the NDF.
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
///     assert!(g.invert(0.0).abs() < 1e-6 && g.invert(0.3) > 0.5);
///     assert!((g.warp_gaussian(g.invert(0.3)) - 0.3).abs() < 1e-6);
/// }
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, "Real-Time Bump Map Synthesis", sections 4 and 7.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement `NoiseDistribution`",
    note = "pass `GaussianDistribution`, `KurtoticDistribution` or a `NoiseCdfRef` of measured values"
)]
pub trait NoiseDistribution {
    /// `Φ⁻¹(G(r))`: the noise value as a standard Gaussian.
    #[must_use]
    fn invert(&self, r: f32) -> f32;

    /// `G⁻¹(Φ(z))`: the noise value whose Gaussian coordinate is `z`.
    #[must_use]
    fn warp_gaussian(&self, z: f32) -> f32;

    /// `G(r)`, in [0, 1].
    #[must_use]
    fn cdf(&self, r: f32) -> f32 {
        gaussian_cdf(f64::from(self.invert(r))) as f32
    }

    /// `G⁻¹(u)`; `u` is clamped to [0, 1], NaN is read as ½.
    #[must_use]
    fn quantile(&self, u: f32) -> f32 {
        let u = if u.is_nan() { 0.5 } else { f64::from(u).clamp(0.0, 1.0) };
        self.warp_gaussian(bounded_coordinate(inverse_gaussian_cdf(u) as f32))
    }
}

impl<G: NoiseDistribution + ?Sized> NoiseDistribution for &G {
    forward! { |noise| **noise;
        invert(r: f32) -> f32;
        warp_gaussian(z: f32) -> f32;
        cdf(r: f32) -> f32;
        quantile(u: f32) -> f32;
    }
}

/// A Gaussian noise with mean 0: `G(r) = Φ(r/σ)` only changes the scale.
///
/// Its `cdf` and `quantile` are [`gaussian_cdf`] and
/// [`inverse_gaussian_cdf`]. Values are clamped to ±13 σ.
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
    pub fn new(deviation: f32) -> Result<Self, NdfError> {
        check(deviation).map(|deviation| Self { deviation })
    }
}

impl NoiseDistribution for GaussianDistribution {
    #[inline]
    fn invert(&self, r: f32) -> f32 {
        bounded_coordinate(r / self.deviation)
    }

    #[inline]
    fn warp_gaussian(&self, z: f32) -> f32 {
        bounded_coordinate(z) * self.deviation
    }
}

/// Returns `σ` if it is positive and finite.
pub(crate) fn check(deviation: f32) -> Result<f32, NdfError> {
    in_range("deviation", deviation, [f32::MIN_POSITIVE, f32::MAX])
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
            assert_eq!(gaussian.invert(r), kurtotic.invert(r));
            assert_abs_diff_eq!(gaussian.cdf(r), gaussian_cdf(f64::from(r) / 0.7) as f32, epsilon = 1e-7);
        }
    }
}
