//! Materials without any texture.

use asperity_shading::{CookTorrance, Dielectric, EnergyPreservingOrenNayar, Ggx, Lambert, Schlick};
use glam::Vec3;

use crate::{
    failure::Failure,
    integrator::path_tracer::{Appearance, Behind, Coat, Layer, Seen},
};

/// A matte colour.
pub fn matte(colour: Vec3) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let brdf = Lambert::new(colour)?;
    Ok(move |seen: &Seen| Appearance {
        layers: vec![Layer { normal: seen.point.normal, brdf: Box::new(brdf) }],
        ..Default::default()
    })
}

/// A rough colour.
pub fn cloth(colour: Vec3) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let brdf = EnergyPreservingOrenNayar::new(colour, 0.8)?;
    Ok(move |seen: &Seen| Appearance {
        layers: vec![Layer { normal: seen.point.normal, brdf: Box::new(brdf) }],
        ..Default::default()
    })
}

/// A matte colour, which may differ from point to point, under a glaze of this roughness.
pub fn glazed(
    roughness: f32,
    colour: impl Fn(&Seen) -> Vec3 + Sync,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let glaze = CookTorrance::new(Ggx::new(roughness, roughness)?, Schlick::new(0.04)?);
    Ok(move |seen: &Seen| {
        let normal = seen.point.normal;
        let mut layers = vec![Layer { normal, brdf: Box::new(glaze) }];
        if let Ok(base) = Lambert::new(colour(seen).clamp(Vec3::ZERO, Vec3::splat(0.96))) {
            layers.push(Layer { normal, brdf: Box::new(base) });
        }
        Appearance { layers, ..Default::default() }
    })
}

/// A polished metal.
pub fn chrome(colour: Vec3) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let fresnel = Dielectric::new(1.5)?;
    Ok(move |seen: &Seen| Appearance {
        coat: Some(Coat {
            normal: seen.point.normal,
            slope_variance: 0.0,
            fresnel,
            behind: Behind::Metal(colour),
        }),
        ..Default::default()
    })
}
