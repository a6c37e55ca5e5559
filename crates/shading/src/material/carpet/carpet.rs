//! The carpet of a car: threads, seams, dark areas, roughness and light along the rim.

use core::f32::consts::FRAC_1_PI;

use asperity_ndf_sampling::Beckmann;
use asperity_noise::removed_share;
use glam::{Vec2, Vec3};

use crate::bump::{bumped_normal, slope_facets, tangential};
use crate::material::carpet::dark_area::DarkAreas;
use crate::material::carpet::fibre::{Fibres, FibresParameters};
use crate::material::carpet::rim_light::rim_light;
use crate::material::carpet::seam::{SeamPattern, Seams};
use crate::material::carpet::thread::{DiffuseThreads, SpecularThreads};
use crate::material::fbm::Fbm;
use crate::material::form::Form;
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::parameter::{ParameterError, ROUGHNESSES, SHARES, SIZES, colour, within};
use crate::reflectance::{Bsdf, CookTorrance, EnergyPreservingOrenNayar};

/// The parameters of a [`Carpet`], by the names of Nilsson 2008, Appendix B.
///
/// Sizes are in units of the surface's positions, within `[10⁻⁶, 10⁶]`; strengths and colours are within `[0, 1]`. The
/// defaults are those of a car's dark grey carpet in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarpetParameters {
    /// The diffuse colour. Default (0.12, 0.12, 0.13).
    pub diffuse: Vec3,
    /// The specular colour between the threads that shine. Default 0.
    pub specular: Vec3,
    /// The size of the threads that build up the diffuse map. Default 0.006.
    pub diffuse_thread_size: f32,
    /// Variation of the diffuse colour by threads, up and down. Default 0.12.
    pub diffuse_thread_strength: f32,
    /// Tilt of the normal by diffuse threads: their height over their size. Default 0.12; above 0.3 it looks rocky.
    pub diffuse_thread_bump_strength: f32,
    /// The size of the threads that build up the specular map. Default 0.008.
    pub specular_thread_size: f32,
    /// Greatest rise of the specular colour by threads. Default 0.12.
    pub specular_thread_strength: f32,
    /// The size of the dark areas. Default 0.15.
    pub dark_area_size: f32,
    /// Share of both colours that dark areas take. Default 0.5.
    pub dark_area_strength: f32,
    /// The direction across the seams, in texture coordinates. Default (1, 0).
    pub seams_propagation: Vec2,
    /// Lines, a grid, or no seams; the third component of the thesis's propagation vector. Default lines.
    pub seams_pattern: SeamPattern,
    /// The distance between seams, in texture coordinates, within `[10⁻⁶, 10⁶]`. Default 0.02.
    pub seam_distance: f32,
    /// Darkening of seams, without regard to the normal. Default 0.3.
    pub seams_amplitude: f32,
    /// Tilt of the normal by seams: the slope at a seam. Default 0.4.
    pub seams_bump_strength: f32,
    /// The size of the areas where threads lean over the seams. Default 0.05.
    pub seam_crossover_size: f32,
    /// Share of the seams that these threads fill, in colour and normal. Default 0.5.
    pub seam_crossover_strength: f32,
    /// Share of the colours that is of single fibres, seen from very near; not in the thesis. Default 0.8.
    pub fibre_strength: f32,
    /// Tilt of the normal by fibres. Default 0.3.
    pub fibre_bump_strength: f32,
    /// The fibres, in texture coordinates.
    pub fibres: FibresParameters,
    /// The roughness of the facets, that of [`EnergyPreservingOrenNayar`]. Default 0.8.
    pub roughness: f32,
    /// Strength of the rim light. Default 0.15.
    pub fake_rim_light: f32,
    /// Width of the rim. Default 0.4.
    pub fake_rim_light_width: f32,
    /// The colour of the rim light, which is added whatever the light; any that is not negative. Default white.
    pub fake_rim_light_colour: Vec3,
    /// The roughness of the threads that shine: Beckmann's α, within `[0.01, 1]`; not in the thesis. Default 0.45.
    pub specular_roughness: f32,
    /// Which carpet: any number.
    pub seed: u32,
}

impl Default for CarpetParameters {
    fn default() -> Self {
        Self {
            diffuse: Vec3::new(0.12, 0.12, 0.13),
            specular: Vec3::ZERO,
            diffuse_thread_size: 0.006,
            diffuse_thread_strength: 0.12,
            diffuse_thread_bump_strength: 0.12,
            specular_thread_size: 0.008,
            specular_thread_strength: 0.12,
            dark_area_size: 0.15,
            dark_area_strength: 0.5,
            seams_propagation: Vec2::X,
            seams_pattern: SeamPattern::Lines,
            seam_distance: 0.02,
            seams_amplitude: 0.3,
            seams_bump_strength: 0.4,
            seam_crossover_size: 0.05,
            seam_crossover_strength: 0.5,
            fibre_strength: 0.8,
            fibre_bump_strength: 0.3,
            fibres: FibresParameters::default(),
            roughness: 0.8,
            fake_rim_light: 0.15,
            fake_rim_light_width: 0.4,
            fake_rim_light_colour: Vec3::ONE,
            specular_roughness: 0.45,
            seed: 1,
        }
    }
}

/// The carpet of a car.
///
/// ```text
/// amount   = seams + (1 − seams) d,   d = strength (N + 1)/2,   of the crossing threads
/// diffuse  = clamp(diffuse + strength · threads) · amount · dark areas · fibres
/// specular = clamp(specular + strength · plasma⁷) · amount · dark areas · fibres
/// n′       = normalize(n − k ∇threads − k (1 − d) cos p ∇p/|∇p|)
/// ```
///
/// Each noise fades to its own mean with the footprint of the pixel. All factors are independent of one another, so the mean
/// colour over a surface is the same from every distance, as long as the strength of the diffuse threads is at most the diffuse
/// colour and no colour is cut off at 1: clamps change what is seen from nearby. Slopes that fade are facets of
/// the [`Bsdf`].
///
/// - **Deviations:** the slope of seams does not depend on the scale of the texture, nor that of threads on their size: a
///   strength of 0.5 is a slope of about a half. The thesis gives no scale. Creases of seams are rounded, see [`Seams::filtered`].
///
/// Nilsson 2008, §4.2 and Appendix B.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::{Carpet, CarpetParameters, Footprint, Material, SurfacePoint};
///
/// let carpet = Carpet::new(CarpetParameters { dark_area_strength: 0.8, ..Default::default() })?;
/// let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.0), Vec3::Z, Footprint::from_width(1e-4))
///     .with_uv(Vec2::new(0.3, 0.2), [Vec3::X, Vec3::Y]);
/// let (wi, wo) = (Vec3::new(0.6, 0.0, 0.8), Vec3::Z);
/// let light = carpet.bsdf(&point, wo).scattered(wi, wo);
/// assert!(light.min_element() > 0.0 && light.max_element() < 0.1, "dark grey");
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[doc(alias = "sheen")]
#[doc(alias = "fabric")]
#[doc(alias = "cloth")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carpet {
    parameters: CarpetParameters,
    diffuse_threads: DiffuseThreads,
    specular_threads: SpecularThreads,
    dark_areas: DarkAreas,
    seams: Seams,
    crossover: Fbm,
    fibres: Fibres,
}

/// Carpet as a pixel sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CarpetSurface {
    /// The diffuse colour, in [0, 1]³.
    pub diffuse: Vec3,
    /// The specular colour, in [0, 1]³.
    pub specular: Vec3,
    /// The unit normal with bumps.
    pub normal: Vec3,
    /// The roughness of the facets.
    pub roughness: f32,
    /// The rim light, in [0, 1]: radiance to be added, times a colour.
    pub rim: f32,
    /// The variance of the slope along each axis that the footprint took from the bumps. A lobe of Beckmann's density gets wider by
    /// it: α² + 2 · variance.
    pub slope_variance: f32,
}

impl Carpet {
    /// The carpet of these parameters.
    ///
    /// # Errors
    /// [`ParameterError`] with the first parameter that is out of its range.
    pub fn new(parameters: CarpetParameters) -> Result<Self, ParameterError> {
        let p = &parameters;
        colour("diffuse", p.diffuse)?;
        colour("specular", p.specular)?;
        for (name, value) in [
            ("diffuse_thread_strength", p.diffuse_thread_strength),
            ("diffuse_thread_bump_strength", p.diffuse_thread_bump_strength),
            ("specular_thread_strength", p.specular_thread_strength),
            ("seams_bump_strength", p.seams_bump_strength),
            ("seam_crossover_strength", p.seam_crossover_strength),
            ("fibre_strength", p.fibre_strength),
            ("fibre_bump_strength", p.fibre_bump_strength),
            ("roughness", p.roughness),
            ("fake_rim_light", p.fake_rim_light),
            ("fake_rim_light_width", p.fake_rim_light_width),
        ] {
            within(name, value, SHARES)?;
        }
        within("specular_roughness", p.specular_roughness, ROUGHNESSES)?;
        let seed = |i| p.seed.wrapping_mul(8).wrapping_add(i);
        Ok(Self {
            diffuse_threads: DiffuseThreads::new(p.diffuse_thread_size, seed(0))?,
            specular_threads: SpecularThreads::new(p.specular_thread_size, seed(1))?,
            dark_areas: DarkAreas::new(p.dark_area_size, p.dark_area_strength, seed(2))?,
            seams: Seams::new(p.seams_propagation, p.seams_pattern, p.seam_distance, p.seams_amplitude)?,
            crossover: Fbm::single(within("seam_crossover_size", p.seam_crossover_size, SIZES)?, seed(3)),
            fibres: Fibres::new(p.fibres)?,
            parameters,
        })
    }

    /// The parameters.
    #[must_use]
    pub const fn parameters(&self) -> &CarpetParameters {
        &self.parameters
    }

    /// Colours, normal and lost slopes at a pixel that is seen from the unit direction `view`.
    ///
    /// Total: noises are 0 where a coordinate of the position is not finite, there are no seams where a texture coordinate is
    /// not, the normal is the surface's where its gradient is not finite, and the rim is dark for a view that is NaN.
    #[must_use]
    pub(crate) fn surface(&self, point: &SurfacePoint, view: Vec3) -> CarpetSurface {
        let (p, n) = (&self.parameters, point.normal);
        let threads = self.diffuse_threads.sample(point.position, point.footprint());
        let shine = self.specular_threads.value(point.position, point.footprint());
        let crossing = self.crossover.sample(point.position, point.footprint()).value;
        let disturb = 0.5 * (crossing + 1.0) * p.seam_crossover_strength;

        let across = [self.seams.direction(), self.seams.direction().perp()];
        let gradients = across.map(|a| point.gradient(a * self.seams.frequency()));
        let widths = gradients.map(|g| point.change(g));
        let crease = self.seams.crease(point.uv, Vec2::from(widths));
        let amount = self.seams.amount(crease.height);
        let amount = amount + (1.0 - amount) * disturb;

        let (fibre, fibre_gradient, fibre_slope) = self.fibres.surface(point);
        let fibre = 1.0 + p.fibre_strength * (fibre.factor - 1.0);
        let dark = self.dark_areas.factor(point.position, point.footprint(), Form::Corrected);
        let lit = |c: Vec3, by: f32| {
            let threads = (c + Vec3::splat(by)).clamp(Vec3::ZERO, Vec3::ONE);
            (threads * (amount * dark * fibre)).min(Vec3::ONE)
        };

        let [along, other] = gradients.map(Vec3::normalize_or_zero);
        let seam_bump =
            (along * crease.slope.x + other * crease.slope.y) * (p.seams_bump_strength * (1.0 - disturb));
        let thread_bump = tangential(n, threads.gradient) * p.diffuse_thread_bump_strength;
        let bump2 = p.diffuse_thread_bump_strength * p.diffuse_thread_bump_strength;
        let seam2 = if p.seams_pattern == SeamPattern::None {
            0.0
        } else {
            // Slopes of |sin| have mean square ½, along one axis of two; so much as the pixel takes across.
            let removed = removed_share(widths[0].max(widths[1]), FRAC_1_PI);
            0.25 * p.seams_bump_strength * p.seams_bump_strength * removed * (1.0 - disturb) * (1.0 - disturb)
        };
        CarpetSurface {
            diffuse: lit(p.diffuse, p.diffuse_thread_strength * threads.value),
            specular: lit(p.specular, p.specular_thread_strength * shine),
            normal: bumped_normal(n, thread_bump + seam_bump + fibre_gradient * p.fibre_bump_strength),
            roughness: p.roughness,
            rim: p.fake_rim_light * rim_light(n, view, p.fake_rim_light_width),
            slope_variance: bump2 * self.diffuse_threads.removed_slope(point.footprint())
                + seam2
                + p.fibre_bump_strength * p.fibre_bump_strength * fibre_slope,
        }
    }
}

impl Material for Carpet {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let (p, frame) = (&self.parameters, point.frame());
        let surface = self.surface(point, frame.to_world(wo));
        let bsdf = Bsdf::new(wo).with_emitted(surface.rim * p.fake_rim_light_colour);
        // Threads shine at the cost of what they scatter.
        let diffuse = surface.diffuse.min(Vec3::ONE - surface.specular);
        let threads = EnergyPreservingOrenNayar::clamped(diffuse, surface.roughness);
        let alpha = p.specular_roughness;
        let sheen = CookTorrance::new(Beckmann::clamped(alpha, alpha), surface.specular);
        let facets = slope_facets(Vec3::Z, frame.to_local(surface.normal), surface.slope_variance);
        bsdf.with(facets, [threads.into(), sheen.into()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Footprint;
    use approx::assert_abs_diff_eq;

    fn point(x: f32, y: f32, width: f32) -> SurfacePoint {
        SurfacePoint::new(Vec3::new(x, y, 0.3), Vec3::Z, Footprint::from_width(width))
            .with_uv(Vec2::new(x, y), [Vec3::X, Vec3::Y])
    }

    #[test]
    fn no_strength_is_a_plain_surface() {
        let carpet = Carpet::new(CarpetParameters {
            diffuse_thread_strength: 0.0,
            diffuse_thread_bump_strength: 0.0,
            specular_thread_strength: 0.0,
            dark_area_strength: 0.0,
            seams_amplitude: 0.0,
            seams_bump_strength: 0.0,
            fibre_strength: 0.0,
            fibre_bump_strength: 0.0,
            fake_rim_light: 0.0,
            ..Default::default()
        })
        .unwrap();
        let surface = carpet.surface(&point(0.31, 0.17, 1e-4), Vec3::Z);
        assert_eq!(surface.normal, Vec3::Z);
        assert_abs_diff_eq!(surface.diffuse, carpet.parameters().diffuse, epsilon = 1e-6);
        assert_eq!((surface.specular, surface.rim, surface.slope_variance), (Vec3::ZERO, 0.0, 0.0));
    }

    #[test]
    fn from_afar_it_is_even_and_rougher() {
        let carpet = Carpet::new(CarpetParameters::default()).unwrap();
        let [here, there] =
            [point(0.31, 0.17, 10.0), point(7.2, -3.1, 10.0)].map(|p| carpet.surface(&p, Vec3::Z));
        assert!((here.diffuse - there.diffuse).length() < 1e-4 && here.normal == Vec3::Z);
        assert!((here.specular - there.specular).length() < 1e-4 && here.slope_variance > 0.01);
        let near = carpet.surface(&point(0.31, 0.17, 1e-6), Vec3::Z);
        assert_eq!(near.slope_variance, 0.0);
        assert!(near.normal.z < 1.0);
    }

    #[test]
    fn the_texture_s_scale_does_not_matter_to_seams() {
        let carpet = Carpet::new(CarpetParameters {
            diffuse_thread_bump_strength: 0.0,
            fibre_bump_strength: 0.0,
            ..Default::default()
        })
        .unwrap();
        let fine = point(0.304, 0.17, 1e-4);
        let coarse = fine.with_uv(fine.uv, [Vec3::X * 5.0, Vec3::Y * 5.0]);
        let [a, b] = [fine, coarse].map(|p| carpet.surface(&p, Vec3::Z).normal);
        assert!(a.x.abs() > 0.02 && (a - b).length() < 0.01, "{a}, {b}");
    }

    #[test]
    fn every_point_has_a_surface() {
        let carpet =
            Carpet::new(CarpetParameters { seams_pattern: SeamPattern::Grid, ..Default::default() }).unwrap();
        let odd = [f32::NAN, f32::NEG_INFINITY, -1e30, 0.0, 1e-30, 1e30, f32::INFINITY];
        for x in odd {
            for y in odd {
                let even = point(x, y, 1e-3);
                for p in [
                    even,
                    SurfacePoint { tangents: [Vec3::splat(x), Vec3::Y], ..even },
                    SurfacePoint { pixel: Footprint::from_width(y).into(), ..even },
                ] {
                    let s = carpet.surface(&p, Vec3::new(x, y, 1.0));
                    assert!((0.0..=1.0).contains(&s.diffuse.x), "{p:?}: {s:?}");
                    assert!((s.normal.length() - 1.0).abs() < 1e-5, "{p:?}: {s:?}");
                    assert!(
                        (0.0..=1.0).contains(&s.specular.x) && (0.0..=1.0).contains(&s.rim),
                        "{p:?}: {s:?}"
                    );
                    assert!(s.slope_variance >= 0.0, "{p:?}: {s:?}");
                }
            }
        }
    }

    #[test]
    fn refuses_by_name() {
        let named = |parameters| Carpet::new(parameters).unwrap_err().parameter();
        let base = CarpetParameters::default();
        assert_eq!(named(CarpetParameters { roughness: 1.5, ..base }), "roughness");
        assert_eq!(named(CarpetParameters { seam_crossover_size: 0.0, ..base }), "seam_crossover_size");
        assert_eq!(named(CarpetParameters { diffuse: Vec3::splat(f32::NAN), ..base }), "diffuse");
        assert_eq!(named(CarpetParameters { seams_propagation: Vec2::ZERO, ..base }), "seams_propagation");
    }
}
