//! Path tracing under an environment: samples of the light and the material, and one
//! interreflection.

use asperity_shading::reflectance::BsdfSample;
use glam::Vec3;

use crate::{
    integrator::{MIRRORS, Spot},
    light::environments::{SoftPanel, Surroundings},
    sampling::sampler::Sampler,
    scene::Scene,
};

/// Maximum radiance of interreflected light. Brighter samples would be fireflies.
const BRIGHTEST: f32 = 2.5;

/// Continuations where a ray inside a body reaches its other side. At roughness 0.3 their variance
/// is nine times the variance of the rays into it.
const WAYS: u32 = 4;

impl Scene<'_, '_> {
    /// Multiple importance sampling with the power heuristic: one sample of every panel, or of the
    /// light, and one of the layers. Only the layer sample finds the light between panels.
    ///
    /// Veach 1997, §9.2.
    pub(super) fn lit_by_paths(
        &self,
        light: &dyn Surroundings,
        spot: &Spot<'_>,
        sampler: &mut Sampler,
        [mirrors, bounces]: [u32; 2],
    ) -> Vec3 {
        let Spot { ray, hit, normal, .. } = *spot;
        let panels = light.panels();
        if bounces == 0 {
            return self.lit_by_one(light, spot, sampler);
        }
        let mut sum = Vec3::ZERO;
        for panel in panels {
            let wi = panel.sample(sampler.point());
            sum += self.scattered_from(spot, wi, panel.radiance(wi), panel.pdf(wi), true);
        }
        if panels.is_empty() {
            let wi = light.sample(sampler.point());
            sum += self.scattered_from(spot, wi, light.radiance(wi), light.pdf(wi), true);
        }
        let Some(BsdfSample { wi, eval_cos: scattered, pdf, .. }) = spot.sample(sampler) else { return sum };
        if scattered.max_element() <= 0.0 {
            return sum;
        }
        let (wi, start) = (wi.normalize(), spot.start(wi));
        match self.intersect(start, wi) {
            None if panels.is_empty() => sum + scattered * light.radiance(wi) * weight(pdf, light.pdf(wi)),
            None => {
                let weighted = |panel: &SoftPanel| panel.weighted(wi, |other| weight(pdf, other));
                sum + scattered * (light.between(wi) / pdf + panels.iter().map(weighted).sum::<Vec3>())
            }
            Some(meeting) => {
                let next = ray.scattered(hit, wi, (1.0 / pdf).sqrt().min(0.5), start);
                // Behind rough glass, a body or a pane, light is not yet blocked.
                let left = if wi.dot(normal) < 0.0 && mirrors < MIRRORS {
                    [mirrors + 1, bounces]
                } else {
                    [MIRRORS, bounces - 1]
                };
                let ways = if mirrors == 0 && spot.inside(wi) { WAYS } else { 1 };
                let mut way =
                    || self.shade(&next, meeting, sampler, left[0], left[1]).min(Vec3::splat(BRIGHTEST));
                sum + scattered / pdf * (0..ways).map(|_| way()).sum::<Vec3>() / ways as f32
            }
        }
    }

    /// Returns the light along a single ray, sufficient for interreflections: to one of the panels
    /// or to the room between them, in proportion to the unshadowed light.
    ///
    /// One term of a sum replaces the whole sum, divided by its probability: Talbot, Cline and
    /// Egbert 2005, "Importance Resampling for Global Illumination".
    fn lit_by_one(&self, light: &dyn Surroundings, spot: &Spot<'_>, sampler: &mut Sampler) -> Vec3 {
        let panels = light.panels();
        if panels.is_empty() {
            let wi = light.sample(sampler.point());
            return self.scattered_from(spot, wi, light.radiance(wi), light.pdf(wi), false);
        }
        let sample = spot.sample(sampler);
        let mut u = sampler.point().x;
        let (mut all, mut chosen) = (0.0, (Vec3::ZERO, Vec3::ZERO));
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
        if let Some(sample) = sample {
            let wi = sample.wi.normalize();
            offer(wi, sample.weight() * light.between(wi));
        }
        for panel in panels {
            let wi = panel.sample(sampler.point());
            offer(wi, Self::unshadowed(spot, wi, panel.radiance(wi) / panel.pdf(wi)));
        }
        let (wi, color) = chosen;
        if all > 0.0 { self.open(spot.start(wi), wi) * all * color } else { Vec3::ZERO }
    }

    /// Returns the scattered radiance from a direction, ignoring occlusion.
    fn unshadowed(spot: &Spot<'_>, wi: Vec3, radiance: Vec3) -> Vec3 {
        // Light enters a body at another point of its surface, not along a straight line.
        if spot.inside(wi) || radiance == Vec3::ZERO { Vec3::ZERO } else { spot.scattered(wi) * radiance }
    }

    /// Returns the scattered radiance of a sampled direction, weighted against samples of the
    /// layers, if there are any.
    fn scattered_from(&self, spot: &Spot<'_>, wi: Vec3, radiance: Vec3, pdf: f32, layers: bool) -> Vec3 {
        let scattered = Self::unshadowed(spot, wi, radiance);
        if scattered.max_element() <= 0.0 {
            return Vec3::ZERO;
        }
        let other = if layers { spot.pdf(wi) } else { 0.0 };
        self.open(spot.start(wi), wi) * scattered * weight(pdf, other)
    }
}

/// Returns the weight of a sample by the power heuristic with exponent 2, divided by its pdf:
/// `p / (p² + q²)` against samples of pdf `q`.
///
/// Samples of a matte surface that hit a small panel by chance hardly contribute. With the balance
/// heuristic they would be fireflies.
fn weight(pdf: f32, other: f32) -> f32 {
    let ratio = other / pdf;
    1.0 / (pdf * (1.0 + ratio * ratio))
}
