//! Shading of a surface point by a normal density function under a few lights.

use asperity_ndf_sampling::NormalTable;
use asperity_shading::{
    BumpField, Coordinates, Footprint, Frame, GaussianField, LevelOfDetail, Ndf, half_vector, shade_facet,
};
use glam::Vec3;

use crate::{geometry::shape::Hit, light::lamps::Light};

/// A normal density function that rows of pixels may share.
pub type SharedNdf = dyn Ndf + Send + Sync;

/// Which facets a pixel is shaded with.
#[derive(Clone, Copy)]
pub enum Facets<'a> {
    /// Drawn from the density itself, by one of the two rules.
    Consistent(LevelOfDetail),
    /// Looked up in a table L, which may belong to another density, and each shaded with the whole density: the
    /// pipeline of the source. The table's entry at 0 must be the flat normal.
    Table(&'a NormalTable),
}

/// A surface whose bumps and shading come from a normal density function.
pub struct Material<'a, F> {
    pub ndf: &'a SharedNdf,
    pub facets: Facets<'a>,
    pub bumps: &'a BumpField<F>,
    pub lights: &'a [Light],
    /// Reflectance of the diffuse term under the sky; zero leaves the density alone.
    pub diffuse: Vec3,
}

impl<F: GaussianField> Material<'_, F> {
    /// The radiance from the point towards the unit direction `wo`.
    ///
    /// ```text
    /// L = Σ_lights colour · p(h) · max(0, n·l) + diffuse · sky(m)
    /// ```
    ///
    /// The source shows `p(h)` alone; the cosine with the surface's own normal lets each light end at its horizon
    /// without an edge, and is constant over a flat patch. The diffuse term, of the bump normal `m` under a soft sky,
    /// is the source's own suggestion (§6); it keeps the shape readable where no facet mirrors a light.
    pub fn radiance(&self, hit: &Hit, wo: Vec3, footprint: Footprint) -> Vec3 {
        self.shade(hit, wo, self.bumps.coordinates(hit.position, footprint))
    }

    /// [`Material::radiance`] where the bump map has these coordinates.
    pub fn shade(&self, hit: &Hit, wo: Vec3, coordinates: Coordinates) -> Vec3 {
        let frame = Frame::from_normal_tangent(hit.normal, hit.tangent);
        let facet = self.facet(coordinates);
        let lit = self.lights.iter().fold(Vec3::ZERO, |sum, light| {
            let cosine = light.direction.dot(hit.normal);
            if cosine <= 0.0 {
                return sum;
            }
            let h = frame.to_local(half_vector(light.direction, wo));
            let p = match self.facets {
                Facets::Consistent(LevelOfDetail::Exact) => {
                    LevelOfDetail::Exact.radiance(self.ndf, h, coordinates)
                }
                // One frame for all lights.
                Facets::Consistent(LevelOfDetail::Fractal) | Facets::Table(_) => {
                    shade_facet(self.ndf, &facet, h)
                }
            };
            sum + light.colour * (p * cosine)
        });
        lit + self.diffuse * sky(frame.to_world(facet.normal))
    }

    /// The facet in the frame of the surface.
    pub fn facet(&self, coordinates: Coordinates) -> Frame {
        match self.facets {
            Facets::Consistent(rule) => Frame::from_normal(rule.normal(self.ndf, coordinates)),
            Facets::Table(table) => table.bilinear(coordinates.z * coordinates.fade),
        }
    }
}

/// What a diffuse surface with normal `m` gets from a sky that is brightest in the upper left front.
pub fn sky(m: Vec3) -> Vec3 {
    const ZENITH: Vec3 = Vec3::new(-0.42, -0.47, 0.776);
    let t = 0.5 + 0.5 * m.dot(ZENITH);
    Vec3::new(0.10, 0.09, 0.11).lerp(Vec3::new(0.98, 0.95, 0.92), t * t)
}
