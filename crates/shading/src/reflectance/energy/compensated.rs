//! BRDFs that return the light of multiple scattering.

use asperity_ndf_sampling::Ggx;
use glam::{Vec2, Vec3};

use crate::level_of_detail::ResolvedBumps;
use crate::reflectance::brdf::{Brdf, BsdfSample, finite};
use crate::reflectance::cook_torrance::CookTorrance;
use crate::reflectance::energy::albedo::DirectionalAlbedo;
use crate::reflectance::energy::ggx::GgxAlbedo;
use crate::reflectance::energy::glass::GlassAlbedo;
use crate::reflectance::facet_brdf::FacetBrdf;
use crate::reflectance::fresnel::{Dielectric, Fresnel};
use crate::reflectance::rough_dielectric::RoughDielectric;

/// A single-scattering microfacet BRDF, scaled to return the light of further bounces.
///
/// ```text
/// f    = f_ss (1 + F_ms (1 − E(ωo))/E(ωo))
/// F_ms = F_avg E_avg / (1 − F_avg (1 − E_avg)),     F_avg = 2 ∫ F(cos θ) cos θ dcos θ
/// ```
///
/// The fraction 1 − E of the light stays between the facets after one bounce. Each further bounce
/// reflects `F_avg` of it, of which `E_avg` leaves. `F_ms` is the sum of this series. With facets
/// that lose nothing, `F_avg = 1` and the factor is 1/E: rough glass, or a white metal.
///
/// - **Energy:** with a constant F the albedo is `F E + F (1 − E) F_ms`, the sum of all bounces. For
///   `F = 1` it is 1. Measured in a white furnace for roughness
///   from 0.05 to 1 at every angle: metal within 0.02 %, glass as accurate as [`GlassAlbedo`].
/// - **Sampling:** that of the inner BRDF. Weights are scaled by [`factor`](Self::factor).
/// - **Reciprocity** is given up: the factor depends on ωo alone. The reciprocal form of Kulla and
///   Conty adds a lobe, which needs its own samples and a second table at ωi. The factor keeps the
///   lobe, its samples and its bounded weights.
/// - **Bumps:** the factor does not depend on them, so the mean over a bump map is that of the far
///   field. A single point can scatter up to 1/E of the light, because it gets the factor of the
///   mean.
/// - **Any input** is valid, as for the inner BRDF.
///
/// Turquin 2019, *Practical multiple scattering compensation for microfacet models*, eq. 16, with
/// the series of Kulla, Conty 2017, *Revisiting Physically Based Shading at Imageworks*, in place
/// of `F₀`.
///
/// ```
/// use asperity_shading::reflectance::{EnergyCompensated, directional_albedo};
/// use asperity_shading::{CookTorrance, Ggx, glam::Vec3};
///
/// let (ggx, wo) = (Ggx::isotropic(0.8)?, Vec3::new(0.6, 0.0, 0.8));
/// let dark = directional_albedo(&CookTorrance::new(ggx, Vec3::ONE), wo, 4096).x;
/// let white = directional_albedo(&EnergyCompensated::metal(ggx, Vec3::ONE), wo, 4096).x;
/// assert!(dark < 0.6 && (white - 1.0).abs() < 2e-3);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "multiple scattering")]
#[doc(alias = "kulla-conty")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyCompensated<B, E> {
    brdf: B,
    albedo: E,
    bounces: Vec3,
}

impl<B: Brdf, E: DirectionalAlbedo> EnergyCompensated<B, E> {
    /// Scales `brdf`, whose white form has this `albedo`, for facets with this reflectance.
    ///
    /// Pass [`Vec3::ONE`] for facets that lose nothing, such as those of glass.
    #[must_use]
    pub fn new(brdf: B, albedo: E, fresnel: &(impl Fresnel + ?Sized)) -> Self {
        let bounces = multiple_bounces(fresnel.mean_reflectance_rgb(), albedo.mean_albedo());
        Self { brdf, albedo, bounces }
    }

    /// The single-scattering BRDF.
    #[must_use]
    pub const fn single(&self) -> &B {
        &self.brdf
    }

    /// `1 + F_ms (1 − E)/E`: the factor of the single-scattering BRDF seen from `wo`, at least 1.
    #[must_use]
    pub fn factor(&self, wo: Vec3) -> Vec3 {
        let e = in_range(self.albedo.albedo(wo));
        Vec3::ONE + self.bounces * ((1.0 - e) / e)
    }
}

impl<F: Fresnel> EnergyCompensated<CookTorrance<Ggx, F>, GgxAlbedo> {
    /// GGX mirrors with every bounce.
    ///
    /// See [`GgxAlbedo`] for the accuracy with anisotropic facets.
    #[must_use]
    pub fn metal(ggx: Ggx, fresnel: F) -> Self {
        let albedo = GgxAlbedo::new(&ggx);
        let bounces = multiple_bounces(fresnel.mean_reflectance_rgb(), albedo.mean_albedo());
        Self { brdf: CookTorrance::new(ggx, fresnel), albedo, bounces }
    }
}

impl EnergyCompensated<RoughDielectric<Ggx>, GlassAlbedo> {
    /// The surface of rough glass with every bounce: reflection plus transmission is 1.
    ///
    /// See [`GlassAlbedo`] for the accuracy with anisotropic facets.
    #[must_use]
    pub fn glass(ggx: Ggx, fresnel: Dielectric) -> Self {
        let albedo = GlassAlbedo::new(&ggx, &fresnel);
        Self { brdf: RoughDielectric::new(ggx, fresnel), albedo, bounces: Vec3::ONE }
    }
}

/// An albedo of any implementation; NaN is read as 1.
fn in_range(albedo: f32) -> f32 {
    if albedo.is_nan() { 1.0 } else { albedo.clamp(1e-3, 1.0) }
}

/// `F_ms` of a mean reflectance of facets and a mean albedo.
pub(in crate::reflectance) fn multiple_bounces(f_avg: Vec3, e_avg: f32) -> Vec3 {
    let (f_avg, e_avg) = (f_avg.clamp(Vec3::ZERO, Vec3::ONE), in_range(e_avg));
    f_avg * e_avg / (Vec3::ONE - f_avg * (1.0 - e_avg))
}

impl<B: Brdf, E: DirectionalAlbedo> EnergyCompensated<B, E> {
    fn scaled(&self, wo: Vec3, sample: BsdfSample) -> BsdfSample {
        BsdfSample { eval_cos: (sample.eval_cos * self.factor(wo)).map(finite), ..sample }
    }
}

impl<B: Brdf, E: DirectionalAlbedo> Brdf for EnergyCompensated<B, E> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        (self.brdf.eval(wo, wi) * self.factor(wo)).map(finite)
    }

    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        self.brdf.sample(wo, uc, u).map(|sample| self.scaled(wo, sample))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.brdf.pdf(wo, wi)
    }

    fn transmits(&self) -> bool {
        self.brdf.transmits()
    }
}

impl<B: FacetBrdf, E: DirectionalAlbedo> FacetBrdf for EnergyCompensated<B, E> {
    fn eval_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> Vec3 {
        (self.brdf.eval_resolved(wo, wi, bumps) * self.factor(wo)).map(finite)
    }

    fn sample_resolved(&self, wo: Vec3, uc: f32, u: Vec2, bumps: ResolvedBumps) -> Option<BsdfSample> {
        self.brdf.sample_resolved(wo, uc, u, bumps).map(|sample| self.scaled(wo, sample))
    }

    fn pdf_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> f32 {
        self.brdf.pdf_resolved(wo, wi, bumps)
    }

    fn emitted(&self, wo: Vec3) -> Vec3 {
        self.brdf.emitted(wo)
    }
}
