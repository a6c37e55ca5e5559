//! Variations for any material: roughness, blemishes and dents.

use asperity_ndf_sampling::Beckmann;
use glam::Vec3;

use crate::bump::{bumped_normal, slope_facets};
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::material::wear::blemish::Blemishes;
use crate::material::wear::dent::Dents;
use crate::parameter::{ParameterError, ROUGHNESSES, SHARES, colour, within};
use crate::reflectance::{Bsdf, CookTorrance, EnergyPreservingOrenNayar};

/// The parameters of [`Variations`], by the names of Nilsson 2008, Appendix B.
///
/// Sizes are in units of the surface's positions, within `[10⁻⁶, 10⁶]`; strengths, shares and colours are within `[0, 1]`. The
/// defaults are those of a plastic panel in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariationsParameters {
    /// The diffuse colour. Default (0.3, 0.28, 0.25).
    pub diffuse: Vec3,
    /// The specular colour. Default 0.2.
    pub specular: Vec3,
    /// The roughness of the facets, that of [`EnergyPreservingOrenNayar`]. Default 0.3.
    pub roughness: f32,
    /// The size of blemishes. Default 0.003.
    pub small_blemish_size: f32,
    /// Tilt of the normal by blemishes: their height over their size. Default 0.03.
    pub small_blemish_bump_strength: f32,
    /// Variation of the specular colour by blemishes. Default 0.4.
    pub small_blemish_colour_strength: f32,
    /// Tilt of the normal by dents: their height over their size. Default 0.05.
    pub dent_strength: f32,
    /// The size of dents. Default 0.1.
    pub dent_size: f32,
    /// Cover of dents: the share of gradients that is kept. Default 0.3, the thesis's drop of 70 %.
    pub dent_cover: f32,
    /// The number of octaves of dents, from 1 to 8. Default 2.
    pub dent_detail: u32,
    /// The roughness of the gloss: Beckmann's α, within `[0.01, 1]`; not in the thesis. Default 0.25.
    pub gloss_roughness: f32,
    /// Which surface: any number.
    pub seed: u32,
}

impl Default for VariationsParameters {
    fn default() -> Self {
        Self {
            diffuse: Vec3::new(0.3, 0.28, 0.25),
            specular: Vec3::splat(0.2),
            roughness: 0.3,
            small_blemish_size: 0.003,
            small_blemish_bump_strength: 0.03,
            small_blemish_colour_strength: 0.4,
            dent_strength: 0.05,
            dent_size: 0.1,
            dent_cover: 0.3,
            dent_detail: 2,
            gloss_roughness: 0.25,
            seed: 1,
        }
    }
}

/// A material of any kind with small variations, which make it look less perfect.
///
/// Nilsson 2008, §4.5 and Appendix B: [`Blemishes`] in the specular colour and the normal, [`Dents`] in the normal, and a rough
/// diffuse colour.
///
/// ```
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::{Footprint, Material, SurfacePoint, Variations, VariationsParameters};
///
/// let panel = Variations::new(VariationsParameters { dent_cover: 1.0, ..Default::default() })?;
/// let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.1), Vec3::Z, Footprint::from_width(1e-4));
/// let light = panel.bsdf(&point, Vec3::Z).scattered(Vec3::Z, Vec3::Z);
/// assert!(light.min_element() > 0.05);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variations {
    parameters: VariationsParameters,
    blemishes: Blemishes,
    dents: Dents,
}

/// Varied material as a pixel sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct VariedSurface {
    /// The diffuse colour.
    pub diffuse: Vec3,
    /// The specular colour with blemishes, in [0, 1]³.
    pub specular: Vec3,
    /// The unit normal with blemishes and dents.
    pub normal: Vec3,
    /// The roughness of the facets.
    pub roughness: f32,
    /// The variance of the slope along each axis that the footprint took: α² grows by twice that.
    pub slope_variance: f32,
}

impl Variations {
    /// The material of these parameters.
    ///
    /// # Errors
    /// [`ParameterError`] with the first parameter that is out of its range.
    pub fn new(parameters: VariationsParameters) -> Result<Self, ParameterError> {
        let p = &parameters;
        colour("diffuse", p.diffuse)?;
        colour("specular", p.specular)?;
        for (name, value) in [
            ("roughness", p.roughness),
            ("small_blemish_bump_strength", p.small_blemish_bump_strength),
            ("small_blemish_colour_strength", p.small_blemish_colour_strength),
            ("dent_strength", p.dent_strength),
        ] {
            within(name, value, SHARES)?;
        }
        within("gloss_roughness", p.gloss_roughness, ROUGHNESSES)?;
        let seed = |i| p.seed.wrapping_mul(2).wrapping_add(i);
        Ok(Self {
            blemishes: Blemishes::new(p.small_blemish_size, seed(0))?,
            dents: Dents::new(p.dent_size, p.dent_cover, p.dent_detail, seed(1))?,
            parameters,
        })
    }

    /// The parameters.
    #[must_use]
    pub const fn parameters(&self) -> &VariationsParameters {
        &self.parameters
    }

    /// Colours, normal and lost slopes at a pixel; total: even and flat where the position is not finite.
    #[must_use]
    pub(crate) fn surface(&self, point: &SurfacePoint) -> VariedSurface {
        let (p, n) = (&self.parameters, point.normal);
        let (at, footprint) = (point.position, point.footprint());
        let (bump, dent) = (p.small_blemish_bump_strength, p.dent_strength);
        let gradient =
            self.blemishes.gradient(bump, at, n, footprint) + self.dents.gradient(dent, at, n, footprint);
        let specular = self.blemishes.colour(p.specular, p.small_blemish_colour_strength, at, footprint);
        VariedSurface {
            diffuse: p.diffuse,
            specular: specular.clamp(Vec3::ZERO, Vec3::ONE),
            normal: bumped_normal(n, gradient),
            roughness: p.roughness,
            slope_variance: self.blemishes.removed_slope(bump, footprint)
                + self.dents.removed_slope(dent, footprint),
        }
    }
}

impl Material for Variations {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let (alpha, frame) = (self.parameters.gloss_roughness, point.frame());
        let surface = self.surface(point);
        // Gloss is at the cost of what is scattered.
        let diffuse = surface.diffuse.min(Vec3::ONE - surface.specular);
        let base = EnergyPreservingOrenNayar::clamped(diffuse, surface.roughness);
        let gloss = CookTorrance::new(Beckmann::clamped(alpha, alpha), surface.specular);
        let facets = slope_facets(Vec3::Z, frame.to_local(surface.normal), surface.slope_variance);
        Bsdf::new(wo).with(facets, [base.into(), gloss.into()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Footprint;

    #[test]
    fn every_point_has_a_surface() {
        let panel = Variations::new(VariationsParameters::default()).unwrap();
        for x in [f32::NAN, f32::NEG_INFINITY, -1e30, 0.0, 0.37, 1e30] {
            for width in [0.0, 1e-3, f32::INFINITY] {
                let s = panel.surface(&SurfacePoint::new(
                    Vec3::new(0.1, x, 0.3),
                    Vec3::Z,
                    Footprint::from_width(width),
                ));
                assert!(
                    (s.normal.length() - 1.0).abs() < 1e-5 && s.slope_variance >= 0.0,
                    "{x}, {width}: {s:?}"
                );
                assert!((0.0..=1.0).contains(&s.specular.x), "{x}, {width}: {s:?}");
            }
        }
    }

    #[test]
    fn no_strength_is_a_plain_surface_and_bad_parameters_are_named() {
        let plain = VariationsParameters {
            small_blemish_bump_strength: 0.0,
            small_blemish_colour_strength: 0.0,
            dent_strength: 0.0,
            ..Default::default()
        };
        let point = SurfacePoint::new(Vec3::splat(0.123), Vec3::Z, Footprint::from_width(1e-5));
        let surface = Variations::new(plain).unwrap().surface(&point);
        assert_eq!((surface.normal, surface.specular), (Vec3::Z, plain.specular));
        let error = Variations::new(VariationsParameters { dent_detail: 99, ..plain }).unwrap_err();
        assert!(matches!(error, ParameterError::Outside { parameter: "dent_detail", .. }), "{error}");
    }
}
