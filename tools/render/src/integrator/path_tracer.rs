//! Paths in light from all around: samples of the light and of the material, and one bounce from object to object.

use asperity_shading::Brdf;
use glam::Vec3;

use crate::{
    integrator::{MIRRORS, Spot},
    light::environments::{SoftPanel, Surroundings},
    sampling::sampler::Sampler,
    scene::Scene,
};

/// Light that comes by way of another object is cut off here: what is brighter would be speckles.
const BRIGHTEST: f32 = 2.5;

/// Ways on from where a ray into a body meets its other side: at a roughness of 0.3 they vary nine times as much as
/// the rays into it.
const WAYS: u32 = 4;

impl Scene<'_, '_> {
    /// Multiple importance sampling by the power heuristic: one sample of every panel, or of the light, and one of the layers, which
    /// alone find the light between panels.
    ///
    /// Veach 1997, §9.2.
    pub(super) fn lit_by_paths(
        &self,
        light: &dyn Surroundings,
        spot: &Spot<'_>,
        sampler: &mut Sampler,
        [mirrors, bounces]: [u32; 2],
    ) -> Vec3 {
        let Spot { ray, hit, frame, wo, bsdf, .. } = spot;
        let panels = light.panels();
        if bounces == 0 {
            return self.lit_by_one(light, spot, sampler);
        }
        let mut sum = Vec3::ZERO;
        for panel in panels {
            let wi = panel.sample(sampler.point());
            sum += self.scattered_from(spot, wi, panel.radiance(wi), panel.density(wi), true);
        }
        if panels.is_empty() {
            let wi = light.sample(sampler.point());
            sum += self.scattered_from(spot, wi, light.radiance(wi), light.density(wi), true);
        }
        let local = bsdf.sample(*wo, sampler.point());
        let scattered = bsdf.scattered(local, *wo);
        if scattered.max_element() <= 0.0 {
            return sum;
        }
        let (density, wi) = (bsdf.density(local, *wo), frame.to_world(local).normalize());
        let start = spot.start(local);
        match self.first_hit(start, wi) {
            None if panels.is_empty() => {
                sum + scattered * light.radiance(wi) * weight(density, light.density(wi))
            }
            None => {
                let weighted = |panel: &SoftPanel| panel.weighted(wi, |other| weight(density, other));
                sum + scattered * (light.between(wi) / density + panels.iter().map(weighted).sum::<Vec3>())
            }
            Some(meeting) => {
                let next = ray.scattered(hit, wi, (1.0 / density).sqrt().min(0.5), start);
                // Behind rough glass, a body or a pane, light is on its way still.
                let left = if local.z < 0.0 && mirrors < MIRRORS {
                    [mirrors + 1, bounces]
                } else {
                    [MIRRORS, bounces - 1]
                };
                let ways = if mirrors == 0 && spot.inside(local) { WAYS } else { 1 };
                let mut way =
                    || self.shade(&next, meeting, sampler, left[0], left[1]).min(Vec3::splat(BRIGHTEST));
                sum + scattered / density * (0..ways).map(|_| way()).sum::<Vec3>() / ways as f32
            }
        }
    }

    /// Light along one ray, which will do for what is seen by way of another object: to one of the panels or to the room between them,
    /// as likely as there is light from it where nothing is in the way.
    ///
    /// One part of a sum in place of all, over the chance of that part: Talbot, Cline and Egbert 2005, "Importance Resampling for Global
    /// Illumination".
    fn lit_by_one(&self, light: &dyn Surroundings, spot: &Spot<'_>, sampler: &mut Sampler) -> Vec3 {
        let Spot { frame, wo, bsdf, .. } = spot;
        let panels = light.panels();
        if panels.is_empty() {
            let wi = light.sample(sampler.point());
            return self.scattered_from(spot, wi, light.radiance(wi), light.density(wi), false);
        }
        let local = bsdf.sample(*wo, sampler.point());
        let wi = frame.to_world(local).normalize();
        let between = bsdf.scattered(local, *wo) * light.between(wi) / bsdf.density(local, *wo);
        let mut u = sampler.point().x;
        let (mut all, mut chosen) = (0.0, (wi, Vec3::ZERO));
        let mut offer = |wi: Vec3, sent: Vec3| {
            let share = sent.element_sum();
            if !(share > 0.0 && share.is_finite()) {
                return;
            }
            all += share;
            let chance = share / all;
            if u < chance {
                (u, chosen) = (u / chance, (wi, sent / share));
            } else {
                u = (u - chance) / (1.0 - chance);
            }
        };
        offer(wi, between);
        for panel in panels {
            let wi = panel.sample(sampler.point());
            offer(wi, Self::unshadowed(spot, wi, panel.radiance(wi) / panel.density(wi)));
        }
        let (wi, colour) = chosen;
        if all > 0.0 { self.open(spot.start(frame.to_local(wi)), wi) * all * colour } else { Vec3::ZERO }
    }

    /// The part of a radiance from a direction that is scattered where nothing is in its way.
    fn unshadowed(spot: &Spot<'_>, wi: Vec3, radiance: Vec3) -> Vec3 {
        let local = spot.frame.to_local(wi);
        // Light comes into a body through another place of its surface, not straight.
        if spot.inside(local) || radiance == Vec3::ZERO {
            Vec3::ZERO
        } else {
            spot.bsdf.scattered(local, spot.wo) * radiance
        }
    }

    /// The part of a radiance from a sampled direction that is scattered, weighted beside samples of the layers, if there are such.
    fn scattered_from(&self, spot: &Spot<'_>, wi: Vec3, radiance: Vec3, density: f32, layers: bool) -> Vec3 {
        let local = spot.frame.to_local(wi);
        let scattered = Self::unshadowed(spot, wi, radiance);
        if scattered.max_element() <= 0.0 {
            return Vec3::ZERO;
        }
        let other = if layers { spot.bsdf.density(local, spot.wo) } else { 0.0 };
        self.open(spot.start(local), wi) * scattered * weight(density, other)
    }
}

/// The weight of a sample by the power heuristic with exponent 2, over the density that it was drawn with: `p / (p² + q²)` beside
/// samples of density `q`.
///
/// Samples of a matte surface that meet a small panel by chance hardly count, while by the balance heuristic they are speckles.
fn weight(density: f32, other: f32) -> f32 {
    let ratio = other / density;
    1.0 / (density * (1.0 + ratio * ratio))
}
