//! Plastic with variations, and scratched metal.

use asperity_shading::{
    CookTorrance, EnergyPreservingOrenNayar, Scratches, ScratchesParameters, Variations, VariationsParameters,
};
use glam::Vec3;

use crate::materials::{in_metres, widened};
use crate::{
    failure::Failure,
    integrator::path_tracer::{Appearance, Layer, Seen},
};

/// A glossy panel with blemishes and dents, whose gloss is this rough.
pub fn panel(
    parameters: VariationsParameters,
    metres: f32,
    gloss: f32,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let panel = Variations::new(parameters)?;
    Ok(move |seen: &Seen| {
        let surface = panel.surface(&in_metres(seen, metres));
        let normal = surface.normal;
        let lobe = CookTorrance::new(widened(gloss, surface.slope_variance), surface.specular);
        let mut layers = vec![Layer { normal, brdf: Box::new(lobe) }];
        if let Ok(base) = EnergyPreservingOrenNayar::new(surface.diffuse, surface.roughness) {
            layers.push(Layer { normal, brdf: Box::new(base) });
        }
        Appearance { layers, ..Default::default() }
    })
}

/// A metal of this colour and roughness with scratches.
pub fn scratched(
    parameters: ScratchesParameters,
    metres: f32,
    colour: Vec3,
    roughness: f32,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let scratches = Scratches::new(parameters)?;
    // Area of the grooves, from their mean amount: unresolved, they are a rougher metal on that share of the surface.
    let share = (scratches.mean() * (2.0 * 15.0 / 16.0 * 3.0 / 2.0)).clamp(1e-6, 1.0);
    Ok(move |seen: &Seen| {
        let surface = scratches.surface(&in_metres(seen, metres));
        let normal = surface.normal;
        let layer = |variance: f32, part: f32| Layer {
            normal,
            brdf: Box::new(CookTorrance::new(widened(roughness, variance), colour * part)),
        };
        let layers = if surface.slope_variance > 0.0 {
            vec![layer(0.0, 1.0 - share), layer(surface.slope_variance / share, share)]
        } else {
            vec![layer(0.0, 1.0)]
        };
        Appearance { layers, ..Default::default() }
    })
}
