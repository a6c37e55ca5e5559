//! A surface whose bumps and shading come from a density of normals.

use std::sync::Arc;

use asperity_shading::{
    Brdf, BumpField, Coordinates, Frame, LevelOfDetail, half_vector, ndf_sampling::inverse_phi, reflect,
};
use glam::{Vec2, Vec3};

use crate::{
    integrator::{
        direct::SharedNdf,
        path_tracer::{Appearance, Layer, Seen},
    },
    materials::field::Field,
};

/// Bumps of a density, shaded with it by a rule of level of detail, in this colour.
///
/// ```text
/// f_r = colour · p(h | what is resolved)/(4 max(cos θ_i, cos θ_o))
/// ```
///
/// The source shows p(h) alone; the denominator makes a reciprocal reflectance of it that sends out no more light than comes in.
pub fn bumped(
    ndf: Arc<SharedNdf>,
    rule: LevelOfDetail,
    bumps: BumpField<Field>,
    colour: Vec3,
) -> impl Fn(&Seen) -> Appearance + Sync {
    move |seen: &Seen| {
        let point = &seen.point;
        let coordinates = bumps.coordinates(point.position, point.footprint());
        let facet = Frame::from_normal(rule.normal(ndf.as_ref(), coordinates));
        let brdf = Resolved { ndf: Arc::clone(&ndf), rule, coordinates, facet, colour };
        Appearance {
            layers: vec![Layer { normal: point.normal, brdf: Box::new(brdf) }],
            ..Default::default()
        }
    }
}

/// A density of which some is resolved.
struct Resolved {
    ndf: Arc<SharedNdf>,
    rule: LevelOfDetail,
    coordinates: Coordinates,
    /// The resolved facet.
    facet: Frame,
    colour: Vec3,
}

impl Brdf for Resolved {
    fn value(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return Vec3::ZERO;
        }
        let p = self.rule.radiance(self.ndf.as_ref(), half_vector(wi, wo), self.coordinates);
        self.colour * (p / (4.0 * wi.z.max(wo.z)))
    }

    fn sample(&self, wo: Vec3, u: Vec2) -> Vec3 {
        let h = match self.rule {
            LevelOfDetail::Exact => {
                let gauss = |u: f32| inverse_phi(f64::from(u).max(1e-9)) as f32;
                let Coordinates { z, share, .. } = self.coordinates;
                let spread = (1.0 - share).max(0.0).sqrt() * Vec2::new(gauss(u.x), gauss(u.y));
                self.ndf.from_gaussian(share.sqrt() * z + spread)
            }
            LevelOfDetail::Fractal => self.facet.to_world(self.ndf.sample(u)),
        };
        reflect(wo, h)
    }

    fn density(&self, wi: Vec3, wo: Vec3) -> f32 {
        let h = half_vector(wi, wo);
        let cosine = match self.rule {
            LevelOfDetail::Exact => h.z,
            LevelOfDetail::Fractal => h.dot(self.facet.normal),
        };
        let p = self.rule.radiance(self.ndf.as_ref(), h, self.coordinates);
        p * cosine.max(0.0) / (4.0 * wo.dot(h)).max(1e-6)
    }
}
