//! Star wallpaper, and images that run.

use asperity_render::{image::tone::hex, integrator::pixels::render, materials::pattern::mix};
use asperity_shading::{Marble, PerturbedTexture, StarWallpaper};
use glam::{Vec2, Vec3};

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure},
        panels::{raster, square},
    },
};

pub(crate) const PATTERNS: Figure = Figure {
    name: "cohen-wallpaper",
    title: "Star wallpaper, and a perturbed texture",
    source: "Cohen, Procedural Bump Mapping and Noise, listings wallpaper and perturb",
    caption: "Stars in 55 of 100 cells, each moved within its cell. Left as the lecture lists it: an angle in turns is taken \
              for radians, so that the notches are shallow, and lattice noise decides, so that chance and places are not \
              even. In the middle, corrected. Right, the same wallpaper with its coordinates moved by noise at every point.",
    draw,
};

fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let wallpaper = StarWallpaper::default();
    let running =
        PerturbedTexture { scale: 9.0, strength: Vec2::splat(0.035), ..PerturbedTexture::default() };
    let sampling = square(context);
    let pixel = 1.0 / sampling.width as f32;
    let (ground, star) = (hex(0x27_3a5c), hex(0xff_b43c));
    let mut panels = Vec::new();
    for (stem, label, alt) in [
        ("listed", "As listed", "Blunt stars, unevenly strewn"),
        ("corrected", "Corrected", "Five-pointed stars, evenly strewn"),
        ("perturbed", "Perturbed", "Five-pointed stars, bent and drawn out"),
    ] {
        let image = render(sampling, context.progress, context.interrupted, |x, y| {
            let uv = Vec2::new(x, sampling.height as f32 - y) * pixel;
            let share = match stem {
                "listed" => f32::from(u8::from(wallpaper.as_listed(uv))),
                "corrected" => wallpaper.coverage(uv, 0.5 * pixel),
                _ => wallpaper.coverage(running.coordinates(Vec3::new(uv.x, uv.y, 0.37), uv), 0.5 * pixel),
            };
            mix(ground, star, share)
        })?;
        panels.push(raster(stem, label, alt, image));
    }
    let share = format!("{:.1} %", 100.0 * wallpaper.mean());
    Ok(Drawn { panels, columns: 3, parameters: vec![("share of stars".to_owned(), share)], table: None })
}

pub(crate) const SPECTRUM: Figure = Figure {
    name: "cohen-marble-colours",
    title: "The colours of blue marble",
    source: "Cohen, Procedural Bump Mapping and Noise, listing blue_marble",
    caption: "Left, the spline through the lecture's thirteen colours, over the sum of noise from \u{2212}3/8 to 1/8. Then a \
              slab of the marble, and the same seen through pixels of 0.1 and of 0.6 of a unit: detail goes, its colour stays.",
    draw: draw_marble,
};

fn draw_marble(context: &Context<'_>) -> Result<Drawn, Failure> {
    use asperity_shading::{Footprint, noise::Perlin2002};
    let sampling = square(context);
    let marble = Marble::default();
    let side = sampling.width as f32;
    let mut panels = Vec::new();
    let image = render(sampling, context.progress, context.interrupted, |_, y| {
        Marble::<Perlin2002>::spline(1.0 - y / side) * 2.2
    })?;
    panels.push(raster("spline", "The spline of colours", "Bands of pale and dark blue", image));
    for (stem, label, width) in [
        ("slab", "A slab, four units wide", 0.0),
        ("pixels-10", "Pixels of 0.1", 0.1),
        ("pixels-60", "Pixels of 0.6", 0.6),
    ] {
        let image = render(sampling, context.progress, context.interrupted, |x, y| {
            let p = Vec3::new(4.0 * x / side, 4.0 * (1.0 - y / side), 0.3);
            2.2 * marble.colour(p, Footprint::from_width(width))
        })?;
        panels.push(raster(stem, label, "Veins of pale and dark blue", image));
    }
    Ok(Drawn {
        panels,
        columns: 4,
        parameters: vec![("colours times".to_owned(), "2.2".to_owned())],
        table: None,
    })
}
