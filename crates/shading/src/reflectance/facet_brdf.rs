//! The `FacetBrdf` trait: BRDFs of facets of which a pixel resolves a part.

use asperity_ndf_sampling::inverse_gaussian_cdf;
use glam::{Vec2, Vec3};

use crate::level_of_detail::ResolvedBumps;
use crate::math::clamp_to;
use crate::reflectance::brdf::{Brdf, BsdfSample};

/// A microfacet BRDF or BSDF whose facets are bumps, of which a pixel resolves a part.
///
/// ```text
/// f_s(ωo, ωi | z_b) = f(ωo, ωi) · Π_k N(z_k; √s z_b,k, 1 − s) / N(z_k; 0, 1),     z = T_o⁻¹(h),  k = 1, 2
/// ```
///
/// Here `f` is [`eval`](Brdf::eval), the BRDF from afar, and `T_o` maps Gaussian pairs to the
/// visible normals of the view, see [`VisibleFacets`](asperity_ndf_sampling::VisibleFacets).
///
/// - **Mean:** over a surface with Gaussian bumps the mean of `f_s` is `f`, for every pair of
///   directions and every resolved fraction `s`, with masking, Fresnel term and any factor of the
///   directions.
/// - **Energy:** with an NDF in closed form every point scatters at most the light that it receives
///   if `f` is a single-scattering model, because the visible normals integrate to 1. With a
///   `Masked` table they integrate to 1 within 6 % rms.
/// - **Sampling:** [`sample_resolved`](Self::sample_resolved) draws from the visible normals that
///   are left. In closed form the weight of a sample is `F G₂/G₁`, or `G₁(ωi)` through glass: at
///   most 1, at every zoom.
/// - **Limits:** with [`ResolvedBumps::FAR`] all methods are those of [`Brdf`], bit for bit.
/// - **Reciprocity:** in the mean over the surface, but not at a point, because visible normals
///   depend on the view.
///
/// The trait is dyn-compatible. [`Lobe::bumps`](crate::reflectance::Lobe::bumps) is the [`Brdf`] at a point.
///
/// ```
/// use asperity_shading::level_of_detail::ResolvedBumps;
/// use asperity_shading::reflectance::FacetBrdf;
/// use asperity_shading::{CookTorrance, Ggx, glam::{Vec2, Vec3}};
///
/// let copper = CookTorrance::new(Ggx::new(0.2, 0.4)?, Vec3::new(0.95, 0.64, 0.54));
/// let (wo, near) = (Vec3::new(0.6, 0.0, 0.8), ResolvedBumps { z: Vec2::new(0.8, -0.3), variance: 0.75, blend: 1.0 });
/// let sample = copper.sample_resolved(wo, 0.5, Vec2::new(0.3, 0.6), near).ok_or("below the horizon")?;
/// assert!((sample.pdf - copper.pdf_resolved(wo, sample.wi, near)).abs() < 1e-3 * sample.pdf);
/// assert!(sample.weight().max_element() <= 1.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "level of detail")]
pub trait FacetBrdf: Brdf {
    /// `f_s(ωo, ωi)` in sr⁻¹, linear RGB; without the cosine.
    #[must_use]
    fn eval_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> Vec3;

    /// Samples a direction of the light that leaves along `wo`; arguments as for
    /// [`Brdf::sample`].
    #[must_use]
    fn sample_resolved(&self, wo: Vec3, uc: f32, u: Vec2, bumps: ResolvedBumps) -> Option<BsdfSample>;

    /// The density of [`sample_resolved`](Self::sample_resolved) over solid angle, in sr⁻¹.
    #[must_use]
    fn pdf_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> f32;

    /// The radiance emitted towards `wo` regardless of the light. Default: none.
    #[must_use]
    fn emitted(&self, wo: Vec3) -> Vec3 {
        let _ = wo;
        Vec3::ZERO
    }
}

impl<B: FacetBrdf + ?Sized> FacetBrdf for &B {
    fn eval_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> Vec3 {
        (**self).eval_resolved(wo, wi, bumps)
    }

    fn sample_resolved(&self, wo: Vec3, uc: f32, u: Vec2, bumps: ResolvedBumps) -> Option<BsdfSample> {
        (**self).sample_resolved(wo, uc, u, bumps)
    }

    fn pdf_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> f32 {
        (**self).pdf_resolved(wo, wi, bumps)
    }

    fn emitted(&self, wo: Vec3) -> Vec3 {
        (**self).emitted(wo)
    }
}

/// Two standard Gaussian numbers from uniform ones.
pub(super) fn gaussians(u: Vec2) -> Vec2 {
    // Within 6 standard deviations.
    let gauss = |u: f32| inverse_gaussian_cdf(f64::from(clamp_to(u, 1.0)).clamp(1e-9, 1.0 - 1e-9)) as f32;
    Vec2::new(gauss(u.x), gauss(u.y))
}
