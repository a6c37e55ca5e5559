//! Directional albedos: the fraction of light that a BRDF scatters.

use core::f32::consts::PI;

use glam::Vec3;

use crate::low_discrepancy::low_discrepancy_points;
use crate::math::{cos, sin, sqrt};
use crate::reflectance::brdf::Brdf;
use crate::reflectance::fresnel::MEAN_NODES;

/// The directional albedo `E(ωo)` of a white BRDF or BSDF: 1 minus the light that it loses.
///
/// ```text
/// E(ωo) = ∫ f(ωo, ωi) |cos θ_i| dω_i          with facets that reflect (and transmit) everything
/// E_avg = 2 ∫ E(cos θ) cos θ dcos θ            the mean over views from above, weighted by cos θ
/// ```
///
/// [`EnergyCompensated`](crate::reflectance::EnergyCompensated) divides by it. [`GgxAlbedo`] and
/// [`GlassAlbedo`] are shipped. `AlbedoTable` (feature `alloc`) computes it for any BRDF. Every
/// implementation in this crate returns a number in `(0, 1]` for every input.
///
/// [`GgxAlbedo`]: crate::reflectance::GgxAlbedo
/// [`GlassAlbedo`]: crate::reflectance::GlassAlbedo
///
/// ```
/// use asperity_shading::reflectance::{DirectionalAlbedo, GgxAlbedo};
/// use asperity_shading::{Ggx, glam::Vec3};
///
/// let rough = GgxAlbedo::new(&Ggx::isotropic(1.0)?);
/// assert!(rough.albedo(Vec3::Z) < 0.31 && rough.mean_albedo() < 0.45);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "multiple scattering")]
pub trait DirectionalAlbedo {
    /// `E(ωo)`, dimensionless.
    #[must_use]
    fn albedo(&self, wo: Vec3) -> f32;

    /// `E_avg`, dimensionless.
    ///
    /// The default integrates [`albedo`](Self::albedo) with eight cosines and eight azimuths.
    #[must_use]
    fn mean_albedo(&self) -> f32 {
        hemispherical_mean(self)
    }
}

/// `E_avg` by eight cosines and eight azimuths.
pub(super) fn hemispherical_mean(albedo: &(impl DirectionalAlbedo + ?Sized)) -> f32 {
    let ring = |[z, weight]: [f32; 2]| {
        let across = sqrt((1.0 - z * z).max(0.0));
        let toward = |turn: f32| Vec3::new(across * cos(turn), across * sin(turn), z);
        let sum: f32 = (0..8_u8).map(|k| albedo.albedo(toward(0.25 * PI * f32::from(k)))).sum();
        0.125 * weight * sum
    };
    MEAN_NODES.into_iter().map(ring).sum()
}

impl<E: DirectionalAlbedo + ?Sized> DirectionalAlbedo for &E {
    fn albedo(&self, wo: Vec3) -> f32 {
        (**self).albedo(wo)
    }

    fn mean_albedo(&self) -> f32 {
        (**self).mean_albedo()
    }
}

/// The albedo of a BRDF seen from `wo`: the mean weight of its low-discrepancy samples.
///
/// ```text
/// ∫ f(ωo, ωi) |cos θ_i| dω_i ≈ Σ weight / samples
/// ```
///
/// - **Range:** at least 0; 0 without samples and for directions that the BRDF rejects.
/// - **Accuracy:** the error decreases almost as `1/samples`. For GGX with 4096 samples it is
///   below 10⁻³, with 65,536 below 10⁻⁴.
/// - **Deterministic**, by [`low_discrepancy_points`].
///
/// ```
/// use asperity_shading::reflectance::directional_albedo;
/// use asperity_shading::{CookTorrance, Ggx, glam::Vec3};
///
/// // A rough mirror loses more than two thirds of the light.
/// let mirror = CookTorrance::new(Ggx::isotropic(1.0)?, Vec3::ONE);
/// assert!((directional_albedo(&mirror, Vec3::Z, 4096).x - 0.307).abs() < 1e-3);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "furnace")]
#[must_use]
pub fn directional_albedo<B: Brdf + ?Sized>(brdf: &B, wo: Vec3, samples: u32) -> Vec3 {
    let weights = low_discrepancy_points(samples).filter_map(|(uc, u, _)| brdf.sample(wo, uc, u));
    let mut sum = [0.0_f64; 3];
    for sample in weights {
        for (sum, weight) in sum.iter_mut().zip(sample.weight().to_array()) {
            *sum += f64::from(weight);
        }
    }
    Vec3::from(sum.map(|sum| (sum / f64::from(samples.max(1))) as f32))
}
