//! A bump map of an NDF as a material.

use asperity_ndf_sampling::Ndf;
use glam::Vec3;

use crate::bump::Facet;
use crate::level_of_detail::{BumpField, GaussianField, LevelOfDetail};
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::reflectance::{Bsdf, Lobe};

/// A bump map of an NDF, shaded with the NDF by a level-of-detail rule.
///
/// ```text
/// f_r = color · p(h | what the pixel resolves) min(1, h_z/(ωo·h))/(4 max(cos θ_i, cos θ_o))
/// ```
///
/// Under [`LevelOfDetail::Exact`] its mean over the surface is the far field at every zoom.
///
/// Kautz, Heidrich, Seidel 2001, *Real-Time Bump Map Synthesis*.
///
/// ```
/// use asperity_shading::material::{BumpMapped, Material};
/// use asperity_shading::noise::{GaussianNoise, GaussianFbm, FbmSpectrum};
/// use asperity_shading::{Brdf, BumpField, Footprint, Ggx, LevelOfDetail, SurfacePoint, glam::Vec3};
///
/// let bumps = BumpField::new(GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default()), 20.0)?;
/// let copper = BumpMapped { ndf: Ggx::new(0.2, 0.4)?, bumps, rule: LevelOfDetail::Exact, color: Vec3::new(0.9, 0.6, 0.5) };
/// let seen = |width| {
///     let point = SurfacePoint::new(Vec3::new(0.3, 0.1, 0.8), Vec3::Z, Footprint::from_width(width));
///     copper.bsdf(&point, Vec3::Z).eval(Vec3::Z, Vec3::Z).x
/// };
/// assert_eq!(seen(1.0), seen(2.0));
/// assert_ne!(seen(1.0), seen(1e-3));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BumpMapped<N, F> {
    /// The NDF.
    pub ndf: N,
    /// The noise that defines the bumps in space.
    pub bumps: BumpField<F>,
    /// The level-of-detail rule.
    pub rule: LevelOfDetail,
    /// The reflectance of the facets; non-positive components are read as 0.
    pub color: Vec3,
}

impl<N: Ndf, F: GaussianField> Material for BumpMapped<N, F> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let coordinates = self.bumps.coordinates(point.position, &point.frame(), point.footprint());
        let lobe = Lobe::resolved(&self.ndf, self.rule, coordinates).weighted(self.color);
        Bsdf::new(point.frame(), wo).with([Facet::FLAT], [lobe])
    }
}
