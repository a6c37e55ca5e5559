//! A surface whose bumps and shading come from a normal density.

use std::f32::consts::PI;

use asperity_ndf_sampling::NormalLut;
use asperity_shading::level_of_detail::{ResolvedBumps, shade_facet};
use asperity_shading::{
    BumpField, Frame, LevelOfDetail, Ndf, SurfacePoint, half_vector, material::Material, reflectance::Bsdf,
};
use glam::Vec3;

use crate::{light::lamps::Lamp, materials::field::Field};

/// A normal density that threads can share.
pub type SharedNdf = dyn Ndf + Send + Sync;

/// Number of lamps shaded at once.
const TOGETHER: usize = 32;

/// The facets with which a pixel is shaded.
#[derive(Clone, Copy)]
pub enum Facets<'a> {
    /// Drawn from the density by one of the two rules.
    Consistent(LevelOfDetail),
    /// Looked up in a table L, possibly of another density, and shaded with the whole density: the
    /// pipeline of the source. The table's entry at 0 must be the flat normal.
    Table(&'a NormalLut),
}

impl Facets<'_> {
    /// Returns the facet in the frame of the surface.
    fn facet(&self, ndf: &SharedNdf, coordinates: ResolvedBumps) -> Frame {
        match self {
            Self::Consistent(rule) => Frame::from_normal(rule.normal(ndf, coordinates)),
            Self::Table(table) => table.bilinear(coordinates.z * coordinates.blend),
        }
    }
}

/// The source's own shading under lamps without shadows. It is not a reflectance: the density at
/// the half vector is displayed directly.
///
/// ```text
/// L = Σ_lamps color · p(h) · max(0, n·l) + diffuse · sky(m)
/// ```
///
/// The cosine with the geometric normal lets each light fade smoothly at its horizon, and is
/// constant over a flat patch. The diffuse term, of the bump normal `m` under a soft sky, follows
/// the source's suggestion (§6). It keeps the shape readable where no facet mirrors a light.
pub struct Printed<'a> {
    pub ndf: &'a SharedNdf,
    pub facets: Facets<'a>,
    pub bumps: BumpField<Field>,
    pub lamps: Vec<Lamp>,
    /// Maximum fraction of the variance that counts as resolved. Closer facets show the same image
    /// of a lamp.
    pub most: f32,
    pub diffuse: Vec3,
}

/// Returns the fraction of variance of facets that show different images of a lamp. The rest lies
/// within the lamp's disc.
///
/// ```text
/// s = 1 − p(n) π ρ²/8
/// ```
///
/// Half vectors of a disc of radius ρ fill π ρ²/4. In Gaussian coordinates at their center, this is
/// multiplied by 2π p(n), and a disc has a variance of its area over 4π. The mean over the surface
/// is the same for every fraction: p_s(h | z) has the mean p(h).
pub fn share_beyond(peak: f32, radius: f32) -> f32 {
    (1.0 - peak * PI * radius * radius / 8.0).max(0.0)
}

impl Material for Printed<'_> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let frame = point.frame();
        let coordinates = self.bumps.coordinates(point.position, &frame, point.footprint());
        let coordinates = ResolvedBumps { variance: coordinates.variance.min(self.most), ..coordinates };
        let facet = self.facets.facet(self.ndf, coordinates);
        let local = frame.to_local(wo);
        let mut lit = Vec3::ZERO;
        for lamps in self.lamps.chunks(TOGETHER) {
            let (mut halves, mut shown) = ([Vec3::ZERO; TOGETHER], [0.0; TOGETHER]);
            let wi = |lamp: &Lamp| frame.to_local(lamp.direction);
            for (half, lamp) in halves.iter_mut().zip(lamps) {
                *half = half_vector(wi(lamp), local);
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
            lit +=
                lamps.iter().zip(shown).map(|(lamp, p)| lamp.color * (p * wi(lamp).z.max(0.0))).sum::<Vec3>();
        }
        Bsdf::new(frame, wo).with_emitted(lit + self.diffuse * sky(frame.to_world(facet.normal)))
    }
}

/// Returns the irradiance of a soft sky, brightest at the upper left front, on a surface with
/// normal `m`, over π.
pub fn sky(m: Vec3) -> Vec3 {
    const ZENITH: Vec3 = Vec3::new(-0.42, -0.47, 0.776);
    let t = 0.5 + 0.5 * m.dot(ZENITH);
    Vec3::new(0.10, 0.09, 0.11).lerp(Vec3::new(0.98, 0.95, 0.92), t * t)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use asperity_ndf_sampling::Ggx;
    use asperity_shading::Footprint;
    use glam::DVec3;

    use super::*;
    use crate::materials::field::{Bumps, NoiseKind};

    /// Returns mean and maximum radiance of a fine patch under a lamp mirrored by its flat normal,
    /// for lamps of this radius.
    fn seen(radius: f32) -> (f32, f32) {
        const SIDE: u16 = 200;
        let ndf = Ggx::new(0.2, 0.4).unwrap();
        let bumps = Bumps { kind: NoiseKind::Gaussian, frequency: 1.0, octaves: 16, gain: 0.8 };
        let material = Printed {
            ndf: &ndf,
            facets: Facets::Consistent(LevelOfDetail::Exact),
            bumps: bumps.field(3, DVec3::ZERO).unwrap(),
            lamps: vec![Lamp { direction: Vec3::Z, color: Vec3::ONE }],
            most: share_beyond(ndf.d(Vec3::Z), radius),
            diffuse: Vec3::ZERO,
        };
        let (mut sum, mut largest) = (0.0, 0.0_f32);
        for k in 0..SIDE * SIDE {
            let place = Vec3::new(f32::from(k % SIDE), f32::from(k / SIDE), 0.3) * 0.37;
            let point = SurfacePoint::new(place, Vec3::Z, Footprint::from_width(1e-4));
            let radiance = material.bsdf(&point, Vec3::Z).emitted().x;
            (sum, largest) = (sum + radiance, largest.max(radiance));
        }
        (sum / f32::from(SIDE).powi(2), largest)
    }

    #[test]
    fn lamp_radius_keeps_the_mean_and_lowers_the_peak() {
        let far = Ggx::new(0.2, 0.4).unwrap().d(Vec3::Z);
        let [(point, brightest), (disc, bright)] = [0.02, 0.14].map(seen);
        // 40,000 points of 5500 cells, with a standard deviation of 4 means for the disc and 30 for
        // the point.
        assert_relative_eq!(disc, far, max_relative = 0.12);
        assert_relative_eq!(point, far, max_relative = 0.8);
        // p_s(h | z) is at most p(h)/(1 − s), here at the peak.
        let most = far / (1.0 - share_beyond(far, 0.14));
        assert!(bright <= 1.001 * most && bright > 0.5 * most, "{bright} of {most}");
        assert!(brightest > 3.0 * bright, "{brightest} of a point, {bright} of a disc");
    }
}
