//! The layers of the standard materials: fuzz over a coat over gloss, diffuse light and glass.

use asperity_ndf_sampling::Ggx;
use glam::{Vec2, Vec3};

use crate::level_of_detail::ResolvedBumps;
use crate::math::clamp_to;
use crate::reflectance::absorption::through_wall;
use crate::reflectance::brdf::{Brdf, BsdfSample, finite, have_sides};
use crate::reflectance::cook_torrance::CookTorrance;
use crate::reflectance::diffuse::EnergyPreservingOrenNayar;
use crate::reflectance::energy::{DirectionalAlbedo, GgxAlbedo, GlassAlbedo, multiple_bounces};
use crate::reflectance::facet_brdf::FacetBrdf;
use crate::reflectance::fresnel::{Dielectric, Fresnel, SchlickRgb};
use crate::reflectance::fuzz::{CharlieSheen, ZeltnerFuzz};
use crate::reflectance::rough_dielectric::RoughDielectric;
use crate::reflectance::standard::relief::relief;

/// A stack of layers; each passes the light that it does not reflect to the layers below.
///
/// ```text
/// f = f_fuzz + (1 − E_fuzz) (w_c f_coat + (1 − w_c E_coat) (g f_gloss + d (1 − E_d) f_diffuse + t f_glass))
/// ```
///
/// with the directional albedos E of the layers, all seen from ωo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::reflectance) struct Layers {
    /// Cosine and sine of the azimuth of the facets.
    pub turn: Vec2,
    pub fuzz: Fuzz,
    pub coat: Coating,
    /// The factor of everything below the coat.
    pub below_coat: Vec3,
    pub gloss: Gloss,
    /// The fraction of the surface that is not glass.
    pub opaque: f32,
    /// The reflectance of the interface over the diffuse light.
    pub interface: Reflectance,
    /// The diffuse light below that interface.
    pub diffuse: EnergyPreservingOrenNayar,
    pub glass: Option<Glass>,
    pub emitted: Vec3,
}

/// Fibers over everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fuzz {
    None,
    Charlie(CharlieSheen),
    /// A fraction of the surface is covered.
    Zeltner(ZeltnerFuzz, f32),
}

/// A varnish that covers a fraction of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coating {
    pub weight: f32,
    pub gloss: Gloss,
    /// The transmittance of one pass at normal incidence.
    pub tint: Vec3,
    pub relative_index: f32,
}

/// GGX mirrors with every bounce.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gloss {
    facets: CookTorrance<Ggx, SchlickRgb>,
    albedo: GgxAlbedo,
    reflectance: Reflectance,
}

/// The reflectance of facets, and of all their further bounces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reflectance {
    fresnel: SchlickRgb,
    bounces: Vec3,
}

/// A fraction of the surface that is glass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Glass {
    weight: f32,
    facets: RoughDielectric<Ggx>,
    /// The albedo of a body; a thin wall has that of mirrors.
    body: Option<GlassAlbedo>,
    /// The factor of light that crosses the surface of a body.
    tint: Vec3,
}

impl Reflectance {
    /// The reflectance with all bounces of facets that have the albedo of this table.
    pub(super) fn new(fresnel: SchlickRgb, albedo: &GgxAlbedo) -> Self {
        Self { fresnel, bounces: multiple_bounces(fresnel.mean_reflectance_rgb(), albedo.mean_albedo()) }
    }

    /// The factor of one bounce that adds the others.
    fn factor(&self, [e, _]: [f32; 2]) -> Vec3 {
        Vec3::ONE + self.bounces * ((1.0 - e) / e)
    }

    /// The directional albedo without the dip of metals.
    fn albedo(&self, [e, grazing]: [f32; 2]) -> Vec3 {
        let once = self.fresnel.f0 * (e - grazing) + self.fresnel.f90 * grazing;
        (once * self.factor([e, grazing])).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

impl Gloss {
    pub(super) fn new(ggx: Ggx, fresnel: SchlickRgb) -> Self {
        let albedo = GgxAlbedo::new(&ggx);
        let reflectance = Reflectance::new(fresnel, &albedo);
        Self { facets: CookTorrance::new(ggx, fresnel), albedo, reflectance }
    }

    pub(super) fn table(&self) -> &GgxAlbedo {
        &self.albedo
    }
}

impl Glass {
    /// The surface of a body.
    pub(super) fn body(weight: f32, ggx: Ggx, fresnel: Dielectric, tint: Vec3) -> Self {
        let body = Some(GlassAlbedo::new(&ggx, &fresnel));
        Self { weight, facets: RoughDielectric::new(ggx, fresnel), body, tint }
    }

    /// A thin wall of this transmittance.
    pub(super) fn thin(weight: f32, ggx: Ggx, fresnel: Dielectric, tint: Vec3) -> Self {
        Self { weight, facets: RoughDielectric::thin(ggx, fresnel, tint), body: None, tint: Vec3::ONE }
    }

    /// Its albedo, `e` being that of mirrors.
    fn albedo(&self, wo: Vec3, e: f32) -> f32 {
        self.body.map_or(e, |body| body.albedo(wo))
    }
}

impl Fuzz {
    /// Its albedo and the fraction of the light that the layers below receive.
    fn split(&self, cos_theta: f32) -> (Vec3, f32) {
        match self {
            Self::None => (Vec3::ZERO, 1.0),
            Self::Charlie(sheen) => {
                let albedo = sheen.albedo(cos_theta);
                (albedo, 1.0 - albedo.max_element())
            }
            Self::Zeltner(fuzz, weight) => {
                let albedo = *weight * fuzz.albedo(cos_theta);
                (albedo, 1.0 - albedo.max_element())
            }
        }
    }

    /// The BRDF and its weight.
    fn brdf(&self) -> Option<(&dyn Brdf, f32)> {
        match self {
            Self::None => None,
            Self::Charlie(sheen) => Some((sheen, 1.0)),
            Self::Zeltner(fuzz, weight) => Some((fuzz, *weight)),
        }
    }
}

const FUZZ: usize = 0;
const COAT: usize = 1;
const GLOSS: usize = 2;
const DIFFUSE: usize = 3;
const GLASS: usize = 4;

/// The lobes seen from a direction.
struct View {
    wo: Vec3,
    bumps: ResolvedBumps,
    /// The factor of each lobe.
    weights: [Vec3; 5],
    /// The probability of each lobe.
    chances: [f32; 5],
}

impl Layers {
    /// The coordinates of a direction along the axes of the facets.
    fn turned(&self, w: Vec3) -> Vec3 {
        let Vec2 { x: cos, y: sin } = self.turn;
        Vec3::new(cos * w.x + sin * w.y, cos * w.y - sin * w.x, w.z)
    }

    fn turned_back(&self, w: Vec3) -> Vec3 {
        let Vec2 { x: cos, y: sin } = self.turn;
        Vec3::new(cos * w.x - sin * w.y, sin * w.x + cos * w.y, w.z)
    }

    /// −1 for a view of the back of a thin wall: each facet shows its other side there, so all
    /// directions change their sign and the bumps keep their coordinates.
    fn side(&self, wo: Vec3) -> f32 {
        if wo.z < 0.0 && self.glass.is_some_and(|glass| glass.body.is_none()) { -1.0 } else { 1.0 }
    }

    /// The fraction of light from `w` that fuzz and coat do not reflect.
    fn passed(&self, w: Vec3) -> f32 {
        let (_, below) = self.fuzz.split(w.z);
        below * (1.0 - self.coat.weight * self.coat.albedo(w))
    }

    /// The lobes seen from `wo` in the frame of the surface; `None` where it shows nothing.
    fn view(&self, wo: Vec3, bumps: ResolvedBumps) -> Option<View> {
        if !have_sides(wo, wo) {
            return None;
        }
        let z = self.turned(bumps.z.extend(0.0)).truncate();
        let (wo, bumps) = (self.side(wo) * self.turned(wo), ResolvedBumps { z, ..bumps });
        let (mut weights, mut chances) = ([Vec3::ZERO; 5], [0.0; 5]);
        if wo.z < 0.0 {
            // From inside only the glass is seen.
            let glass = self.glass?;
            let weight = glass.weight / glass.albedo(wo, 1.0);
            (weights[GLASS], chances[GLASS]) = (Vec3::splat(weight), 1.0);
            return Some(View { wo, bumps, weights, chances });
        }
        // Each lobe with its factor and its albedo.
        let mut set = |lobe: usize, factor: Vec3, albedo: Vec3| {
            weights[lobe] = factor;
            chances[lobe] = finite(albedo.element_sum());
        };
        let (fuzz, mut passed) = self.fuzz.split(wo.z);
        set(FUZZ, Vec3::ONE, fuzz);
        if self.coat.weight > 0.0 {
            let (seen, gloss) = (self.coat.gloss.albedo.moments(wo), &self.coat.gloss.reflectance);
            let (scale, albedo) = (passed * self.coat.weight, gloss.albedo(seen));
            set(COAT, scale * gloss.factor(seen), scale * albedo);
            passed *= 1.0 - self.coat.weight * albedo.max_element();
        }
        let (below, seen) = (passed * self.below_coat, self.gloss.albedo.moments(wo));
        if self.opaque > 0.0 {
            let (scale, gloss) = (self.opaque * below, &self.gloss.reflectance);
            set(GLOSS, scale * gloss.factor(seen), scale * gloss.albedo(seen));
        }
        if self.diffuse.albedo() != Vec3::ZERO {
            let scale = below * (1.0 - self.interface.albedo(seen).max_element());
            set(DIFFUSE, scale, scale * self.diffuse.albedo());
        }
        if let Some(glass) = self.glass {
            let scale = glass.weight * below;
            set(GLASS, scale / glass.albedo(wo, seen[0]), scale);
        }
        let sum: f32 = chances.iter().sum();
        (sum > 0.0).then(|| View { wo, bumps, weights, chances: chances.map(|chance| chance / sum) })
    }

    /// The sum of all lobes, with directions in the frame of the facets.
    fn value(&self, view: &View, wi: Vec3) -> Vec3 {
        let View { wo, bumps, ref weights, .. } = *view;
        if !have_sides(wi, wo) {
            return Vec3::ZERO;
        }
        let above = wi.z > 0.0 && wo.z > 0.0;
        let mut under = Vec3::ZERO;
        if above {
            if weights[GLOSS] != Vec3::ZERO {
                under += weights[GLOSS] * self.gloss.facets.eval_resolved(wo, wi, bumps);
            }
            if weights[DIFFUSE] != Vec3::ZERO {
                let alpha = self.gloss.alpha();
                under += weights[DIFFUSE] * self.diffuse.eval(wo, wi) * relief(alpha, wi, bumps);
            }
        }
        if let Some(glass) = &self.glass {
            let crosses = wi.z * wo.z < 0.0;
            let tint = if crosses { glass.tint } else { Vec3::ONE };
            // Light that enters here passes the layers above on its own way in.
            let entered = if wo.z < 0.0 && crosses { self.below_coat * self.passed(wi) } else { Vec3::ONE };
            under += weights[GLASS] * tint * entered * glass.facets.eval_resolved(wo, wi, bumps);
        }
        let mut sum = under * self.coat.tint_of(wo, wi);
        if above {
            if weights[COAT] != Vec3::ZERO {
                sum += weights[COAT] * self.coat.gloss.facets.eval_resolved(wo, wi, bumps);
            }
            if let Some((fuzz, weight)) = self.fuzz.brdf() {
                sum += weight * fuzz.eval(wo, wi);
            }
        }
        sum.map(finite)
    }

    fn density(&self, view: &View, wi: Vec3) -> f32 {
        let View { wo, bumps, ref chances, .. } = *view;
        let of = |lobe: usize, pdf: &dyn Fn() -> f32| {
            if chances[lobe] > 0.0 { chances[lobe] * pdf() } else { 0.0 }
        };
        let fuzz = of(FUZZ, &|| self.fuzz.brdf().map_or(0.0, |(fuzz, _)| fuzz.pdf(wo, wi)));
        let coat = of(COAT, &|| self.coat.gloss.facets.pdf_resolved(wo, wi, bumps));
        let gloss = of(GLOSS, &|| self.gloss.facets.pdf_resolved(wo, wi, bumps));
        let diffuse = of(DIFFUSE, &|| self.diffuse.pdf(wo, wi));
        let glass = of(GLASS, &|| self.glass.map_or(0.0, |glass| glass.facets.pdf_resolved(wo, wi, bumps)));
        finite(fuzz + coat + gloss + diffuse + glass)
    }

    /// A direction in the frame of the facets.
    fn direction(&self, view: &View, uc: f32, u: Vec2) -> Option<Vec3> {
        let View { wo, bumps, ref chances, .. } = *view;
        let mut rest = clamp_to(uc, 1.0);
        let mut lobe = FUZZ;
        for (k, &chance) in chances.iter().enumerate().filter(|(_, chance)| **chance > 0.0) {
            lobe = k;
            if rest < chance {
                break;
            }
            rest -= chance;
        }
        let uc = clamp_to(rest / chances[lobe], 1.0);
        let sample = match lobe {
            FUZZ => self.fuzz.brdf()?.0.sample(wo, uc, u),
            COAT => self.coat.gloss.facets.sample_resolved(wo, uc, u, bumps),
            GLOSS => self.gloss.facets.sample_resolved(wo, uc, u, bumps),
            DIFFUSE => self.diffuse.sample(wo, uc, u),
            _ => self.glass?.facets.sample_resolved(wo, uc, u, bumps),
        };
        sample.map(|sample| sample.wi)
    }
}

impl Gloss {
    fn alpha(&self) -> Vec2 {
        let ggx = self.facets.facets();
        Vec2::new(ggx.alpha_x(), ggx.alpha_y())
    }
}

impl Coating {
    /// A coat without color.
    pub(super) fn new(weight: f32, ggx: Ggx, fresnel: Dielectric) -> Self {
        let gloss = Gloss::new(ggx, SchlickRgb::of_dielectric(fresnel, Vec3::ONE));
        Self { weight, gloss, tint: Vec3::ONE, relative_index: fresnel.relative_index() }
    }

    /// Sets the transmittance of one pass at normal incidence.
    pub(super) fn tinted(self, tint: Vec3) -> Self {
        Self { tint, ..self }
    }

    fn albedo(&self, w: Vec3) -> f32 {
        if self.weight > 0.0 {
            self.gloss.reflectance.albedo(self.gloss.albedo.moments(w)).max_element()
        } else {
            0.0
        }
    }

    /// The transmittance of the way in and the way out.
    fn tint_of(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if self.tint == Vec3::ONE || self.weight <= 0.0 {
            return Vec3::ONE;
        }
        let once = |w: Vec3| {
            if w.z > 0.0 { through_wall(self.tint, w.z, self.relative_index) } else { Vec3::ONE }
        };
        Vec3::ONE.lerp(once(wo) * once(wi), self.weight)
    }
}

impl Brdf for Layers {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        self.eval_resolved(wo, wi, ResolvedBumps::FAR)
    }

    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        self.sample_resolved(wo, uc, u, ResolvedBumps::FAR)
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.pdf_resolved(wo, wi, ResolvedBumps::FAR)
    }

    fn transmits(&self) -> bool {
        self.glass.is_some()
    }
}

impl FacetBrdf for Layers {
    fn eval_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> Vec3 {
        let view = self.view(wo, bumps);
        view.map_or(Vec3::ZERO, |view| self.value(&view, self.side(wo) * self.turned(wi)))
    }

    fn sample_resolved(&self, wo: Vec3, uc: f32, u: Vec2, bumps: ResolvedBumps) -> Option<BsdfSample> {
        let view = self.view(wo, bumps)?;
        let wi = self.direction(&view, uc, u)?;
        let pdf = self.density(&view, wi);
        let sample = BsdfSample::with_pdf(view.wo, wi, pdf, || self.value(&view, wi) * wi.z.abs())?;
        Some(BsdfSample { wi: self.side(wo) * self.turned_back(wi), ..sample })
    }

    fn pdf_resolved(&self, wo: Vec3, wi: Vec3, bumps: ResolvedBumps) -> f32 {
        let view = self.view(wo, bumps);
        view.map_or(0.0, |view| self.density(&view, self.side(wo) * self.turned(wi)))
    }

    fn emitted(&self, wo: Vec3) -> Vec3 {
        let wo = self.side(wo) * self.turned(wo);
        if wo.z > 0.0 && self.emitted != Vec3::ZERO {
            self.emitted * self.passed(wo) * self.coat.tint_of(wo, Vec3::NEG_Z)
        } else {
            Vec3::ZERO
        }
    }
}
