//! The marble vase and the steaming tea cup.

use asperity_render::geometry::camera::Camera;
use asperity_render::geometry::revolution::{revolved, ring};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::scenes::{PLAIN, Set, backdrop, ground};
use asperity_render::{image::tone::hex, light::environments::Studio, materials::glazed};
use asperity_shading::noise::{Fbm, FbmSpectrum, Normalization, Perlin, Turbulence};
use asperity_shading::texture::{Gas, Steam, march};
use asperity_shading::{Marble, material::PolishedMarble};
use glam::Vec3;

use crate::figure::{Context, Drawn};
use asperity::failure::Result;
use asperity::quality::EXPOSURE;

const CUP_PROFILE: [[f32; 2]; 11] = [
    [0.0, 0.05],
    [0.42, 0.05],
    [0.44, 0.12],
    [0.66, 0.3],
    [0.84, 0.66],
    [0.92, 1.0],
    [0.895, 1.015],
    [0.87, 0.99],
    [0.80, 0.66],
    [0.60, 0.32],
    [0.0, 0.2],
];

const SAUCER_PROFILE: [[f32; 2]; 7] =
    [[0.0, 0.02], [0.7, 0.02], [1.2, 0.12], [1.36, 0.2], [1.34, 0.22], [0.7, 0.07], [0.0, 0.05]];

const TEA: f32 = 0.84;

/// Length of a step through the steam.
const STEP: f32 = 0.06;

pub(crate) fn draw_vase(context: &Context<'_>) -> Result<Drawn> {
    let sampling = context.sampling([18, 18], 1);
    let studio = Studio::new(1.0);
    let marble = PolishedMarble { marble: Marble::default(), tint: Vec3::splat(2.6), polish: 0.12 };
    let objects = Set::Vase.objects(Box::new(marble), PLAIN)?;
    let scene = Scene::new(objects, Light::Around(&studio), Backdrop::Color(backdrop()));
    let alt = "A tall vase with blue veins on a table";
    let views = [
        (["vase", "The vase", alt], [Vec3::new(0.0, -7.2, 2.6), Vec3::new(0.0, 0.0, 1.12)]),
        (["neck", "Its neck, close up", alt], [Vec3::new(0.7, -2.6, 3.1), Vec3::new(0.0, 0.0, 1.95)]),
    ];
    let mut grains = Vec::new();
    let drawn = Drawn::pictures(2, views, |[eye, target]| {
        let camera = Camera::new(eye, target, 0.44, sampling.width, sampling.height);
        let (image, grain) = context.still(&scene, sampling, &camera)?;
        grains.push(grain);
        Ok(image.filmic(EXPOSURE))
    })?;
    Ok(drawn.fact("cells of the first octave per unit", "2.5").grain(&grains))
}

pub(crate) fn draw_cup(context: &Context<'_>) -> Result<Drawn> {
    let sampling = context.sampling([16, 16], 1);
    let (eye, target) = (Vec3::new(1.2, -6.6, 3.0), Vec3::new(0.1, 0.0, 1.15));
    let camera = Camera::new(eye, target, 0.56, sampling.width, sampling.height);
    let studio = Studio::new(1.0);
    let china = || glazed(0.1, hex(0xf0_ede6));
    let tea = revolved(&[[0.85, TEA], [0.4, TEA], [0.0, TEA]]);
    let objects = vec![
        Object::new(revolved(&CUP_PROFILE), china()),
        Object::new(ring(Vec3::new(1.0, 0.0, 0.58), 0.26, 0.065), china()),
        Object::new(revolved(&SAUCER_PROFILE), china()),
        Object::new(tea, glazed(0.05, hex(0x7a_2f10))),
        ground(0.0, PLAIN)?,
    ];
    let scene = Scene::new(objects, Light::Around(&studio), Backdrop::Color(backdrop()));
    let steam = Steam::new(Vec3::new(0.0, 0.0, TEA), 0.8, 1.9)?;
    let octaves =
        Fbm::new(Perlin::new(3), FbmSpectrum::default()).with_normalization(Normalization::UnitRange);
    let alt = "A white tea cup on its saucer, with steam over it";
    let pictures = [(2.0, 5.2), (4.0, 4.2), (8.0, 3.7)].map(|(exponent, densest)| {
        let words = [format!("exponent-{exponent}"), format!("Exponent {exponent}"), alt.to_owned()];
        (words, Gas::new(octaves.with_shape(Turbulence).with_octaves(5.0), densest, exponent))
    });
    let mut grains = Vec::new();
    let drawn = Drawn::pictures(3, pictures, |gas| {
        let gas = gas?;
        let extinction = |p: Vec3| {
            let share = steam.share(p);
            if share <= 0.0 {
                return 0.0;
            }
            // Steam rises in streaks: the noise is stretched vertically.
            3.2 * share * share * gas.density(p * Vec3::new(1.5, 1.5, 0.8)).min(3.0)
        };
        let (image, grain) = context.still_of(sampling, |x, y, sampler| {
            let ray = camera.ray(x, y);
            let behind = scene.seen(&ray, [0.0; 2], sampler);
            let [near, far] = steam.interval(ray.origin, ray.direction);
            // One extra step at both ends, without effect.
            let range = [(near - STEP).max(3.0), (far + STEP).min(behind.distance.min(10.0))];
            let seen = march(ray.origin, ray.direction, range, STEP, sampler.point().x, extinction, |_| {
                Vec3::new(0.78, 0.8, 0.82)
            });
            seen.light + seen.transmittance * behind.radiance
        })?;
        grains.push(grain);
        Ok(image.filmic(EXPOSURE))
    })?;
    Ok(drawn.grain(&grains).fact("steps", STEP).fact("height of the steam", "1.9"))
}
