//! Car carpet: threads, seams, dark areas, roughness and rim light.

use glam::{Vec2, Vec3};

use crate::bump::{bumped_normal, project_to_tangent_plane};
use crate::error::ShadingError;
use crate::material::carpet::dark_area::DarkAreas;
use crate::material::carpet::fiber::{Fibers, FibersParameters};
use crate::material::carpet::rim_light::rim_light;
use crate::material::carpet::seam::{Crease, SeamPattern, Seams, SeamsParameters};
use crate::material::carpet::thread::{DiffuseThreads, SpecularThreads};
use crate::material::fbm::SizedFbm;
use crate::material::glossy::GlossySurface;
use crate::material::interface::Material;
use crate::material::surface_point::{SurfacePoint, TextureGradients};
use crate::math::{clamp_to, sqrt};
use crate::parameter::{as_roughness, as_share, as_size, color, parameters};
use crate::reflectance::Bsdf;

parameters! {
    /// The parameters of a [`Carpet`], named as in Nilsson 2008, Appendix B.
    ///
    /// Sizes are in units of the surface positions, within `[10⁻⁶, 10⁶]`. Strengths and colors are
    /// within `[0, 1]`. The defaults are a dark gray car carpet in meters.
    pub struct CarpetParameters of Carpet {
        /// The diffuse color. Default (0.12, 0.12, 0.13).
        diffuse: Vec3 = Vec3::new(0.12, 0.12, 0.13), color;
        /// The specular color between the shiny threads. Default 0.
        specular: Vec3 = Vec3::ZERO, color;
        /// The size of the threads in the diffuse map. Default 0.006.
        diffuse_thread_size: f32 = 0.006;
        /// Variation of the diffuse color by threads, in both directions. Default 0.12.
        diffuse_thread_strength: f32 = 0.12, as_share;
        /// Tilt of the normal by diffuse threads: their height over their size. Default 0.12; rocky
        /// above 0.3.
        diffuse_thread_bump_strength: f32 = 0.12, as_share;
        /// The size of the threads in the specular map. Default 0.008.
        specular_thread_size: f32 = 0.008;
        /// Maximum increase of the specular color by threads. Default 0.12.
        specular_thread_strength: f32 = 0.12, as_share;
        /// The size of the dark areas. Default 0.15.
        dark_area_size: f32 = 0.15;
        /// Fraction of both colors removed in dark areas. Default 0.5.
        dark_area_strength: f32 = 0.5;
        /// The direction across the seams, in texture coordinates. Default (1, 0).
        seams_propagation: Vec2 = Vec2::X;
        /// Lines, a grid, or no seams; the third component of the propagation vector of the thesis.
        /// Default lines.
        seams_pattern: SeamPattern = SeamPattern::Lines;
        /// The distance between seams, in texture coordinates, within `[10⁻⁶, 10⁶]`. Default 0.02.
        seam_distance: f32 = 0.02;
        /// Darkening of seams, independent of the normal. Default 0.3.
        seams_amplitude: f32 = 0.3;
        /// Tilt of the normal by seams: the slope at a seam. Default 0.4.
        seams_bump_strength: f32 = 0.4, as_share;
        /// The size of the areas where threads cover the seams. Default 0.05.
        seam_crossover_size: f32 = 0.05, as_size;
        /// Fraction of the seams that these threads fill, in color and normal. Default 0.5.
        seam_crossover_strength: f32 = 0.5, as_share;
        /// Fraction of the colors from single fibers, visible up close; not in the thesis. Default
        /// 0.8.
        fiber_strength: f32 = 0.8, as_share;
        /// Tilt of the normal by fibers. Default 0.3.
        fiber_bump_strength: f32 = 0.3, as_share;
        /// The fibers, in texture coordinates.
        fibers: FibersParameters = FibersParameters::default();
        /// The roughness of the facets, as in
        /// [`EnergyPreservingOrenNayar`](crate::EnergyPreservingOrenNayar). Default 0.8.
        roughness: f32 = 0.8, as_share;
        /// Strength of the rim light. Default 0.15.
        fake_rim_light: f32 = 0.15, as_share;
        /// Width of the rim. Default 0.4.
        fake_rim_light_width: f32 = 0.4, as_share;
        /// The color of the rim light, emitted regardless of the light; any non-negative color.
        /// Default white.
        fake_rim_light_color: Vec3 = Vec3::ONE;
        /// The roughness of the shiny threads: Beckmann's α, within `[0.01, 1]`; not in the thesis.
        /// Default 0.45.
        specular_roughness: f32 = 0.45, as_roughness;
        /// Random seed.
        seed: u32 = 1;
    }
}

/// Car carpet.
///
/// ```text
/// amount   = seams + (1 − seams) d,   d = strength (N + 1)/2,   of the crossing threads
/// diffuse  = clamp(diffuse + strength · threads) · amount · dark areas · fibers
/// specular = clamp(specular + strength · plasma⁷) · amount · dark areas · fibers
/// n′       = normalize(n − k ∇threads − k (1 − d) cos p ∇p/|∇p|)
/// ```
///
/// Each noise fades to its mean with the footprint of the pixel. All factors are independent, so
/// the mean color over a surface is the same at every distance. This requires that the strength of
/// the diffuse threads is at most the diffuse color and that no color is clamped at 1; clamping
/// changes the near view. Faded slopes become facets of the [`Bsdf`]. With the facets, the mean
/// radiance from afar differs from the near one by up to 0.4 % for light at 37°, 0.8 % at 53° and 3
/// % at 74°, measured with the defaults and each seam pattern.
///
/// - **Deviations:** the slope of seams does not depend on the scale of the texture, and the slope
///   of threads does not depend on their size. A strength of 0.5 is a slope of about a half. The
///   thesis has no scale. Creases of seams are rounded, see [`Seams::filtered`].
/// - **Heights** are those of threads, seams and fibers. Fibers end in steps. The slopes omit how
///   threads over seams change along the seams.
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
/// let light = carpet.bsdf(&point, wo).eval_cos(wo, wi);
/// assert!(light.min_element() > 0.0 && light.max_element() < 0.1, "dark gray");
/// # Ok::<(), asperity_shading::ShadingError>(())
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
    crossover: SizedFbm,
    fibers: Fibers,
}

impl Carpet {
    /// Creates the carpet of these parameters.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range.
    pub fn new(parameters: CarpetParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        let p = &parameters;
        let seed = |i| p.seed.wrapping_mul(8).wrapping_add(i);
        Ok(Self {
            diffuse_threads: DiffuseThreads::new(p.diffuse_thread_size, seed(0))?,
            specular_threads: SpecularThreads::new(p.specular_thread_size, seed(1))?,
            dark_areas: DarkAreas::new(p.dark_area_size, p.dark_area_strength, seed(2))?,
            seams: Seams::new(SeamsParameters {
                seams_propagation: p.seams_propagation,
                seams_pattern: p.seams_pattern,
                seam_distance: p.seam_distance,
                seams_amplitude: p.seams_amplitude,
            })?,
            crossover: SizedFbm::single(p.seam_crossover_size, seed(3)),
            fibers: Fibers::new(p.fibers)?,
            parameters,
        })
    }

    /// Threads, shiny threads, dark areas, seams, threads over seams, fibers.
    pub(crate) const fn parts(
        &self,
    ) -> (&DiffuseThreads, &SpecularThreads, &DarkAreas, &Seams, &SizedFbm, &Fibers) {
        let Self { diffuse_threads, specular_threads, dark_areas, seams, crossover, fibers, .. } = self;
        (diffuse_threads, specular_threads, dark_areas, seams, crossover, fibers)
    }

    /// The fraction of a seam that is filled by threads.
    fn crossing(&self, point: &SurfacePoint) -> f32 {
        let crossing = self.crossover.seen(point.position, point.footprint());
        0.5 * (crossing + 1.0) * self.parameters.seam_crossover_strength
    }

    /// The seam at a pixel, the gradients of its phases, and their change across the pixel.
    fn crease(&self, point: &SurfacePoint, texture: &TextureGradients) -> (Crease, [Vec3; 2], [f32; 2]) {
        let across = [self.seams.direction(), self.seams.direction().perp()];
        let gradients = across.map(|a| texture.of(a * self.seams.frequency()));
        let widths = gradients.map(|g| point.change(g));
        (self.seams.crease(point.uv, Vec2::from(widths)), gradients, widths)
    }

    /// Colors, normal and unresolved slopes at a pixel.
    ///
    /// Accepts every input. Noises are 0 where the position is not finite, seams are absent where a
    /// texture coordinate is not finite, and the normal is that of the surface where its gradient
    /// is not finite.
    fn surface(&self, point: &SurfacePoint) -> GlossySurface {
        let (p, n) = (&self.parameters, point.normal);
        let threads = self.diffuse_threads.sample(point.position, point.footprint());
        let shine = self.specular_threads.value(point.position, point.footprint());
        let disturb = self.crossing(point);

        let texture = point.texture();
        let (crease, gradients, widths) = self.crease(point, &texture);
        let amount = self.seams.amount(crease.height);
        let amount = amount + (1.0 - amount) * disturb;

        let (fiber, fiber_gradient, fiber_slope) = self.fibers.surface(point.uv, &texture, &point.pixel);
        let fiber = 1.0 + p.fiber_strength * (fiber.factor - 1.0);
        let dark = self.dark_areas.factor(point.position, point.footprint());
        let lit = |c: Vec3, by: f32| {
            let threads = (c + Vec3::splat(by)).clamp(Vec3::ZERO, Vec3::ONE);
            (threads * (amount * dark * fiber)).min(Vec3::ONE)
        };

        let [along, other] = gradients.map(Vec3::normalize_or_zero);
        let seam_bump =
            (along * crease.slope.x + other * crease.slope.y) * (p.seams_bump_strength * (1.0 - disturb));
        let thread_bump = project_to_tangent_plane(n, threads.gradient) * p.diffuse_thread_bump_strength;
        let bump2 = p.diffuse_thread_bump_strength * p.diffuse_thread_bump_strength;
        let steep = p.seams_bump_strength * (1.0 - disturb);
        let [first, second] =
            self.seams.removed_slopes(widths.into()).map(|variance| steep * steep * variance);
        let even = first.min(second);
        let ridges = if first > second { along * sqrt(first - even) } else { other * sqrt(second - even) };
        GlossySurface {
            diffuse: lit(p.diffuse, p.diffuse_thread_strength * threads.value),
            specular: lit(p.specular, p.specular_thread_strength * shine),
            normal: bumped_normal(n, thread_bump + seam_bump + fiber_gradient * p.fiber_bump_strength),
            slope_variance: bump2 * self.diffuse_threads.removed_slope(point.footprint())
                + even
                + p.fiber_bump_strength * p.fiber_bump_strength * fiber_slope,
            ridges,
        }
    }
}

impl Material for Carpet {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let (p, frame) = (&self.parameters, point.frame());
        let rim = rim_light(point.normal, wo, p.fake_rim_light_width);
        let mut bsdf = Bsdf::new(frame, wo);
        self.surface(point).add_to(&mut bsdf, &frame, p.roughness, p.specular_roughness);
        bsdf.add_emitted(p.fake_rim_light * rim * p.fake_rim_light_color);
        bsdf
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        let (p, texture) = (&self.parameters, point.texture());
        let threads =
            p.diffuse_thread_size * self.diffuse_threads.sample(point.position, point.footprint()).value;
        let (crease, ..) = self.crease(point, &texture);
        // Phases far out have no digits, and the height there may be NaN.
        let deep = clamp_to(1.0 - crease.height, 1.0) * (1.0 - self.crossing(point)) / self.seams.frequency();
        let (fiber, ..) = self.fibers.surface(point.uv, &texture, &point.pixel);
        p.diffuse_thread_bump_strength * threads - p.seams_bump_strength * deep
            + p.fiber_bump_strength * fiber.height
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        let p = &self.parameters;
        let threads = p.diffuse_thread_bump_strength * p.diffuse_thread_size;
        let fibers = p.fiber_bump_strength * 0.5 * p.fibers.fiber_length * p.fibers.fiber_width;
        Some([-threads - p.seams_bump_strength / self.seams.frequency(), threads + fibers])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Footprint;
    use asperity_core::assert_abs_diff_eq;

    fn point(x: f32, y: f32, width: f32) -> SurfacePoint {
        SurfacePoint::new(Vec3::new(x, y, 0.3), Vec3::Z, Footprint::from_width(width))
            .with_uv(Vec2::new(x, y), [Vec3::X, Vec3::Y])
    }

    #[test]
    fn zero_strength_is_flat() {
        let carpet = Carpet::new(CarpetParameters {
            diffuse_thread_strength: 0.0,
            diffuse_thread_bump_strength: 0.0,
            specular_thread_strength: 0.0,
            dark_area_strength: 0.0,
            seams_amplitude: 0.0,
            seams_bump_strength: 0.0,
            fiber_strength: 0.0,
            fiber_bump_strength: 0.0,
            fake_rim_light: 0.0,
            ..Default::default()
        })
        .unwrap();
        let surface = carpet.surface(&point(0.31, 0.17, 1e-4));
        assert_eq!(surface.normal, Vec3::Z);
        assert_abs_diff_eq!(surface.diffuse, carpet.parameters().diffuse, epsilon = 1e-6);
        assert_eq!((surface.specular, surface.slope_variance), (Vec3::ZERO, 0.0));
    }

    #[test]
    fn far_carpet_is_uniform_and_rougher() {
        let carpet = Carpet::new(CarpetParameters::default()).unwrap();
        let [here, there] = [point(0.31, 0.17, 10.0), point(7.2, -3.1, 10.0)].map(|p| carpet.surface(&p));
        assert!((here.diffuse - there.diffuse).length() < 1e-4 && here.normal == Vec3::Z);
        assert!((here.specular - there.specular).length() < 1e-4 && here.slope_variance > 0.01);
        let near = carpet.surface(&point(0.31, 0.17, 1e-6));
        assert_eq!(near.slope_variance, 0.0);
        assert!(near.normal.z < 1.0);
    }

    #[test]
    fn seam_slopes_do_not_depend_on_the_texture_scale() {
        let carpet = Carpet::new(CarpetParameters {
            diffuse_thread_bump_strength: 0.0,
            fiber_bump_strength: 0.0,
            ..Default::default()
        })
        .unwrap();
        let fine = point(0.304, 0.17, 1e-4);
        let coarse = fine.with_uv(fine.uv, [Vec3::X * 5.0, Vec3::Y * 5.0]);
        let [a, b] = [fine, coarse].map(|p| carpet.surface(&p).normal);
        assert!(a.x.abs() > 0.02 && (a - b).length() < 0.01, "{a}, {b}");
    }
}
