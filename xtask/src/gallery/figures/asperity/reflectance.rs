//! The reflectances on spheres.

use asperity_render::{
    geometry::{camera::Camera, shape::Shape},
    image::tone::hex,
    integrator::{direct::sky, pixels::jitter},
    light::{background::background, lamps::studio},
};
use asperity_shading::{
    BlinnPhongFactor, BlinnPhongLobe, Brdf, Conductor, CookTorrance, EnergyPreservingOrenNayar, Frame, Ggx,
    Lambert, OrenNayar, OrenNayarForm, Phong, TorranceSparrow, WardForm, WardReflection,
    ndf_sampling::Isotropic,
};
use glam::{Vec2, Vec3};

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// Reflectances on top of one another.
type Layers = Vec<Box<dyn Brdf + Sync>>;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let clay = hex(0xd9_8a5f);
    let lacquer = |lobe: Box<dyn Brdf + Sync>| -> Result<Layers, Failure> {
        Ok(vec![Box::new(Lambert::new(hex(0x8a_2a2a))?), lobe])
    };
    let gold = [Conductor::new(0.18, 3.42)?, Conductor::new(0.42, 2.35)?, Conductor::new(1.37, 1.77)?];
    let groove: Vec<f32> = (0..64).map(|k| (k as f32 / 63.0).powi(24)).collect();
    let balls: Vec<(&str, &str, Layers)> = vec![
        ("lambert", "Lambert", vec![Box::new(Lambert::new(clay)?)]),
        (
            "oren-nayar",
            "Oren\u{2013}Nayar, full, \u{3c3} = 0.6",
            vec![Box::new(OrenNayar::new(clay, 0.6, OrenNayarForm::Full)?)],
        ),
        ("fujii", "Fujii, \u{3c3} = 1", vec![Box::new(OrenNayar::new(clay, 1.0, OrenNayarForm::Fujii)?)]),
        (
            "preserving",
            "Energy-preserving, r = 1",
            vec![Box::new(EnergyPreservingOrenNayar::new(clay, 1.0)?)],
        ),
        ("phong", "Phong, n = 40", lacquer(Box::new(Phong::new(Vec3::splat(0.25), 40.0)?))?),
        (
            "blinn-phong",
            "Blinn\u{2013}Phong, n = 160",
            lacquer(Box::new(BlinnPhongLobe::new(Vec3::splat(0.25), 160.0, BlinnPhongFactor::Albedo)?))?,
        ),
        (
            "ward",
            "Ward, 0.08 and 0.35",
            vec![Box::new(WardReflection::new(hex(0xb8_bdc4), 0.08, 0.35, WardForm::Bounded)?)],
        ),
        (
            "gold",
            "Cook\u{2013}Torrance, GGX 0.25, gold",
            vec![Box::new(CookTorrance::new(Ggx::isotropic(0.25)?, gold))],
        ),
        (
            "grooves",
            "Torrance\u{2013}Sparrow, a table, gold",
            vec![Box::new(TorranceSparrow::new(Isotropic::new(&groove)?, gold))],
        ),
    ];
    let sampling = context.sampling([8, 8], 1);
    let camera = Camera::new(Vec3::new(0.0, -6.0, 1.6), Vec3::ZERO, 0.4, sampling.width, sampling.height);
    let lights = studio(Vec3::splat(2.6));
    let (width, height) = (sampling.width as f32, sampling.height as f32);
    let mut panels = Vec::new();
    for (stem, label, layers) in balls {
        let image = context.render(sampling, |x, y| {
            let direction = camera.direction(x, y);
            let Some(hit) = Shape::Sphere.first_hit(camera.eye(), direction) else {
                return background(x / width, y / height);
            };
            let frame = Frame::from_normal_tangent(hit.normal, hit.tangent);
            let wo = frame.to_local(-direction);
            layers.iter().fold(Vec3::ZERO, |mut sum, brdf| {
                for light in &lights {
                    let wi = frame.to_local(light.direction);
                    sum += light.colour * brdf.value(wi, wo) * wi.z.max(0.0);
                }
                sum + room(
                    brdf.as_ref(),
                    &frame,
                    wo,
                    jitter((x * 61.0) as u32, (y * 61.0) as u32, context.seed),
                )
            })
        })?;
        let alt = format!("A sphere under three lamps: {label}");
        panels.push(Panel::raster(stem, label, &alt, image.exposed(1.0)));
    }
    Ok(Drawn::new(3, panels).fact("samples per pixel", sampling.samples_per_pixel.to_string()))
}

/// Light of the room, by a few samples of the surface's own.
fn room(brdf: &dyn Brdf, frame: &Frame, wo: Vec3, shift: Vec2) -> Vec3 {
    const COUNT: u32 = 6;
    (0..COUNT).fold(Vec3::ZERO, |sum, k| {
        let u = Vec2::new((k as f32 + shift.x) / COUNT as f32, (0.618_034 * k as f32 + shift.y).fract());
        let wi = brdf.sample(wo, u);
        let density = brdf.density(wi, wo);
        if density > 0.0 {
            sum + brdf.value(wi, wo) * (wi.z / density) * sky(frame.to_world(wi)) * (0.45 / COUNT as f32)
        } else {
            sum
        }
    })
}
