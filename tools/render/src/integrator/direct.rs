//! Direct light of lamps, with shadows.

use std::f32::consts::PI;

use glam::Vec3;

use crate::{integrator::Spot, light::lamps::Lamps, scene::Scene};

impl Scene<'_, '_> {
    /// Returns `π Σ color · f_r cos θ` over the visible lamps.
    pub(super) fn lit_by_lamps(&self, lamps: &[Lamps], spot: &Spot<'_>) -> Vec3 {
        let lit = lamps.iter().map(|lamps| match lamps {
            Lamps::Far { lights, shadow } => {
                let open = shadow.map_or(Vec3::ONE, |direction| self.open(spot.starts[0], direction));
                if open == Vec3::ZERO {
                    return Vec3::ZERO;
                }
                open * lights
                    .iter()
                    .fold(Vec3::ZERO, |sum, light| sum + light.color * spot.scattered(light.direction))
            }
            Lamps::Near { place, color } => {
                let towards = (place.as_dvec3() - self.focus).as_vec3() - spot.starts[0];
                let direction = towards.normalize_or_zero();
                let reflected = spot.scattered(direction);
                if reflected == Vec3::ZERO {
                    return Vec3::ZERO;
                }
                self.open(spot.starts[0], direction) * *color * reflected / towards.length_squared()
            }
        });
        PI * lit.sum::<Vec3>()
    }
}
