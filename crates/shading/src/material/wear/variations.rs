//! Variations for any material: roughness, blemishes and dents.

use glam::Vec3;

use crate::bump::bumped_normal;
use crate::error::ShadingError;
use crate::material::glossy::GlossySurface;
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::material::wear::blemish::Blemishes;
use crate::material::wear::dent::{Dents, DentsParameters};
use crate::parameter::{as_roughness, as_share, color, parameters};
use crate::reflectance::Bsdf;

parameters! {
    /// The parameters of [`Variations`], named as in Nilsson 2008, Appendix B.
    ///
    /// Sizes are in units of the surface positions, within `[10⁻⁶, 10⁶]`. Strengths, fractions and
    /// colors are within `[0, 1]`. The defaults are a plastic panel in meters.
    pub struct VariationsParameters of Variations {
        /// The diffuse color. Default (0.3, 0.28, 0.25).
        diffuse: Vec3 = Vec3::new(0.3, 0.28, 0.25), color;
        /// The specular color. Default 0.2.
        specular: Vec3 = Vec3::splat(0.2), color;
        /// The roughness of the facets, as in
        /// [`EnergyPreservingOrenNayar`](crate::EnergyPreservingOrenNayar). Default 0.3.
        roughness: f32 = 0.3, as_share;
        /// The size of blemishes. Default 0.003.
        small_blemish_size: f32 = 0.003;
        /// Tilt of the normal by blemishes: their height over their size. Default 0.03.
        small_blemish_bump_strength: f32 = 0.03, as_share;
        /// Variation of the specular color by blemishes. Default 0.4.
        small_blemish_color_strength: f32 = 0.4, as_share;
        /// Tilt of the normal by dents: their height over their size. Default 0.05.
        dent_strength: f32 = 0.05, as_share;
        /// The size of dents. Default 0.1.
        dent_size: f32 = 0.1;
        /// Cover of dents: the fraction of gradients that is kept. Default 0.3, the drop of 70 % in
        /// the thesis.
        dent_cover: f32 = 0.3;
        /// The number of octaves of dents, from 1 to 8. Default 2.
        dent_detail: u32 = 2;
        /// The roughness of the gloss: Beckmann's α, within `[0.01, 1]`; not in the thesis. Default
        /// 0.25.
        gloss_roughness: f32 = 0.25, as_roughness;
        /// Random seed.
        seed: u32 = 1;
    }
}

/// A material with small variations that make it look less perfect.
///
/// Nilsson 2008, §4.5 and Appendix B: [`Blemishes`] in the specular color and the normal, [`Dents`]
/// in the normal, and a rough diffuse color.
///
/// ```
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::{Footprint, Material, SurfacePoint, Variations, VariationsParameters};
///
/// let panel = Variations::new(VariationsParameters { dent_cover: 1.0, ..Default::default() })?;
/// let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.1), Vec3::Z, Footprint::from_width(1e-4));
/// let light = panel.bsdf(&point, Vec3::Z).eval_cos(Vec3::Z, Vec3::Z);
/// assert!(light.min_element() > 0.05);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variations {
    parameters: VariationsParameters,
    blemishes: Blemishes,
    dents: Dents,
}

impl Variations {
    /// Creates the material of these parameters.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range.
    pub fn new(parameters: VariationsParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        let p = &parameters;
        let seed = |i| p.seed.wrapping_mul(2).wrapping_add(i);
        Ok(Self {
            blemishes: Blemishes::new(p.small_blemish_size, seed(0))?,
            dents: Dents::new(DentsParameters {
                dent_size: p.dent_size,
                dent_cover: p.dent_cover,
                dent_detail: p.dent_detail,
                seed: seed(1),
            })?,
            parameters,
        })
    }

    /// Blemishes and dents.
    pub(crate) const fn parts(&self) -> (&Blemishes, &Dents) {
        (&self.blemishes, &self.dents)
    }

    /// Colors, normal and unresolved slopes at a pixel; uniform and flat if the position is not
    /// finite.
    fn surface(&self, point: &SurfacePoint) -> GlossySurface {
        let (p, n) = (&self.parameters, point.normal);
        let (at, footprint) = (point.position, point.footprint());
        let (bump, dent) = (p.small_blemish_bump_strength, p.dent_strength);
        let gradient =
            self.blemishes.gradient(bump, at, n, footprint) + self.dents.gradient(dent, at, n, footprint);
        let specular = self.blemishes.color(p.specular, p.small_blemish_color_strength, at, footprint);
        GlossySurface {
            diffuse: p.diffuse,
            specular: specular.clamp(Vec3::ZERO, Vec3::ONE),
            normal: bumped_normal(n, gradient),
            slope_variance: self.blemishes.removed_slope(bump, footprint)
                + self.dents.removed_slope(dent, footprint),
            ridges: Vec3::ZERO,
        }
    }
}

impl Material for Variations {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let p = &self.parameters;
        let mut bsdf = Bsdf::new(point.frame(), wo);
        self.surface(point).add_to(&mut bsdf, &point.frame(), p.roughness, p.gloss_roughness);
        bsdf
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        let (p, at, footprint) = (&self.parameters, point.position, point.footprint());
        self.blemishes.height(p.small_blemish_bump_strength, at, footprint)
            + self.dents.height(p.dent_strength, at, footprint)
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        let p = &self.parameters;
        let most = p.small_blemish_bump_strength * p.small_blemish_size + p.dent_strength * p.dent_size;
        Some([-most, most])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Footprint;

    #[test]
    fn zero_strength_is_flat() {
        let plain = VariationsParameters {
            small_blemish_bump_strength: 0.0,
            small_blemish_color_strength: 0.0,
            dent_strength: 0.0,
            ..Default::default()
        };
        let point = SurfacePoint::new(Vec3::splat(0.123), Vec3::Z, Footprint::from_width(1e-5));
        let surface = Variations::new(plain).unwrap().surface(&point);
        assert_eq!((surface.normal, surface.specular), (Vec3::Z, plain.specular));
    }
}
