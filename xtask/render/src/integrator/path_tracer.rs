//! Paths in light from all around: samples of the light and of the material, and one bounce from object to object.

use asperity_shading::{Brdf, Environment};
use glam::Vec3;

use crate::{
    integrator::{MIRRORS, Spot},
    sampling::sampler::Sampler,
    scene::Scene,
};

/// Light that comes by way of another object is cut off here: what is brighter would be speckles.
const BRIGHTEST: f32 = 2.5;

impl Scene<'_, '_> {
    /// Multiple importance sampling by the balance heuristic: one sample of the light and one of the layers.
    ///
    /// Veach 1997, §9.2.
    pub(super) fn lit_by_paths(
        &self,
        light: &dyn Environment,
        spot: &Spot<'_>,
        sampler: &mut Sampler,
        [mirrors, bounces]: [u32; 2],
    ) -> Vec3 {
        let Spot { ray, hit, frame, wo, bsdf, .. } = spot;
        let mut sum = Vec3::ZERO;
        let wi = light.sample(sampler.point());
        let local = frame.to_local(wi);
        // Light comes into a body through another place of its surface, not straight.
        let scattered = if spot.inside(local) { Vec3::ZERO } else { spot.scattered(wi) };
        // Seen by way of another object, samples of the light alone will do.
        let other = if bounces > 0 { bsdf.density(local, *wo) } else { 0.0 };
        if scattered.max_element() > 0.0 {
            let density = light.density(wi) + other;
            sum += self.open(spot.start(local), wi) * scattered * light.radiance(wi) / density;
        }
        if bounces == 0 {
            return sum;
        }
        let local = bsdf.sample(*wo, sampler.point());
        let scattered = bsdf.scattered(local, *wo);
        if scattered.max_element() <= 0.0 {
            return sum;
        }
        let (density, wi) = (bsdf.density(local, *wo), frame.to_world(local).normalize());
        let start = spot.start(local);
        match self.first_hit(start, wi) {
            None => sum + scattered * light.radiance(wi) / (density + light.density(wi)),
            Some(meeting) => {
                let next = ray.scattered(hit, wi, (1.0 / density).sqrt().min(0.5), start);
                // Behind rough glass, a body or a pane, light is on its way still.
                let left = if local.z < 0.0 && mirrors < MIRRORS {
                    [mirrors + 1, bounces]
                } else {
                    [MIRRORS, bounces - 1]
                };
                let sent = self.shade(&next, meeting, sampler, left[0], left[1]);
                sum + scattered / density * sent.min(Vec3::splat(BRIGHTEST))
            }
        }
    }
}
