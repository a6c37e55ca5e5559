//! Star wallpaper, and images that run.

use asperity_render::image::tone::hex;
use asperity_shading::texture::{PerturbedTexture, StarWallpaper};
use asperity_shading::{Footprint, Marble};
use glam::{Vec2, Vec3};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let wallpaper = StarWallpaper::default();
    let running =
        PerturbedTexture { scale: 9.0, strength: Vec2::splat(0.035), ..PerturbedTexture::default() };
    let sampling = context.square();
    let pixel = 1.0 / sampling.width as f32;
    let half = Footprint::from_width(0.5 * pixel);
    let (ground, star) = (hex(0x27_3a5c), hex(0xff_b43c));
    let mut panels = Vec::new();
    for (stem, label, alt) in [
        ("listed", "As listed", "Blunt stars, unevenly strewn"),
        ("corrected", "Corrected", "Five-pointed stars, evenly strewn"),
        ("perturbed", "Perturbed", "Five-pointed stars, bent and drawn out"),
    ] {
        let image = context.render(sampling, |x, y| {
            let uv = Vec2::new(x, sampling.height as f32 - y) * pixel;
            let share = match stem {
                "listed" => f32::from(u8::from(wallpaper.as_listed(uv))),
                "corrected" => wallpaper.coverage(uv, half),
                _ => wallpaper.coverage(running.coordinates(Vec3::new(uv.x, uv.y, 0.37), uv), half),
            };
            ground.lerp(star, share)
        })?;
        panels.push(Panel::raster(stem, label, alt, image));
    }
    let share = format!("{:.1} %", 100.0 * wallpaper.mean());
    Ok(Drawn::new(3, panels).fact("share of stars", share))
}

pub(crate) fn draw_marble(context: &Context<'_>) -> Result<Drawn, Failure> {
    use asperity_shading::{Footprint, noise::Perlin2002};
    let sampling = context.square();
    let marble = Marble::default();
    let side = sampling.width as f32;
    let mut panels = Vec::new();
    let image = context.render(sampling, |_, y| Marble::<Perlin2002>::spline(1.0 - y / side) * 2.2)?;
    panels.push(Panel::raster("spline", "The spline of colours", "Bands of pale and dark blue", image));
    for (stem, label, width) in [
        ("slab", "A slab, four units wide", 0.0),
        ("pixels-10", "Pixels of 0.1", 0.1),
        ("pixels-60", "Pixels of 0.6", 0.6),
    ] {
        let image = context.render(sampling, |x, y| {
            let p = Vec3::new(4.0 * x / side, 4.0 * (1.0 - y / side), 0.3);
            2.2 * marble.colour(p, Footprint::from_width(width))
        })?;
        panels.push(Panel::raster(stem, label, "Veins of pale and dark blue", image));
    }
    Ok(Drawn::new(4, panels).fact("colours times", "2.2"))
}
