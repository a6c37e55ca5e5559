//! Metallic paint: a bumpy clearcoat over sparkling flakes and flakes that vary the color.

use asperity_ndf_sampling::Beckmann;
use glam::Vec3;

use crate::bump::Facet;
use crate::error::ShadingError;
use crate::material::interface::Material;
use crate::material::paint::glint::GlintField;
use crate::material::paint::orange_peel::OrangePeel;
use crate::material::paint::passive_flakes::PassiveFlakes;
use crate::material::paint::sparkle::{Elimination, Sparkles, boosted};
use crate::material::surface_point::SurfacePoint;
use crate::parameter::{as_roughness, as_share, color, parameters, range};
use crate::reflectance::{Bsdf, Coat, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Lobe};

parameters! {
    /// The parameters of a [`MetallicPaint`], named as in Nilsson 2008, Appendix B.
    ///
    /// Sizes are in units of the surface positions, within `[10⁻⁶, 10⁶]`. Strengths and colors are
    /// within `[0, 1]`. The defaults are a blue car paint in meters.
    pub struct MetallicPaintParameters of MetallicPaint {
        /// The specular color of the flakes. Default (0.25, 0.35, 0.6).
        specular: Vec3 = Vec3::new(0.25, 0.35, 0.6), color;
        /// Tilt of the normal of the clearcoat by orange peel: its height over its size. Default
        /// 0.01; rocky from 0.1.
        orange_peel_strength: f32 = 0.01;
        /// The size of orange peel. Default 0.006.
        orange_peel_size: f32 = 0.006;
        /// The width of a sparkle in pixels, within `[0, 1000]`. Default 2.
        flake_sparkle_pixel_size: f32 = 2.0;
        /// The maximum width of a sparkle, and the distance between sparkles. Default 0.001.
        flake_sparkle_physical_size: f32 = 0.001;
        /// Tilt of the normal by a flake. Default 0.5.
        flake_sparkle_variation: f32 = 0.5;
        /// Boost of the color of a sparkle towards the target. Default 0.3.
        flake_sparkle_boost: f32 = 0.3, as_share;
        /// The target: the strongest signal of a sparkle. Default white.
        flake_sparkle_boost_target: Vec3 = Vec3::ONE, color;
        /// The fraction of flakes that is omitted. Default 0.4.
        flake_sparkle_elimination: f32 = 0.4;
        /// Whether fewer are omitted from afar. Default adaptive, by 0.002.
        smart_flake_sparkle: Elimination = Elimination::Adaptive { unit: 0.002 };
        /// The size of the coarsest passive flakes. Default 0.004.
        passive_flake_size: f32 = 0.004;
        /// Variation of the specular color by passive flakes. Default 0.3.
        passive_flake_strength: f32 = 0.3;
        /// The number of their octaves, from 1 to 8. Default 4.
        passive_flake_detail: u32 = 4;
        /// The roughness of the layer of flakes: Beckmann's α, within `[0.01, 1]`. This and the
        /// following parameters are not in the thesis. Default 0.32.
        flake_roughness: f32 = 0.32, as_roughness;
        /// Sparkling flakes, or counted flakes. Default sparkling.
        flakes: PaintFlakes = PaintFlakes::Sparkling;
        /// The color of the pigment between the flakes. Default (0.02, 0.05, 0.14).
        pigment: Vec3 = Vec3::new(0.02, 0.05, 0.14), color;
        /// The relative index of the clearcoat, within `[1, 4]`; 1 means no coat. Default 1.5.
        coat_index: f32 = 1.5, range([1.0, 4.0]);
        /// The roughness of the clearcoat, within `[0, 1]`; 0 is a mirror. Default 0.
        coat_roughness: f32 = 0.0, as_share;
        /// Random seed.
        seed: u32 = 1;
    }
}

/// The flakes that glitter in a [`MetallicPaint`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum PaintFlakes {
    /// Flakes of a fixed width in pixels, as in the thesis.
    #[default]
    Sparkling,
    /// Counted glints, as many as a pixel sees, with the same mean at every distance:
    /// [`GlintField`].
    Counted {
        /// The distance between flakes, within `[10⁻⁶, 10⁶]`.
        spacing: f32,
        /// The standard deviations of their tilt over which a lamp is mirrored, within `[0.001,
        /// 1]`.
        bin: f32,
    },
}

/// Metallic paint.
///
/// Orange peel tilts the normal of the clearcoat. Sparkling flakes tilt the normal of the layer
/// below it, where this makes a highlight stronger. Passive flakes vary the specular color. The
/// coat reflects by its own normal, because flakes would make it diffuse.
///
/// # Level of detail
///
/// The additional light of a sparkle is taken from the cell around it:
///
/// ```text
/// light = base + (w − w̄) g,   g = min(max(flake − base, 0), base/(2 w̄)) in each channel
/// ```
///
/// with the weight w of a sparkle and its mean w̄ over the cell. The mean over every cell is
/// `base` for any light, and the light of a point is continuous in the footprint. At least half of
/// the base remains between sparkles, so dense sparkles are dimmer than in the thesis.
///
/// Nilsson 2008, §4.3 and Appendix B. For sparkles that are counted within the pixel use a
/// [`GlintField`].
///
/// ```
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::{Footprint, Material, MetallicPaint, MetallicPaintParameters, SurfacePoint};
///
/// let paint = MetallicPaint::new(MetallicPaintParameters::default())?;
/// let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.0), Vec3::Z, Footprint::from_width(1e-4));
/// let light = paint.bsdf(&point, Vec3::Z).eval_cos(Vec3::Z, Vec3::new(0.6, 0.0, 0.8));
/// assert!(light.z > light.x, "blue paint");
/// # Ok::<(), asperity_shading::ShadingError>(())
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

impl MetallicPaint {
    /// Creates the paint of these parameters.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range.
    pub fn new(parameters: MetallicPaintParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        let (p, alpha) = (&parameters, parameters.flake_roughness);
        let seed = |i| p.seed.wrapping_mul(4).wrapping_add(i);
        let glints = match p.flakes {
            PaintFlakes::Sparkling => None,
            PaintFlakes::Counted { spacing, bin } => {
                Some(GlintField::new(Beckmann::new_clamped(alpha, alpha), spacing, bin, p.seed)?)
            }
        };
        Ok(Self {
            glints,
            coat: Dielectric::new_clamped(p.coat_index),
            orange_peel: OrangePeel::new(p.orange_peel_size, p.orange_peel_strength, seed(0))?,
            sparkles: Sparkles::new(
                p.flake_sparkle_pixel_size,
                p.flake_sparkle_physical_size,
                p.flake_sparkle_variation,
                p.flake_sparkle_elimination,
                p.smart_flake_sparkle,
                seed(1),
            )?,
            passive: PassiveFlakes::new(
                p.passive_flake_size,
                p.passive_flake_strength,
                p.passive_flake_detail,
                seed(2),
            )?,
            parameters,
        })
    }

    /// Orange peel, sparkles, passive flakes.
    pub(crate) const fn parts(&self) -> (&OrangePeel, &Sparkles, &PassiveFlakes) {
        (&self.orange_peel, &self.sparkles, &self.passive)
    }

    /// The counted flakes.
    pub(crate) const fn glints(&self) -> Option<&GlintField<Beckmann>> {
        self.glints.as_ref()
    }

    /// The specular color of the base layer at a pixel, with passive flakes; in [0, 1]³.
    fn specular(&self, point: &SurfacePoint) -> Vec3 {
        let factor = self.passive.factor(point.position, point.footprint());
        (self.parameters.specular * factor).min(Vec3::ONE)
    }
}

impl Material for MetallicPaint {
    /// Flakes over a pigment under a clearcoat. The light of a sparkle uses the brighter of both
    /// normals.
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let (p, frame, n) = (&self.parameters, point.frame(), point.normal);
        let (at, footprint) = (point.position, point.footprint());
        let specular = self.specular(point);
        let all = CookTorrance::new(Beckmann::new_clamped(p.flake_roughness, p.flake_roughness), specular);
        let flakes = match (&self.glints, self.sparkles.flake(at, n, footprint)) {
            (Some(field), _) => Lobe::counted(all, field, at, point.pixel),
            (None, Some(flake)) => {
                let boosted = boosted(specular, p.flake_sparkle_boost_target, p.flake_sparkle_boost);
                let weights = [flake.weight, flake.mean_weight];
                Lobe::sparkling(all, frame.to_local(flake.normal(n)), boosted, weights)
            }
            (None, None) => all.into(),
        };
        let pigment = EnergyPreservingOrenNayar::new_clamped(p.pigment.min(Vec3::ONE - specular), 0.2);
        let normal = frame.to_local(self.orange_peel.normal(at, n, footprint));
        let coat = Coat::clearcoat(self.coat).bumped(normal, self.orange_peel.removed_slope(footprint));
        let mut bsdf = Bsdf::new(frame, wo);
        bsdf.add_layer([Facet::FLAT], [flakes, pigment.into()]);
        bsdf.add_coat(coat.rough(p.coat_roughness));
        bsdf
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::reflect;
    use crate::pixel::Footprint;

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
        // A point in a cell of 0.001 that its flake covers.
        let places = (0..400_u16)
            .map(|k| Vec3::new(0.04, 0.04, 0.0405) + 5e-5 * Vec3::new((k % 20).into(), (k / 20).into(), 0.0));
        let at = |p: Vec3| SurfacePoint::new(p, Vec3::Z, Footprint::from_width(1.2e-4));
        let sparkle = |p: Vec3| paint.sparkles.flake(p, Vec3::Z, at(p).footprint()).unwrap();
        let point = at(places.max_by(|a, b| sparkle(*a).weight.total_cmp(&sparkle(*b).weight)).unwrap());
        let flake = sparkle(point.position);
        assert!(flake.weight > 0.9 && flake.mean_weight < 0.06, "{flake:?}");
        // A lamp that the flake mirrors is brighter than without the flake.
        let even = MetallicPaint::new(MetallicPaintParameters { flake_sparkle_elimination: 1.0, ..flaky() })
            .unwrap();
        let lamp = reflect(Vec3::Z, flake.normal(Vec3::Z));
        let [with, without] =
            [&paint, &even].map(|paint| paint.bsdf(&point, Vec3::Z).eval_cos(Vec3::Z, lamp).x);
        assert!(with > 1.2 * without, "{with} {without}");
    }

    #[test]
    fn far_paint_is_uniform_and_the_coat_rougher() {
        let paint = MetallicPaint::new(flaky()).unwrap();
        let point = SurfacePoint::new(Vec3::splat(0.0405), Vec3::Z, Footprint::from_width(1.0));
        let (at, footprint) = (point.position, point.footprint());
        assert_eq!(paint.sparkles.flake(at, Vec3::Z, footprint), None);
        assert_eq!(paint.orange_peel.normal(at, Vec3::Z, footprint), Vec3::Z);
        assert_eq!(paint.specular(&point), paint.parameters().specular);
        assert!(paint.orange_peel.removed_slope(footprint) > 1e-4);
    }
}
