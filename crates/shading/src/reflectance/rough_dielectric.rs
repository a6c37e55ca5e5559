//! Rough glass: microfacets that reflect and refract.

use asperity_ndf_sampling::{GaussianSplit, Microfacet, VisibleFacets, VisibleWarp};
use glam::{Vec2, Vec3};

use crate::direction::{half_vector, reflect};
use crate::level_of_detail::ResolvedBumps;
use crate::math::{clamp_to, sqrt};
use crate::reflectance::absorption::through_wall;
use crate::reflectance::brdf::{Brdf, BsdfSample, finite, have_sides};
use crate::reflectance::facet_brdf::{FacetBrdf, gaussians};
use crate::reflectance::fresnel::Dielectric;

/// Rough glass: the microfacet BSDF of Walter et al. (2007) for any NDF with Smith masking.
///
/// ```text
/// reflection     f = D(h) F G₁(ωi) G₁(ωo) / (4 |cos θ_i cos θ_o|),                           h ∝ ωi + ωo
/// transmission   f = D(h) (1 − F) G₁(ωi) G₁(ωo) |ωi·h ωo·h| η_i² / (|cos θ_i cos θ_o| (η_i ωi·h + η_o ωo·h)²)
///                                                                                            h ∝ η_i ωi + η_o ωo
/// thin wall      f = D(h) (1 − R) G₂(ωi′, ωo) tint^(1/cos θ_t) / (4 |cos θ_i cos θ_o|),      R = 2F/(1 + F), ωi′ = ωi mirrored
/// ```
///
/// with the indices η_i and η_o of the sides of ωi and ωo: 1 above the surface, the relative index
/// of the [`Dielectric`] below. A view from below sees the backs of the same facets, for which
/// `G₁(ω)` is evaluated at −ω.
///
/// - **Radiance over η²:** the change of radiance by `η_o²/η_i²` is omitted, as in
///   [`Coat::dielectric`](crate::reflectance::Coat::dielectric), because it is undone where the
///   light leaves. For radiance itself multiply the transmitted light by it (eq. 21 of Walter et
///   al. includes it).
/// - **Domain:** directions on both sides of the surface. An index closer to 1 than 0.01 is moved
///   away from 1, because transmission has no density if there is hardly an interface.
/// - **Range:** at least 0, finite; `η_o² f(ωi, ωo) = η_i² f(ωo, ωi)`. A thin wall is reciprocal
///   for NDFs that are symmetric around the normal.
/// - **Accuracy:** within 1.1·10⁻⁴ of the values of Mitsuba 3.9.1 for GGX, which are in `f32` too.
///   Single pairs of directions near the critical angle are the exception: the reflectance has an
///   infinite slope there, and the rounding of a direction changes it. For an index of 1.05 they
///   differ from Mitsuba by up to 1.3·10⁻³, and from values in `f64` by up to 4·10⁻³. Both
///   directions agree to 2·10⁻⁵.
/// - **Energy:** the albedo over both hemispheres is 1 except for the loss by shadowing,
///   `E[G₁(ωi)]` over visible normals. It decreases with roughness and towards the horizon, because
///   multiple scattering is omitted. A thin wall also loses the light absorbed by its tint.
/// - **Sampling:** visible normals (Heitz 2018), each reflected with the probability `F` of its
///   facet, otherwise refracted. The weight of a sample is `G₁(ωi)`, and `G₂/G₁(ωo)` times the tint
///   for a wall.
/// - **Bumps:** as a [`FacetBrdf`] it resolves a part of its facets, seen from either side.
/// - **Thin wall:** a sheet with the same facets on both sides, treated as one surface.
///   Transmission is the mirror image of reflection with `1 − R` in place of `R`, so it is scattered
///   as widely. The scattering of a real sheet is narrower, about `(η − 1)/√2` of it. Masking is
///   height-correlated in both, so without a tint its albedo is that of white mirrors.
///
/// Walter, Marschner, Li, Torrance 2007, *Microfacet Models for Refraction through Rough Surfaces*,
/// eq. 20, 21 and 23; Heitz 2018, *Sampling the GGX Distribution of Visible Normals*.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::reflectance::RoughDielectric;
/// use asperity_shading::{Brdf, Dielectric, Ggx};
///
/// let frosted = RoughDielectric::new(Ggx::isotropic(0.3)?, Dielectric::new(1.5)?);
/// let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.3, 0.1, -0.9).normalize());
/// let (there, back) = (frosted.eval(wo, wi), frosted.eval(wi, wo));
/// assert!(there.x > 0.0 && (there - 2.25 * back).length() < 1e-5);
/// // Most of the light is transmitted.
/// assert!(frosted.sample(wo, 0.7, Vec2::new(0.7, 0.2)).unwrap().is_transmission());
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "frosted glass")]
#[doc(alias = "btdf")]
#[doc(alias = "microfacet")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric<D> {
    density: D,
    fresnel: Dielectric,
    /// The transmittance of a thin wall at normal incidence; `None` for the surface of a body.
    wall: Option<Vec3>,
}

/// The minimum distance of the index from 1.
const LEAST_STEP: f32 = 0.01;

/// A facet between two directions.
struct Meeting {
    /// Normal of the facet, above the surface.
    h: Vec3,
    /// |ωi·h| and |ωo·h|.
    cosines: [f32; 2],
    /// Whether it transmits.
    crosses: bool,
    /// Solid angle of facets over that of ωi: `dω_h/dω_i`.
    jacobian: f32,
}

impl<D: Microfacet> RoughDielectric<D> {
    /// Creates the surface of a body of glass with this NDF.
    #[must_use]
    pub fn new(density: D, fresnel: Dielectric) -> Self {
        Self { density, fresnel: apart(fresnel), wall: None }
    }

    /// Creates a thin wall of both its sides, with the transmittance `tint` at normal incidence.
    ///
    /// At an angle the path is longer: `tint^(1/cos θ_t)`, by the Beer–Lambert law. A tint outside
    /// `[0, 1]³` is clamped.
    #[must_use]
    pub fn thin(density: D, fresnel: Dielectric, tint: Vec3) -> Self {
        let tint = tint.map(|share| clamp_to(share, 1.0));
        Self { density, fresnel: apart(fresnel), wall: Some(tint) }
    }

    /// The NDF.
    #[must_use]
    pub const fn facets(&self) -> &D {
        &self.density
    }

    /// The interface of the facets.
    #[must_use]
    pub const fn fresnel(&self) -> &Dielectric {
        &self.fresnel
    }

    /// Interface of a facet for light from `w`.
    fn interface(&self, w: Vec3) -> Dielectric {
        if w.z < 0.0 && self.wall.is_none() { self.fresnel.reversed() } else { self.fresnel }
    }

    /// Reflectance of a facet at this angle on the side of `w`.
    fn reflectance(&self, w: Vec3, cosine: f32) -> f32 {
        let once = self.interface(w).reflectance(cosine);
        if self.wall.is_some() { 2.0 * once / (1.0 + once) } else { once }
    }

    /// The facet that scatters light of `wi` into `wo`; `None` if it would be seen from behind.
    fn meeting(&self, wi: Vec3, wo: Vec3) -> Option<Meeting> {
        if !have_sides(wi, wo) {
            return None;
        }
        let crosses = wi.z * wo.z < 0.0;
        let up = |w: Vec3| if w.z < 0.0 { -w } else { w };
        let meeting = if crosses && self.wall.is_none() {
            let relative = self.fresnel.relative_index();
            let [index_i, index_o] = if wi.z < 0.0 { [relative, 1.0] } else { [1.0, relative] };
            let sum = wi * index_i + wo * index_o;
            let h = up(sum).normalize_or_zero();
            let (i, o) = (wi.dot(h), wo.dot(h));
            let both = index_i * i + index_o * o;
            // A facet that both directions see from the same side does not refract.
            if i * wi.z <= 0.0 || o * wo.z <= 0.0 {
                return None;
            }
            let jacobian = (index_i / both) * (index_i / both) * i.abs();
            Meeting { h, cosines: [i.abs(), o.abs()], crosses, jacobian }
        } else {
            let mirrored = if crosses { Vec3::new(wi.x, wi.y, -wi.z) } else { wi };
            let h = up(half_vector(mirrored, wo));
            let cosine = 0.5 * (mirrored + wo).length();
            Meeting { h, cosines: [cosine; 2], crosses, jacobian: 0.25 / cosine }
        };
        (meeting.h.z > 0.0).then_some(meeting)
    }

    /// Reflectance of the facet of a meeting.
    fn reflectance_at(&self, wo: Vec3, meeting: &Meeting) -> f32 {
        let [incident, cosine] = meeting.cosines;
        if meeting.crosses && self.wall.is_none() {
            // Both ways from the cosine above the surface, because the one below is ill conditioned
            // near the critical angle.
            self.fresnel.reflectance(if wo.z > 0.0 { cosine } else { incident })
        } else {
            self.reflectance(wo, cosine)
        }
    }

    /// Fraction of light that the facet of a meeting scatters.
    fn share(&self, wo: Vec3, meeting: &Meeting) -> f32 {
        let reflectance = self.reflectance_at(wo, meeting);
        if meeting.crosses { 1.0 - reflectance } else { reflectance }
    }

    /// Transmittance of the material along a meeting, by color.
    fn tint(&self, meeting: &Meeting) -> Vec3 {
        match self.wall {
            Some(tint) if meeting.crosses => {
                through_wall(tint, meeting.cosines[1], self.fresnel.relative_index())
            }
            _ => Vec3::ONE,
        }
    }

    /// `D G |ωo·h| dω_h/dω_i /(|cos θ_i cos θ_o|)` of a meeting.
    fn shown(&self, wo: Vec3, wi: Vec3, meeting: &Meeting) -> f32 {
        // The far side of a thin wall is seen through it, as if light came from above.
        let (is_wall, wo_above) = (self.wall.is_some(), seen_from_above(wo));
        let back = if meeting.crosses && is_wall { Vec3::new(wi.x, wi.y, -wi.z) } else { wi };
        let wi_above = seen_from_above(back);
        let masking = if is_wall {
            self.density.g2(wi_above, wo_above)
        } else {
            self.density.g2_separable(wi_above, wo_above)
        };
        let facets = self.density.d(meeting.h) * masking * meeting.cosines[1] * meeting.jacobian;
        facets / (wi.z * wo.z).abs()
    }

    /// Reflects or refracts `wo` at a visible facet, in proportion to its reflectance.
    pub(super) fn direction(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<Vec3> {
        if !have_sides(wo, wo) {
            return None;
        }
        self.scattered(wo, uc, self.density.sample_visible(seen_from_above(wo), u))
    }

    /// Reflects or refracts `wo` at the facet `h`.
    fn scattered(&self, wo: Vec3, uc: f32, h: Vec3) -> Option<Vec3> {
        let (v, side) = (seen_from_above(wo), wo.z.signum());
        let mirrored = reflect(v, h);
        let cosine = v.dot(h);
        let reflects = clamp_to(uc, 1.0) < self.reflectance(wo, cosine);
        if reflects || self.wall.is_some() {
            let flip = if reflects { 1.0 } else { -1.0 };
            return (mirrored.z > 0.0).then_some(mirrored * Vec3::new(1.0, 1.0, flip) * side);
        }
        // Snell: sin θ_t = sin θ/η.
        let eta = 1.0 / self.interface(wo).relative_index();
        let below = 1.0 - eta * eta * (1.0 - cosine * cosine).max(0.0);
        let refracted = (eta * cosine - sqrt(below.max(0.0))) * h - eta * v;
        (below > 0.0 && refracted.z < 0.0).then_some(refracted * side)
    }
}

/// An interface whose index is at least a step away from 1.
fn apart(fresnel: Dielectric) -> Dielectric {
    let index = fresnel.relative_index();
    let away = if index < 1.0 { index.min(1.0 - LEAST_STEP) } else { index.max(1.0 + LEAST_STEP) };
    Dielectric::new_clamped(away)
}

/// The direction from which facets above look as `w` sees them.
fn seen_from_above(w: Vec3) -> Vec3 {
    if w.z < 0.0 { -w } else { w }
}

impl<D: Microfacet> Brdf for RoughDielectric<D> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let Some(meeting) = self.meeting(wi, wo) else {
            return Vec3::ZERO;
        };
        finite(self.shown(wo, wi, &meeting)) * self.share(wo, &meeting) * self.tint(&meeting)
    }

    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        BsdfSample::from_direction(self, wo, self.direction(wo, uc, u)?)
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let Some(meeting) = self.meeting(wi, wo) else {
            return 0.0;
        };
        let facets = self.density.visible_pdf(seen_from_above(wo), meeting.h);
        self.share(wo, &meeting) * finite(facets * meeting.jacobian)
    }

    fn transmits(&self) -> bool {
        true
    }
}

impl<D: VisibleWarp> FacetBrdf for RoughDielectric<D> {
    fn eval_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> Vec3 {
        let Some(meeting) = self.meeting(wi, wo).filter(|_| bumps.are_resolved()) else {
            return self.eval(wo, wi);
        };
        let split = GaussianSplit::new(bumps.z, bumps.variance);
        let z = self.density.invert_visible(seen_from_above(wo), meeting.h);
        finite(split.weigh(self.shown(wo, wi, &meeting), z)) * self.share(wo, &meeting) * self.tint(&meeting)
    }

    fn sample_resolved(&self, wo: Vec3, uc: f32, u: Vec2, bumps: ResolvedBumps) -> Option<BsdfSample> {
        if !bumps.are_resolved() || !have_sides(wo, wo) {
            return self.sample(wo, uc, u);
        }
        let wi = self.scattered(wo, uc, self.visible(wo, bumps).warp_gaussian(gaussians(u)))?;
        let pdf = self.pdf_resolved(wo, wi, bumps);
        BsdfSample::with_pdf(wo, wi, pdf, || self.eval_resolved(wo, wi, bumps) * wi.z.abs())
    }

    fn pdf_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> f32 {
        let Some(meeting) = self.meeting(wi, wo).filter(|_| bumps.are_resolved()) else {
            return self.pdf(wo, wi);
        };
        self.share(wo, &meeting) * finite(self.visible(wo, bumps).pdf(meeting.h) * meeting.jacobian)
    }
}

impl<D: VisibleWarp> RoughDielectric<D> {
    fn visible(&self, wo: Vec3, bumps: ResolvedBumps) -> VisibleFacets<&D> {
        VisibleFacets::new(&self.density, seen_from_above(wo), bumps.z, bumps.variance)
    }
}
