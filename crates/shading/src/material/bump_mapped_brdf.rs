//! A microfacet BRDF whose facets are the bumps of a field, as a material.

use glam::Vec3;

use crate::bump::Facet;
use crate::level_of_detail::{BumpField, GaussianField};
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::reflectance::{Bsdf, FacetBrdf, Lobe};

/// A microfacet BRDF or BSDF whose facets become bumps when the viewer comes closer.
///
/// The mean over the surface is the BRDF at every zoom, with masking, Fresnel term and
/// transmission, see [`FacetBrdf`]. For the material of an engine use
/// [`StandardMaterial`](crate::StandardMaterial) as the BRDF.
///
/// Very near, a point is almost a mirror, so a mean over points needs many of them.
///
/// ```
/// use asperity_shading::material::{BumpMappedBrdf, Material};
/// use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
/// use asperity_shading::{Brdf, BumpField, Conductor, CookTorrance, Footprint, Ggx, SurfacePoint, glam::Vec3};
///
/// let bumps = BumpField::new(GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default()), 20.0)?;
/// let gold = [Conductor::new(0.18, 3.42)?, Conductor::new(0.42, 2.35)?, Conductor::new(1.37, 1.77)?];
/// let gold = BumpMappedBrdf { brdf: CookTorrance::new(Ggx::new(0.2, 0.4)?, gold), bumps };
/// let seen = |width| {
///     let point = SurfacePoint::new(Vec3::new(0.3, 0.1, 0.8), Vec3::Z, Footprint::from_width(width));
///     gold.bsdf(&point, Vec3::Z).eval(Vec3::Z, Vec3::Z)
/// };
/// assert_eq!(seen(1.0), gold.brdf.eval(Vec3::Z, Vec3::Z));
/// assert_ne!(seen(1e-3), seen(1.0));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BumpMappedBrdf<B, F> {
    /// The BRDF from afar.
    pub brdf: B,
    /// The noise that defines the bumps in space.
    pub bumps: BumpField<F>,
}

impl<B: FacetBrdf, F: GaussianField> Material for BumpMappedBrdf<B, F> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let bumps = self.bumps.coordinates(point.position, &point.frame(), point.footprint());
        let frame = point.frame();
        Bsdf::new(frame, wo)
            .with([Facet::FLAT], [Lobe::bumps(&self.brdf, bumps)])
            .with_emitted(self.brdf.emitted(frame.to_local(wo)))
    }
}
