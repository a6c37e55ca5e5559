//! Bump-mapped brick, close by and to the horizon.

use std::f32::consts::PI;

use asperity_render::{
    image::tone::hex, integrator::pixels::Sampling, light::lamps::direction, materials::chalk,
    sampling::sampler::hash,
};
use asperity_shading::bump::{bumped_normal, surface_gradient};
use asperity_shading::{Brick, PixelEllipse};
use glam::{Vec2, Vec3};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let wall = Brick::default();
    let wide = context.sampling([24, 8], 4);
    let scale = 1.1 / wide.width as f32;
    let mut panels = Vec::new();
    let image = context.render(wide, |x, y| {
        shade(&wall, Vec2::new(x, wide.height as f32 - y) * scale + Vec2::new(0.04, 0.02), Vec2::ZERO)
    })?;
    let mut panel = Panel::raster(
        "wall",
        "The wall",
        "A brick wall whose mortar lies deeper than the bricks",
        image.exposed(1.0),
    );
    panel.span = 3;
    panels.push(panel);
    for (stem, label, samples, filtered) in [
        ("plain", "One sample a pixel", 1, false),
        ("filtered", "One filtered sample a pixel", 1, true),
        ("mean", "256 samples a pixel", 256, false),
    ] {
        let sampling = Sampling { samples_per_pixel: samples, ..context.sampling([12, 8], 1) };
        let (half, height) = (0.5 * sampling.width as f32, sampling.height as f32);
        let image = context.render(sampling, |x, y| {
            // One sample is the pixel's middle.
            let (x, y) = if samples == 1 { (x.floor() + 0.5, y.floor() + 0.5) } else { (x, y) };
            let at = |x: f32, y: f32| {
                let distance = 0.35 * height / (y + 0.02 * height).max(0.02);
                Vec2::new((x - half) / (0.8 * height) * distance, distance)
            };
            let (dx, dy) = (at(x + 0.5, y) - at(x - 0.5, y), at(x, y + 0.5) - at(x, y - 0.5));
            let widths = if filtered { dx.abs() + dy.abs() } else { Vec2::ZERO };
            shade(&wall, at(x, y), widths)
        })?;
        let alt = format!("A floor of bricks to the horizon, {}", label.to_lowercase());
        panels.push(Panel::raster(stem, label, &alt, image.exposed(1.0)));
    }
    Ok(Drawn::new(3, panels)
        .fact("depth of the mortar", DEPTH.to_string())
        .fact("facets of a distant pixel", "50"))
}

const DEPTH: f32 = 0.004;

/// The wall under one lamp and a sky, with a colour of its own for every brick that a pixel resolves.
fn shade(wall: &Brick, uv: Vec2, widths: Vec2) -> Vec3 {
    let sun = direction(126.0, 34.0);
    let [column, row] = wall.sample(uv).cell;
    let own = hash(column as u32 ^ hash(row as u32)) as f32 / 4_294_967_296.0 - 0.5;
    // Several bricks in a pixel have their mean colour.
    let resolved = (1.0 - widths.x.max(3.0 * widths.y) / 0.25).clamp(0.0, 1.0);
    let clay = hex(0xa5_4f3c) * (1.0 + 0.5 * own * resolved);
    let mut light = Vec3::ZERO;
    wall.facets(uv, PixelEllipse::aligned(widths), |share, brick, slope| {
        let gradient = surface_gradient(Vec3::Z, [Vec3::X, Vec3::Y], DEPTH * slope);
        let normal = bumped_normal(Vec3::Z, gradient);
        let colour = hex(0xb4_aea4).lerp(clay, brick);
        let facet = chalk(Vec3::Z, normal, colour, 0.3 * colour);
        light += share * (facet.emitted() + 1.35 * PI * facet.scattered(sun, Vec3::Z));
    });
    light
}
