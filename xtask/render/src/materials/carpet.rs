//! The carpet of a car.

use asperity_shading::{Carpet, CarpetParameters, CookTorrance};
use glam::Vec3;

use crate::materials::{in_metres, widened};
use crate::{
    failure::Failure,
    integrator::path_tracer::{Appearance, Layer, Seen},
};

/// How rough single threads shine.
const SHEEN: f32 = 0.45;

/// A carpet, in a scene whose unit is so many metres; its rim light has this colour.
pub fn carpet(
    parameters: CarpetParameters,
    metres: f32,
    rim: Vec3,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let carpet = Carpet::new(parameters)?;
    Ok(move |seen: &Seen| {
        let surface = carpet.surface(&in_metres(seen, metres), seen.view);
        let normal = surface.normal;
        let mut layers = Vec::new();
        if let Ok(threads) = surface.reflectance() {
            layers.push(Layer { normal, brdf: Box::new(threads) });
        }
        if surface.specular.max_element() > 0.0 {
            let sheen = CookTorrance::new(widened(SHEEN, surface.slope_variance), surface.specular);
            layers.push(Layer { normal, brdf: Box::new(sheen) });
        }
        Appearance { layers, glow: surface.rim * rim, ..Default::default() }
    })
}
