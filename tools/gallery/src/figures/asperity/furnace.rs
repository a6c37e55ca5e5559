//! Microfacet models in uniform light and in a studio, without and with the light of further
//! bounces.

use asperity_render::geometry::{camera::Camera, shape::Shape};
use asperity_render::light::environments::Studio;
use asperity_render::materials::Layers;
use asperity_render::sampling::sampler::Sampler;
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_shading::reflectance::{EnergyCompensated, RoughDielectric};
use asperity_shading::{Brdf, Conductor, CookTorrance, Dielectric, Ggx};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel};
use asperity::failure::Result;
use asperity::quality::EXPOSURE;

const ALPHAS: [f32; 4] = [0.1, 0.4, 0.7, 1.0];
/// Radiance of the uniform light, middle gray on the page.
const LIGHT: f32 = 0.4;
/// Longest path in a sphere of glass.
const BOUNCES: usize = 256;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let gold = [Conductor::new(0.18, 3.42)?, Conductor::new(0.42, 2.35)?, Conductor::new(1.37, 1.77)?];
    let glass = Dielectric::new(1.5)?;
    let (sampling, studio) = (context.sampling([6, 6], 1), Studio::new(1.0));
    let camera = Camera::new(Vec3::new(0.0, -6.0, 1.6), Vec3::ZERO, 0.4, sampling.width, sampling.height);
    let (mut panels, mut grains) = (Vec::new(), Vec::new());
    for [stem, name] in [["metal", "White metal"], ["glass", "Glass"], ["gold", "Gold"]] {
        for [suffix, bounces] in [["one", "one bounce"], ["every", "every bounce"]] {
            for alpha in ALPHAS {
                let ggx = Ggx::isotropic(alpha)?;
                let brdf: Box<dyn Brdf + Sync> = match (stem, suffix) {
                    ("metal", "one") => Box::new(CookTorrance::new(ggx, Vec3::ONE)),
                    ("metal", _) => Box::new(EnergyCompensated::metal(ggx, Vec3::ONE)),
                    ("glass", "one") => Box::new(RoughDielectric::new(ggx, glass)),
                    ("glass", _) => Box::new(EnergyCompensated::glass(ggx, glass)),
                    (_, "one") => Box::new(CookTorrance::new(ggx, gold)),
                    _ => Box::new(EnergyCompensated::metal(ggx, gold)),
                };
                let (place, (image, grain)) = if stem == "gold" {
                    let ball = Object::new(Shape::Sphere, Layers(vec![brdf]));
                    let scene = Scene::new(vec![ball], Light::Around(&studio), Backdrop::Studio);
                    let (image, grain) = context.still(&scene, sampling, &camera)?;
                    ("a studio", (image.filmic(EXPOSURE), grain))
                } else {
                    let side = sampling.width as f32;
                    let seen = context.still_of(sampling, |x, y, sampler| {
                        let place = (Vec2::new(x, y) / side - 0.5) * 2.5;
                        let z = 1.0 - place.length_squared();
                        let wo = Vec3::new((1.0 - z).sqrt(), 0.0, z.max(0.0).sqrt());
                        LIGHT * if z > 0.0 { returned(&*brdf, wo, sampler) } else { Vec3::ONE }
                    })?;
                    ("uniform light", seen)
                };
                grains.push(grain);
                let label = format!("{name}, {bounces}, α = {alpha}");
                let alt = format!("A sphere in {place}: {label}");
                panels.push(Panel::new(format!("{stem}-{suffix}-{alpha}"), label, alt, image));
            }
        }
    }
    Ok(Drawn::new(4, panels).grain(&grains))
}

/// One sample of the fraction of uniform light that a sphere sends to `wo`.
fn returned(brdf: &dyn Brdf, mut wo: Vec3, sampler: &mut Sampler) -> Vec3 {
    let mut weight = Vec3::ONE;
    for _ in 0..BOUNCES {
        let Some(sample) = brdf.sample(wo, sampler.point().x, sampler.point()) else { return Vec3::ZERO };
        weight *= sample.weight();
        if sample.wi.z > 0.0 {
            return weight;
        }
        // A chord meets the sphere at both ends under the same angle.
        wo = sample.wi;
    }
    Vec3::ZERO
}
