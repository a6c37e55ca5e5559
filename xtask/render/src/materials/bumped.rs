//! A surface whose bumps and shading come from a density of normals.

use asperity_ndf_sampling::NormalTable;
use asperity_shading::level_of_detail::{Coordinates, shade_facet};
use asperity_shading::{
    BumpField, Frame, LevelOfDetail, Ndf, SurfacePoint, half_vector, material::Material, reflectance::Bsdf,
};
use glam::Vec3;

use crate::{light::lamps::Lamp, materials::field::Field};

/// A normal density function that rows of pixels may share.
pub type SharedNdf = dyn Ndf + Send + Sync;

/// Lamps that are shaded at once.
const TOGETHER: usize = 32;

/// Which facets a pixel is shaded with.
#[derive(Clone, Copy)]
pub enum Facets<'a> {
    /// Drawn from the density itself, by one of the two rules.
    Consistent(LevelOfDetail),
    /// Looked up in a table L, which may belong to another density, and each shaded with the whole density: the
    /// pipeline of the source. The table's entry at 0 must be the flat normal.
    Table(&'a NormalTable),
}

impl Facets<'_> {
    /// The facet in the frame of the surface.
    fn facet(&self, ndf: &SharedNdf, coordinates: Coordinates) -> Frame {
        match self {
            Self::Consistent(rule) => Frame::from_normal(rule.normal(ndf, coordinates)),
            Self::Table(table) => table.bilinear(coordinates.z * coordinates.fade),
        }
    }
}

/// The source's own shading under lamps without shadows, which is no reflectance: the density at the half-vector is shown as it is.
///
/// ```text
/// L = Σ_lamps colour · p(h) · max(0, n·l) + diffuse · sky(m)
/// ```
///
/// The cosine with the surface's own normal lets each light end at its horizon without an edge, and is constant over a flat
/// patch. The diffuse term, of the bump normal `m` under a soft sky, is the source's own suggestion (§6); it keeps the shape
/// readable where no facet mirrors a light.
pub struct Printed<'a> {
    pub ndf: &'a SharedNdf,
    pub facets: Facets<'a>,
    pub bumps: BumpField<Field>,
    pub lamps: Vec<Lamp>,
    pub diffuse: Vec3,
}

impl Material for Printed<'_> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let coordinates = self.bumps.coordinates(point.position, point.footprint());
        let (frame, facet) = (point.frame(), self.facets.facet(self.ndf, coordinates));
        let mut lit = Vec3::ZERO;
        for lamps in self.lamps.chunks(TOGETHER) {
            let (mut halves, mut shown) = ([Vec3::ZERO; TOGETHER], [0.0; TOGETHER]);
            let wi = |lamp: &Lamp| frame.to_local(lamp.direction);
            for (half, lamp) in halves.iter_mut().zip(lamps) {
                *half = half_vector(wi(lamp), wo);
            }
            let halves = &halves[..lamps.len()];
            match self.facets {
                Facets::Consistent(LevelOfDetail::Exact) => {
                    LevelOfDetail::Exact.radiances(self.ndf, halves, coordinates, &mut shown);
                }
                // One frame for all lamps.
                Facets::Consistent(LevelOfDetail::Fractal) | Facets::Table(_) => {
                    shown.iter_mut().zip(halves).for_each(|(p, &h)| *p = shade_facet(self.ndf, &facet, h));
                }
            }
            lit += lamps
                .iter()
                .zip(shown)
                .map(|(lamp, p)| lamp.colour * (p * wi(lamp).z.max(0.0)))
                .sum::<Vec3>();
        }
        Bsdf::new(wo).with_emitted(lit + self.diffuse * sky(frame.to_world(facet.normal)))
    }
}

/// Irradiance of a soft sky, brightest in the upper left front, on a surface with normal `m`, over π.
pub fn sky(m: Vec3) -> Vec3 {
    const ZENITH: Vec3 = Vec3::new(-0.42, -0.47, 0.776);
    let t = 0.5 + 0.5 * m.dot(ZENITH);
    Vec3::new(0.10, 0.09, 0.11).lerp(Vec3::new(0.98, 0.95, 0.92), t * t)
}
