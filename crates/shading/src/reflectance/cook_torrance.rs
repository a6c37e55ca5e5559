//! The Cook–Torrance microfacet model with Smith masking and shadowing.

use asperity_ndf_sampling::{ConditionalNdf, GaussianSplit, Microfacet, Ndf, VisibleFacets, VisibleWarp};
use glam::{Vec2, Vec3};

use crate::direction::{half_vector, reflect};
use crate::level_of_detail::ResolvedBumps;
use crate::reflectance::brdf::{Brdf, BsdfSample, are_above, finite, mirrored_pdf};
use crate::reflectance::facet_brdf::{FacetBrdf, gaussians};
use crate::reflectance::fresnel::Fresnel;

/// The Cook–Torrance microfacet model with Smith masking and shadowing.
///
/// ```text
/// f_r = D(h) F(ωo·h) G₂(ωi, ωo) / (4 cos θ_i cos θ_o)
/// ```
///
/// - **Domain:** any NDF with Smith masking, any [`Fresnel`] reflectance.
/// - **Range:** at least 0, finite; reciprocal.
/// - **Energy:** the albedo is at most that of the facets. The missing part is multiple scattering
///   between facets, which the model omits. Straight down 0.50 of the albedo remains for GGX of
///   roughness 0.7, and 0.75 for Beckmann.
/// - **Sampling:** [visible normals for reflections](Microfacet::sample_reflecting), reflected; the
///   weight of a sample is at most `F G₂/G₁(ωo)`.
/// - **Bumps:** as a [`FacetBrdf`] it resolves a part of its facets. Its mean over the surface is
///   the BRDF from afar.
///
/// Torrance, Sparrow 1967; Cook, Torrance 1982, *A Reflectance Model for Computer Graphics*; with
/// the denominator of Walter, Marschner, Li, Torrance 2007, *Microfacet Models for Refraction
/// through Rough Surfaces*, eq. 20.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::{Brdf, CookTorrance, Ggx, Schlick};
///
/// let metal = CookTorrance::new(Ggx::new(0.2, 0.4)?, Schlick::new(0.9)?);
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let sample = metal.sample(wo, 0.5, Vec2::new(0.3, 0.6)).unwrap();
/// assert!(sample.weight().max_element() <= 1.0 + 1e-5);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "microfacet")]
#[doc(alias = "specular")]
#[doc(alias = "glossy")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookTorrance<D, F> {
    density: D,
    fresnel: F,
    masking: Masking,
    bumps: BumpFacets,
}

/// The facets to which a [`FacetBrdf`] applies the exact rule of level of detail.
///
/// Both have the mean of the BRDF from afar.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum BumpFacets {
    /// The visible normals of the view. No point scatters more light than it receives.
    #[default]
    Visible,
    /// All normals, by area. Reciprocal at every point, but a point can scatter more light than it
    /// receives: for GGX of roughness 0.5 at 80° one in a thousand scatters seven times as much.
    All,
}

/// Masking-shadowing function G₂: height-correlated or separable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Masking {
    /// Height-correlated: `G₂ = 1/(1 + Λ(ωi) + Λ(ωo))` (Heitz 2014, eq. 99).
    #[default]
    Correlated,
    /// Separable, as if independent: `G₂ = G₁(ωi) G₁(ωo)`, which is darker.
    Separable,
}

impl<D: Microfacet, F: Fresnel> CookTorrance<D, F> {
    /// Creates the surface with this NDF and facet reflectance, with height-correlated masking.
    #[must_use]
    pub const fn new(density: D, fresnel: F) -> Self {
        Self { density, fresnel, masking: Masking::Correlated, bumps: BumpFacets::Visible }
    }

    /// Sets the masking.
    #[must_use]
    pub fn with_masking(self, masking: Masking) -> Self {
        Self { masking, ..self }
    }

    /// Sets the facets of which a pixel resolves a part.
    #[must_use]
    pub fn with_bump_facets(self, bumps: BumpFacets) -> Self {
        Self { bumps, ..self }
    }

    /// The NDF.
    #[must_use]
    pub const fn facets(&self) -> &D {
        &self.density
    }

    /// The reflectance of the facets.
    #[must_use]
    pub const fn fresnel(&self) -> &F {
        &self.fresnel
    }

    /// Reflects `wo` at a visible facet.
    pub(super) fn direction(&self, wo: Vec3, u: Vec2) -> Vec3 {
        reflect(wo, self.density.sample_reflecting(wo, u))
    }

    /// `D G₂/(4 cos θ_i cos θ_o)` at the half vector.
    fn shown(&self, wo: Vec3, wi: Vec3, h: Vec3) -> f32 {
        let masking = match self.masking {
            Masking::Correlated => self.density.g2(wi, wo),
            Masking::Separable => self.density.g2_separable(wi, wo),
        };
        self.density.d(h) * masking / (4.0 * wi.z * wo.z)
    }
}

impl<D: Microfacet, F: Fresnel> Brdf for CookTorrance<D, F> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return Vec3::ZERO;
        }
        let h = half_vector(wi, wo);
        finite(self.shown(wo, wi, h)) * self.fresnel.reflectance_rgb(wo.dot(h))
    }

    fn sample(&self, wo: Vec3, _: f32, u: Vec2) -> Option<BsdfSample> {
        BsdfSample::from_direction(self, wo, self.direction(wo, u))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        mirrored_pdf(wo, wi, |h| self.density.reflecting_pdf(wo, h))
    }
}

impl<D: VisibleWarp, F: Fresnel> FacetBrdf for CookTorrance<D, F> {
    fn eval_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> Vec3 {
        if !bumps.are_resolved() || !are_above(wi, wo) {
            return self.eval(wo, wi);
        }
        let h = half_vector(wi, wo);
        let z = match self.bumps {
            BumpFacets::Visible => self.density.invert_visible(wo, h),
            BumpFacets::All => self.density.invert(h),
        };
        let split = GaussianSplit::new(bumps.z, bumps.variance);
        finite(split.weigh(self.shown(wo, wi, h), z)) * self.fresnel.reflectance_rgb(wo.dot(h))
    }

    fn sample_resolved(&self, wo: Vec3, uc: f32, u: Vec2, bumps: ResolvedBumps) -> Option<BsdfSample> {
        if !bumps.are_resolved() {
            return self.sample(wo, uc, u);
        }
        let m = match self.bumps {
            BumpFacets::Visible => self.visible(wo, bumps).warp_gaussian(gaussians(u)),
            BumpFacets::All => self.all(bumps).sample(u),
        };
        let wi = reflect(wo, m);
        let pdf = self.pdf_resolved(wo, wi, bumps);
        BsdfSample::with_pdf(wo, wi, pdf, || self.eval_resolved(wo, wi, bumps) * wi.z)
    }

    fn pdf_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> f32 {
        if !bumps.are_resolved() {
            return self.pdf(wo, wi);
        }
        mirrored_pdf(wo, wi, |h| match self.bumps {
            BumpFacets::Visible => self.visible(wo, bumps).pdf(h),
            BumpFacets::All => self.all(bumps).pdf(h),
        })
    }
}

impl<D: VisibleWarp, F> CookTorrance<D, F> {
    fn visible(&self, wo: Vec3, bumps: ResolvedBumps) -> VisibleFacets<&D> {
        VisibleFacets::new(&self.density, wo, bumps.z, bumps.variance)
    }

    fn all(&self, bumps: ResolvedBumps) -> ConditionalNdf<&D> {
        ConditionalNdf::new(&self.density, bumps.z, bumps.variance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reflectance::torrance_sparrow::TorranceSparrow;
    use asperity_ndf_sampling::{Beckmann, Ggx, Ndf};

    #[test]
    fn cook_torrance_at_normal_incidence_is_a_quarter_of_the_peak() {
        let ndf = Ggx::isotropic(0.5).unwrap();
        let smith = CookTorrance::new(ndf, Vec3::ONE).eval(Vec3::Z, Vec3::Z);
        let grooves = TorranceSparrow::new(ndf, Vec3::ONE).eval(Vec3::Z, Vec3::Z);
        let expected = Vec3::splat(0.25 * ndf.d(Vec3::Z));
        assert!((smith - expected).length() < 1e-6 && (grooves - expected).length() < 1e-6);
    }

    #[test]
    fn separable_masking_is_darker() {
        let (wi, wo) = (Vec3::new(0.96, 0.0, 0.28), Vec3::new(-0.96, 0.0, 0.28));
        let correlated = CookTorrance::new(Beckmann::isotropic(0.8).unwrap(), Vec3::ONE);
        let separable = correlated.with_masking(Masking::Separable);
        assert!(separable.eval(wo, wi).x < 0.98 * correlated.eval(wo, wi).x);
    }

    #[test]
    fn cook_torrance_of_smooth_mirrors_is_finite() {
        let ndf = Ggx::isotropic(1e-4).unwrap();
        let low = Vec3::new(1.0, 0.0, 1e-20);
        for (wi, wo) in [(Vec3::Z, Vec3::Z), (low, low), (low, Vec3::new(-1.0, 0.0, 1e-20))] {
            assert!(CookTorrance::new(ndf, Vec3::ONE).eval(wo, wi).is_finite());
            assert!(TorranceSparrow::new(ndf, Vec3::ONE).eval(wo, wi).is_finite());
        }
    }
}
