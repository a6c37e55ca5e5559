//! Tempered glass, as a pane and as a body.

use asperity_shading::{Dielectric, TemperedGlass, TemperedGlassParameters};
use glam::Vec3;

use crate::materials::in_metres;
use crate::{
    failure::Failure,
    integrator::path_tracer::{Appearance, Behind, Coat, Seen},
};

/// A thin pane with waves in what it mirrors; what is behind it is seen straight, tinted.
pub fn pane(
    parameters: TemperedGlassParameters,
    metres: f32,
    tint: Vec3,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    wavy(parameters, metres, Behind::Pane(tint))
}

/// A body of glass with waves in its surface, tinted over a unit of length.
pub fn glass(
    parameters: TemperedGlassParameters,
    metres: f32,
    tint: Vec3,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    wavy(parameters, metres, Behind::Body(tint))
}

fn wavy(
    parameters: TemperedGlassParameters,
    metres: f32,
    behind: Behind,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let glass = TemperedGlass::new(parameters)?;
    let fresnel = Dielectric::new(1.52)?;
    Ok(move |seen: &Seen| {
        let surface = glass.surface(&in_metres(seen, metres));
        Appearance {
            coat: Some(Coat {
                normal: surface.normal,
                slope_variance: surface.slope_variance,
                fresnel,
                behind,
            }),
            ..Default::default()
        }
    })
}
