//! Metallic paint: a bumpy clear coat over flakes that sparkle and flakes that vary the colour.

use asperity_ndf_sampling::Beckmann;
use glam::Vec3;

use crate::bump::{Facet, bumped_normal};
use crate::material::interface::Material;
use crate::material::paint::glint::GlintField;
use crate::material::paint::orange_peel::OrangePeel;
use crate::material::paint::passive_flakes::PassiveFlakes;
use crate::material::paint::sparkle::{Elimination, Sparkles, boosted};
use crate::material::surface_point::SurfacePoint;
use crate::parameter::{ParameterError, ROUGHNESSES, SHARES, colour, within};
use crate::reflectance::{Bsdf, Coat, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Lobe};

/// The parameters of a [`MetallicPaint`], by the names of Nilsson 2008, Appendix B.
///
/// Sizes are in units of the surface's positions, within `[10⁻⁶, 10⁶]`; strengths and colours are within `[0, 1]`. The
/// defaults are those of a car's blue paint in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicPaintParameters {
    /// The specular colour of the flakes. Default (0.25, 0.35, 0.6).
    pub specular: Vec3,
    /// Tilt of the clear coat's normal by orange peel: its height over its size. Default 0.01; from 0.1 it is rocky.
    pub orange_peel_strength: f32,
    /// The size of orange peel. Default 0.006.
    pub orange_peel_size: f32,
    /// The width of a sparkle in pixels, within `[0, 1000]`. Default 2.
    pub flake_sparkle_pixel_size: f32,
    /// The greatest width of a sparkle, and the distance between them. Default 0.001.
    pub flake_sparkle_physical_size: f32,
    /// Tilt of the normal by a flake. Default 0.5.
    pub flake_sparkle_variation: f32,
    /// Boost of a sparkle's colour towards the target. Default 0.3.
    pub flake_sparkle_boost: f32,
    /// The target: the strongest signal of a sparkle. Default white.
    pub flake_sparkle_boost_target: Vec3,
    /// The share of flakes that is left out. Default 0.4.
    pub flake_sparkle_elimination: f32,
    /// Whether fewer are left out from afar. Default adaptive, by 0.002.
    pub smart_flake_sparkle: Elimination,
    /// The size of the coarsest passive flakes. Default 0.004.
    pub passive_flake_size: f32,
    /// Variation of the specular colour by passive flakes. Default 0.3.
    pub passive_flake_strength: f32,
    /// The number of their octaves, from 1 to 8. Default 4.
    pub passive_flake_detail: u32,
    /// The roughness of the layer of flakes: Beckmann's α, within `[0.01, 1]`; this and what follows is not in the thesis. Default 0.32.
    pub flake_roughness: f32,
    /// Flakes that sparkle, or flakes that are counted. Default sparkling.
    pub flakes: PaintFlakes,
    /// The colour of the pigment beside the flakes. Default (0.02, 0.05, 0.14).
    pub pigment: Vec3,
    /// The relative index of the clear coat, within `[1, 4]`; 1 is none. Default 1.5.
    pub coat_index: f32,
    /// The roughness of the clear coat, within `[0, 1]`; 0 is a mirror. Default 0.
    pub coat_roughness: f32,
    /// Which paint: any number.
    pub seed: u32,
}

/// The flakes that glitter in a [`MetallicPaint`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PaintFlakes {
    /// Of a fixed width in pixels, as in the thesis: [`Sparkles`].
    #[default]
    Sparkling,
    /// Counted glints, as many as a pixel sees, with the same mean at every distance: [`GlintField`].
    Counted {
        /// The distance between flakes, within `[10⁻⁶, 10⁶]`.
        spacing: f32,
        /// The deviations of their tilt over which a lamp is mirrored, within `[0.001, 1]`.
        bin: f32,
    },
}

impl Default for MetallicPaintParameters {
    fn default() -> Self {
        Self {
            specular: Vec3::new(0.25, 0.35, 0.6),
            orange_peel_strength: 0.01,
            orange_peel_size: 0.006,
            flake_sparkle_pixel_size: 2.0,
            flake_sparkle_physical_size: 0.001,
            flake_sparkle_variation: 0.5,
            flake_sparkle_boost: 0.3,
            flake_sparkle_boost_target: Vec3::ONE,
            flake_sparkle_elimination: 0.4,
            smart_flake_sparkle: Elimination::Adaptive { unit: 0.002 },
            passive_flake_size: 0.004,
            passive_flake_strength: 0.3,
            passive_flake_detail: 4,
            flake_roughness: 0.32,
            flakes: PaintFlakes::Sparkling,
            pigment: Vec3::new(0.02, 0.05, 0.14),
            coat_index: 1.5,
            coat_roughness: 0.0,
            seed: 1,
        }
    }
}

/// Metallic paint.
///
/// Orange peel tilts the normal of the clear coat; sparkling flakes tilt that of the layer under it, where they make a highlight
/// stronger; passive flakes vary the specular colour. The coat mirrors by its own normal: flakes would make it diffuse.
///
/// Nilsson 2008, §4.3 and Appendix B. For a base layer that keeps its energy at every distance take a
/// [`GlintField`] for the sparkles.
///
/// ```
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::{Footprint, Material, MetallicPaint, MetallicPaintParameters, SurfacePoint};
///
/// let paint = MetallicPaint::new(MetallicPaintParameters::default())?;
/// let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.0), Vec3::Z, Footprint::from_width(1e-4));
/// let light = paint.bsdf(&point, Vec3::Z).scattered(Vec3::new(0.6, 0.0, 0.8), Vec3::Z);
/// assert!(light.z > light.x, "blue paint");
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[doc(alias = "car paint")]
#[doc(alias = "flakes")]
#[doc(alias = "clearcoat")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicPaint {
    parameters: MetallicPaintParameters,
    orange_peel: OrangePeel,
    sparkles: Sparkles,
    passive: PassiveFlakes,
    glints: Option<GlintField<Beckmann>>,
    coat: Dielectric,
}

/// Metallic paint as a pixel sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PaintSurface {
    /// The unit normal of the clear coat, with orange peel.
    pub coat_normal: Vec3,
    /// The variance of the coat's slope along each axis that the footprint took: its α² grows by twice that.
    pub coat_slope_variance: f32,
    /// The unit normal of the base layer.
    pub base_normal: Vec3,
    /// The specular colour of the base layer, with passive flakes; in [0, 1]³.
    pub specular: Vec3,
    /// The flake that may sparkle here, with its boosted colour.
    pub sparkle: Option<Flake>,
}

/// A sparkling flake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flake {
    /// The unit normal.
    normal: Vec3,
    /// The boosted specular colour.
    specular: Vec3,
}

impl MetallicPaint {
    /// The paint of these parameters.
    ///
    /// # Errors
    /// [`ParameterError`] with the first parameter that is out of its range.
    pub fn new(parameters: MetallicPaintParameters) -> Result<Self, ParameterError> {
        let p = &parameters;
        colour("specular", p.specular)?;
        colour("pigment", p.pigment)?;
        colour("flake_sparkle_boost_target", p.flake_sparkle_boost_target)?;
        within("flake_sparkle_boost", p.flake_sparkle_boost, SHARES)?;
        within("coat_roughness", p.coat_roughness, SHARES)?;
        let index = within("coat_index", p.coat_index, [1.0, 4.0])?;
        let alpha = within("flake_roughness", p.flake_roughness, ROUGHNESSES)?;
        let seed = |i| p.seed.wrapping_mul(4).wrapping_add(i);
        let glints = match p.flakes {
            PaintFlakes::Sparkling => None,
            PaintFlakes::Counted { spacing, bin } => {
                Some(GlintField::new(Beckmann::clamped(alpha, alpha), spacing, bin, p.seed)?)
            }
        };
        Ok(Self {
            glints,
            coat: Dielectric::clamped(index),
            orange_peel: OrangePeel::new(p.orange_peel_size, p.orange_peel_strength, seed(0))?,
            sparkles: Sparkles::new(
                p.flake_sparkle_pixel_size,
                p.flake_sparkle_physical_size,
                p.flake_sparkle_variation,
                p.flake_sparkle_elimination,
                p.smart_flake_sparkle,
                seed(1),
            )?,
            passive: PassiveFlakes::with_seed(
                p.passive_flake_size,
                p.passive_flake_strength,
                p.passive_flake_detail,
                seed(2),
            )?,
            parameters,
        })
    }

    /// The parameters.
    #[must_use]
    pub const fn parameters(&self) -> &MetallicPaintParameters {
        &self.parameters
    }

    /// Normals, colour and sparkle at a pixel; total: where the position is not finite it has neither bumps nor flakes.
    #[must_use]
    pub(crate) fn surface(&self, point: &SurfacePoint) -> PaintSurface {
        let (p, n) = (&self.parameters, point.normal);
        let factor = self.passive.factor(point.position, point.footprint());
        let specular = (p.specular * factor).min(Vec3::ONE);
        PaintSurface {
            coat_normal: bumped_normal(n, self.orange_peel.gradient(point.position, n, point.footprint())),
            coat_slope_variance: self.orange_peel.removed_slope(point.footprint()),
            base_normal: n,
            specular,
            sparkle: self.sparkles.flake(point.position, n, point.footprint()).map(|flake| Flake {
                normal: flake.normal(n),
                specular: boosted(specular, p.flake_sparkle_boost_target, p.flake_sparkle_boost),
            }),
        }
    }
}

impl Material for MetallicPaint {
    /// Flakes over a pigment under a clear coat. Sparkles are those of the lamp or the sample of light: the brighter of both normals.
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let (p, frame) = (&self.parameters, point.frame());
        let surface = self.surface(point);
        let all =
            CookTorrance::new(Beckmann::clamped(p.flake_roughness, p.flake_roughness), surface.specular);
        let flakes = match (&self.glints, surface.sparkle) {
            (Some(field), _) => Lobe::counted(all, field, point.position, point.footprint()),
            (None, Some(flake)) => Lobe::sparkling(all, frame.to_local(flake.normal), flake.specular),
            (None, None) => all.into(),
        };
        let pigment = p.pigment.min(Vec3::ONE - surface.specular);
        let pigment = EnergyPreservingOrenNayar::clamped(pigment, 0.2);
        let normal = frame.to_local(surface.coat_normal);
        let coat =
            Coat::varnish(self.coat).bumped(normal, surface.coat_slope_variance).rough(p.coat_roughness);
        Bsdf::new(wo).with([Facet::FLAT], [flakes, pigment.into()]).with_coat(coat)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::reflect;
    use crate::pixel::Footprint;
    use approx::assert_abs_diff_eq;

    fn flaky() -> MetallicPaintParameters {
        MetallicPaintParameters {
            flake_sparkle_elimination: 0.0,
            flake_sparkle_boost: 0.5,
            ..Default::default()
        }
    }

    #[test]
    fn sparkles_are_boosted_and_seen_where_they_are_brighter() {
        let paint = MetallicPaint::new(flaky()).unwrap();
        // The middle of a cell of 0.001, in a flake of more than half its width.
        let point = SurfacePoint::new(Vec3::splat(0.0405), Vec3::Z, Footprint::from_width(2.5e-4));
        let surface = paint.surface(&point);
        let flake = surface.sparkle.unwrap();
        let boosted = (surface.specular + Vec3::ONE) / 2.0;
        assert_abs_diff_eq!(flake.specular, boosted, epsilon = 1e-6);
        // A lamp that the flake mirrors is brighter than without the flake.
        let even = MetallicPaint::new(MetallicPaintParameters { flake_sparkle_elimination: 1.0, ..flaky() })
            .unwrap();
        let lamp = reflect(Vec3::Z, flake.normal);
        let [with, without] =
            [&paint, &even].map(|paint| paint.bsdf(&point, Vec3::Z).scattered(lamp, Vec3::Z).x);
        assert!(with > 1.2 * without, "{with} {without}");
    }

    #[test]
    fn from_afar_it_is_even_and_the_coat_rougher() {
        let paint = MetallicPaint::new(flaky()).unwrap();
        let surface =
            paint.surface(&SurfacePoint::new(Vec3::splat(0.0405), Vec3::Z, Footprint::from_width(1.0)));
        assert_eq!((surface.sparkle, surface.coat_normal), (None, Vec3::Z));
        assert_eq!(surface.specular, paint.parameters().specular);
        assert!(surface.coat_slope_variance > 1e-4);
    }

    #[test]
    fn every_point_has_a_surface() {
        let paint = MetallicPaint::new(flaky()).unwrap();
        for x in [f32::NAN, f32::NEG_INFINITY, -1e30, 0.0, 1e30] {
            for width in [0.0, 1e-4, f32::INFINITY] {
                let point = SurfacePoint::new(
                    Vec3::new(x, 0.1, 0.3),
                    Vec3::new(0.6, 0.0, 0.8),
                    Footprint::from_width(width),
                );
                let s = paint.surface(&point);
                assert!((s.coat_normal.length() - 1.0).abs() < 1e-5, "{x}, {width}: {s:?}");
                assert!(
                    s.specular.cmpge(Vec3::ZERO).all() && s.specular.cmple(Vec3::ONE).all(),
                    "{x}, {width}: {s:?}"
                );
            }
        }
    }

    #[test]
    fn refuses_by_name() {
        let named = |parameters| MetallicPaint::new(parameters).unwrap_err().parameter();
        assert_eq!(
            named(MetallicPaintParameters { orange_peel_strength: 2.0, ..flaky() }),
            "orange_peel_strength"
        );
        assert_eq!(
            named(MetallicPaintParameters { flake_sparkle_boost: -1.0, ..flaky() }),
            "flake_sparkle_boost"
        );
        assert_eq!(
            named(MetallicPaintParameters { passive_flake_detail: 0, ..flaky() }),
            "passive_flake_detail"
        );
        let smart = Elimination::Adaptive { unit: f32::NAN };
        assert_eq!(
            named(MetallicPaintParameters { smart_flake_sparkle: smart, ..flaky() }),
            "smart_flake_sparkle"
        );
    }
}
