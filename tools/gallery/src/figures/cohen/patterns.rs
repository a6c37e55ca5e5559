//! Star wallpaper, and images with drips.

use asperity_render::image::tone::hex;
use asperity_shading::texture::{PerturbedTexture, StarWallpaper};
use asperity_shading::{Footprint, Marble, noise::Perlin};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Shown};
use asperity::failure::Result;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let wallpaper = StarWallpaper::default();
    let running =
        PerturbedTexture { scale: 9.0, strength: Vec2::splat(0.035), ..PerturbedTexture::default() };
    let sampling = context.square();
    let pixel = 1.0 / sampling.width as f32;
    let half = Footprint::from_width(0.5 * pixel);
    let (ground, star) = (hex(0x27_3a5c), hex(0xff_b43c));
    let stars: [([&str; 3], Shown<'_, Vec2, f32>); 3] = [
        (["listed", "As listed", "Blunt stars, unevenly strewn"], &|uv| {
            f32::from(u8::from(wallpaper.as_listed(uv)))
        }),
        (["corrected", "Corrected", "Five-pointed stars, evenly strewn"], &|uv| wallpaper.coverage(uv, half)),
        (["perturbed", "Perturbed", "Five-pointed stars, bent and drawn out"], &|uv| {
            wallpaper.coverage(running.coordinates(Vec3::new(uv.x, uv.y, 0.37), uv), half)
        }),
    ];
    let drawn = Drawn::pictures(3, stars, |share| {
        context.render(sampling, |x, y| {
            ground.lerp(star, share(Vec2::new(x, sampling.height as f32 - y) * pixel))
        })
    })?;
    Ok(drawn.fact("coverage of stars", format!("{:.1} %", 100.0 * wallpaper.mean())))
}

pub(crate) fn draw_marble(context: &Context<'_>) -> Result<Drawn> {
    let sampling = context.square();
    let marble = Marble::default();
    let side = sampling.width as f32;
    let slab = |p: Vec2, width| {
        let place = Vec3::new(4.0 * p.x / side, 4.0 * (1.0 - p.y / side), 0.3);
        marble.color(place, Footprint::from_width(width))
    };
    let (bands, veins) = ("Bands of pale and dark blue", "Veins of pale and dark blue");
    let colors: [([&str; 3], Shown<'_, Vec2, Vec3>); 4] = [
        (["spline", "The color spline", bands], &|p| Marble::<Perlin>::spline(1.0 - p.y / side)),
        (["slab", "A slab of width four", veins], &|p| slab(p, 0.0)),
        (["pixels-10", "Pixels of 0.1", veins], &|p| slab(p, 0.1)),
        (["pixels-60", "Pixels of 0.6", veins], &|p| slab(p, 0.6)),
    ];
    let drawn =
        Drawn::pictures(4, colors, |color| context.render(sampling, |x, y| color(Vec2::new(x, y)) * 2.2))?;
    Ok(drawn.fact("color scale", "2.2"))
}
