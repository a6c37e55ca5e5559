//! Lobes of a BSDF: the BRDFs in its layers.

use asperity_ndf_sampling::{Beckmann, Frame, Ndf, OffsetBeckmann};
use glam::{Vec2, Vec3};

use crate::direction::{half_vector, reflect};
use crate::level_of_detail::{LevelOfDetail, ResolvedBumps};
use crate::math::{clamp_to, sqrt};
use crate::pixel::PixelEllipse;
use crate::reflectance::brdf::{Brdf, BsdfSample, are_above, cosine_hemisphere, finite, mirrored_pdf};
use crate::reflectance::cook_torrance::CookTorrance;
use crate::reflectance::diffuse::EnergyPreservingOrenNayar;
use crate::reflectance::facet_brdf::{FacetBrdf, gaussians};
use crate::reflectance::fresnel::{Dielectric, Fresnel};
use crate::reflectance::rough_dielectric::RoughDielectric;

/// A BRDF with a weight, one of the terms of a layer of a [`Bsdf`](crate::reflectance::Bsdf).
///
/// Diffuse and glossy BRDFs are copied into it; other kinds are stored as a reference. Partially
/// resolved NDFs reflect by
///
/// ```text
/// f_r = color · p(h | what is resolved) min(1, h_z/(ωo·h))/(4 max(cos θ_i, cos θ_o))
/// ```
///
/// The factors turn the plain NDF (Kautz, Heidrich, Seidel 2001, §3.1) into a reciprocal BRDF that
/// conserves energy: the albedo is at most `∫ p(h) h_z dh = 1`.
///
/// ```
/// use asperity_shading::reflectance::Lobe;
/// use asperity_shading::{Brdf, Lambert, glam::Vec3};
///
/// let chalk = Lambert::new(Vec3::splat(0.8))?;
/// let half = Lobe::from(&chalk as &dyn Brdf).weighted(Vec3::splat(0.5));
/// assert_eq!(half.eval(Vec3::Z, Vec3::Z), 0.5 * chalk.eval(Vec3::Z, Vec3::Z));
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy)]
pub struct Lobe<'a> {
    kind: Kind<'a>,
    weight: Vec3,
}

#[derive(Clone, Copy)]
enum Kind<'a> {
    Diffuse(EnergyPreservingOrenNayar),
    Glossy(CookTorrance<Beckmann, Vec3>),
    Varnish(CookTorrance<Beckmann, Dielectric>),
    Counted {
        all: CookTorrance<Beckmann, Vec3>,
        flakes: &'a dyn CountedFacets,
        position: Vec3,
        pixel: PixelEllipse,
    },
    Sparkling {
        base: CookTorrance<Beckmann, Vec3>,
        flake: Vec3,
        color: Vec3,
        /// The weight of the flake, and its mean around it.
        weights: [f32; 2],
    },
    Resolved {
        ndf: &'a dyn Ndf,
        rule: LevelOfDetail,
        coordinates: ResolvedBumps,
    },
    Slopes(OffsetBeckmann),
    Frosted(RoughDielectric<Beckmann>),
    Bumps(&'a dyn FacetBrdf, ResolvedBumps),
    Other(&'a dyn Brdf),
}

/// A lobe in terms of other material models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LobePart {
    /// A diffuse lobe: its albedo.
    Diffuse(Vec3),
    /// A glossy lobe: its reflectance at normal incidence, and α².
    Glossy(Vec3, f32),
    /// A rough varnish: α².
    Varnish(f32),
}

/// Counted facets of a pixel.
pub(crate) trait CountedFacets {
    /// `D̂(h)`.
    fn density(&self, h: Vec3, position: Vec3, pixel: &PixelEllipse) -> f32;

    /// `D̂(h)/D(h)`.
    fn relative(&self, h: Vec3, position: Vec3, pixel: &PixelEllipse) -> f32;

    /// A normal with the density `D̂(m) cos θ`.
    fn sample(&self, u: Vec2, position: Vec3, pixel: &PixelEllipse) -> Vec3;
}

impl Default for Lobe<'_> {
    fn default() -> Self {
        Self {
            kind: Kind::Slopes(OffsetBeckmann::conditional(Beckmann::new_clamped(1.0, 1.0), Vec2::ZERO, 0.0)),
            weight: Vec3::ZERO,
        }
    }
}

macro_rules! lobes {
    ($($(#[$about:meta])? $reflectance:ty => $kind:ident;)*) => {
        $(
            $(#[$about])?
            impl<'a> From<$reflectance> for Lobe<'a> {
                fn from(reflectance: $reflectance) -> Self {
                    Self { kind: Kind::$kind(reflectance), weight: Vec3::ONE }
                }
            }
        )*
    };
}

lobes! {
    EnergyPreservingOrenNayar => Diffuse;
    CookTorrance<Beckmann, Vec3> => Glossy;
    CookTorrance<Beckmann, Dielectric> => Varnish;
    RoughDielectric<Beckmann> => Frosted;
    &'a dyn Brdf => Other;
    /// An NDF around a mean slope, for authored normal maps.
    OffsetBeckmann => Slopes;
}

impl<'a> Lobe<'a> {
    /// A partially resolved NDF, shaded by a level-of-detail rule.
    #[must_use]
    pub fn resolved(ndf: &'a dyn Ndf, rule: LevelOfDetail, coordinates: ResolvedBumps) -> Self {
        Self { kind: Kind::Resolved { ndf, rule, coordinates }, weight: Vec3::ONE }
    }

    /// The facets of a BRDF that remain where a part of them is resolved.
    #[must_use]
    pub fn bumps(facets: &'a dyn FacetBrdf, bumps: ResolvedBumps) -> Self {
        Self { kind: Kind::Bumps(facets, bumps), weight: Vec3::ONE }
    }

    /// Glossy flakes that are counted within the pixel.
    ///
    /// Half of the samples are of the counted flakes, half of all visible ones.
    pub(crate) fn counted(
        all: CookTorrance<Beckmann, Vec3>,
        flakes: &'a dyn CountedFacets,
        position: Vec3,
        pixel: PixelEllipse,
    ) -> Self {
        Self { kind: Kind::Counted { all, flakes, position, pixel }, weight: Vec3::ONE }
    }

    /// A glossy lobe plus a flake of this normal and color.
    ///
    /// The flake is weighted by its weight over the mean weight around it.
    pub(crate) fn sparkling(
        base: CookTorrance<Beckmann, Vec3>,
        flake: Vec3,
        color: Vec3,
        weights: [f32; 2],
    ) -> Self {
        Self { kind: Kind::Sparkling { base, flake, color, weights }, weight: Vec3::ONE }
    }

    /// Multiplies the lobe by a color, component by component; non-positive components are read as
    /// 0.
    #[must_use]
    pub fn weighted(self, by: Vec3) -> Self {
        Self { weight: self.weight * by.max(Vec3::ZERO), ..self }
    }

    /// Its color and α², if it has them.
    pub(super) fn part(&self) -> Option<LobePart> {
        let alpha2 = |facets: &Beckmann| {
            0.5 * (facets.alpha_x() * facets.alpha_x() + facets.alpha_y() * facets.alpha_y())
        };
        match &self.kind {
            Kind::Diffuse(diffuse) => Some(LobePart::Diffuse(self.weight * diffuse.albedo())),
            Kind::Glossy(lobe) | Kind::Counted { all: lobe, .. } | Kind::Sparkling { base: lobe, .. } => {
                Some(LobePart::Glossy(self.weight * *lobe.fresnel(), alpha2(lobe.facets())))
            }
            Kind::Varnish(lobe) => Some(LobePart::Varnish(alpha2(lobe.facets()))),
            Kind::Resolved { .. } | Kind::Slopes(_) | Kind::Frosted(_) | Kind::Bumps(..) | Kind::Other(_) => {
                None
            }
        }
    }

    /// Its approximate albedo, by which lobes are sampled.
    pub(super) fn strength(&self, wo: Vec3) -> f32 {
        let own = match self.kind {
            Kind::Diffuse(diffuse) => diffuse.albedo(),
            Kind::Glossy(lobe) | Kind::Counted { all: lobe, .. } | Kind::Sparkling { base: lobe, .. } => {
                *lobe.fresnel()
            }
            Kind::Varnish(lobe) => lobe.fresnel().reflectance_rgb(wo.z).max(Vec3::splat(0.1)),
            Kind::Resolved { .. } | Kind::Slopes(_) | Kind::Frosted(_) | Kind::Bumps(..) | Kind::Other(_) => {
                Vec3::ONE
            }
        };
        finite((own * self.weight).max_element())
    }

    /// Samples a direction, with its sample if it is specular.
    pub(super) fn draw(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<(Vec3, Option<BsdfSample>)> {
        let wi = match &self.kind {
            Kind::Diffuse(_) => cosine_hemisphere(u),
            Kind::Counted { flakes, position, pixel, .. } if uc < 0.5 => {
                reflect(wo, flakes.sample(u, *position, pixel))
            }
            Kind::Glossy(lobe) | Kind::Counted { all: lobe, .. } | Kind::Sparkling { base: lobe, .. } => {
                lobe.direction(wo, u)
            }
            Kind::Varnish(varnish) => varnish.direction(wo, u),
            Kind::Resolved { ndf, rule, coordinates } => {
                // A facet of a facet may be below the surface, where it is invisible.
                let m = Some(resolved_normal(*ndf, *rule, *coordinates, u)).filter(|m| m.z > 0.0)?;
                reflect(wo, m)
            }
            Kind::Slopes(slopes) => reflect(wo, slopes.sample(u)),
            Kind::Frosted(glass) => glass.direction(wo, uc, u)?,
            Kind::Bumps(facets, bumps) => {
                return facets.sample_resolved(wo, uc, u, *bumps).map(|sample| self.drawn(sample));
            }
            Kind::Other(brdf) => return brdf.sample(wo, uc, u).map(|sample| self.drawn(sample)),
        };
        Some((wi, None))
    }

    /// The direction of a sample of a stored BRDF, and the weighted sample if it is specular.
    fn drawn(&self, sample: BsdfSample) -> (Vec3, Option<BsdfSample>) {
        let weighted = BsdfSample { eval_cos: sample.eval_cos * self.weight, ..sample };
        (sample.wi, sample.is_specular().then_some(weighted))
    }
}

impl Brdf for Lobe<'_> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !are_above(wi, wo) {
            return match &self.kind {
                Kind::Frosted(glass) => self.weight * glass.eval(wo, wi),
                Kind::Bumps(facets, bumps) if facets.transmits() => {
                    self.weight * facets.eval_resolved(wo, wi, *bumps)
                }
                Kind::Other(brdf) if brdf.transmits() => self.weight * brdf.eval(wo, wi),
                _ => Vec3::ZERO,
            };
        }
        let h = half_vector(wi, wo);
        // p(h) h_z is the projected facet area of the surface, which bounds the reflected light.
        let shown = (h.z / wo.dot(h)).min(1.0) / (4.0 * wi.z.max(wo.z));
        let facets = |density: f32| Vec3::splat(finite(density * shown));
        let value = match &self.kind {
            Kind::Diffuse(diffuse) => diffuse.eval(wo, wi),
            Kind::Glossy(glossy) => glossy.eval(wo, wi),
            Kind::Varnish(varnish) => varnish.eval(wo, wi),
            Kind::Counted { all, flakes, position, pixel } => {
                all.eval(wo, wi) * flakes.relative(h, *position, pixel)
            }
            Kind::Sparkling { base, flake, color, weights: [weight, mean] } => {
                let even = base.eval(wo, wi);
                let frame = Frame::from_normal(*flake);
                let (i, o) = (frame.to_local(wi), frame.to_local(wo));
                // The cosine with the flake instead of the surface.
                let white = CookTorrance::new(*base.facets(), *color);
                let bright = white.eval(o, i) * (i.z.max(0.0) / wi.z.max(1e-3)).min(4.0);
                // The surrounding points lose at most half of their light.
                let most = even * (0.5 / mean.max(1e-6));
                even + (bright - even).max(Vec3::ZERO).min(most) * (weight - mean)
            }
            Kind::Resolved { ndf, rule, coordinates } => facets(rule.radiance(*ndf, h, *coordinates)),
            Kind::Slopes(slopes) => facets(slopes.d(h)),
            Kind::Frosted(glass) => glass.eval(wo, wi),
            Kind::Bumps(facets, bumps) => facets.eval_resolved(wo, wi, *bumps),
            Kind::Other(brdf) => brdf.eval(wo, wi),
        };
        self.weight * value
    }

    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let (wi, specular) = self.draw(wo, uc, u)?;
        specular.or_else(|| BsdfSample::from_direction(self, wo, wi))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        match &self.kind {
            Kind::Diffuse(diffuse) => diffuse.pdf(wo, wi),
            Kind::Glossy(lobe) | Kind::Sparkling { base: lobe, .. } => lobe.pdf(wo, wi),
            Kind::Counted { all, flakes, position, pixel } => {
                let counted = mirrored_pdf(wo, wi, |h| flakes.density(h, *position, pixel) * h.z.max(0.0));
                0.5 * (counted + all.pdf(wo, wi))
            }
            Kind::Varnish(varnish) => varnish.pdf(wo, wi),
            Kind::Resolved { ndf, rule, coordinates } => mirrored_pdf(wo, wi, |h| {
                let cosine = match rule {
                    LevelOfDetail::Exact => h.z,
                    LevelOfDetail::Fractal => h.dot(rule.normal(*ndf, *coordinates)),
                };
                rule.radiance(*ndf, h, *coordinates) * cosine.max(0.0)
            }),
            Kind::Slopes(slopes) => mirrored_pdf(wo, wi, |h| slopes.pdf(h)),
            Kind::Frosted(glass) => glass.pdf(wo, wi),
            Kind::Bumps(facets, bumps) => facets.pdf_resolved(wo, wi, *bumps),
            Kind::Other(brdf) => brdf.pdf(wo, wi),
        }
    }

    fn transmits(&self) -> bool {
        match &self.kind {
            Kind::Frosted(_) => true,
            Kind::Bumps(facets, _) => facets.transmits(),
            Kind::Other(brdf) => brdf.transmits(),
            _ => false,
        }
    }
}

/// Samples a normal of the NDF seen by the pixel.
fn resolved_normal(ndf: &dyn Ndf, rule: LevelOfDetail, coordinates: ResolvedBumps, u: Vec2) -> Vec3 {
    match rule {
        LevelOfDetail::Exact => {
            let share = clamp_to(coordinates.variance, 1.0);
            let rest = sqrt(1.0 - share) * gaussians(u);
            ndf.warp_gaussian(sqrt(share) * coordinates.z + rest)
        }
        LevelOfDetail::Fractal => Frame::from_normal(rule.normal(ndf, coordinates)).to_world(ndf.sample(u)),
    }
}
