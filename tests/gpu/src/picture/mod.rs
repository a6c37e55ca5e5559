//! Pictures of bump-mapped surfaces by the shaders and by the crates, beside each other.

pub(crate) mod raster;
pub(crate) mod reference;
pub(crate) mod render;
pub(crate) mod scene;

use std::path::Path;

use asperity_shaders::noise::sums::OctavesUniform;
use asperity_shading::noise::{Gaussian, GaussianOctaves, Spectrum};
use glam::Vec2;

use crate::{device, picture::render::Renderer};

/// What the surface is like.
pub(crate) struct Look {
    pub(crate) alpha: Vec2,
    /// Cells of the first octave per unit.
    pub(crate) frequency: f32,
    /// The greatest share of the bumps' variance that is resolved: the light has a size.
    pub(crate) share: f32,
    pub(crate) exposure: f32,
}

const ZOOMS: [f64; 4] = [1.0, 10.0, 100.0, 10_000.0];

/// Draws the teapot and the plane at four zooms on each adapter and by the crates, and fails where they differ.
pub(crate) fn run(adapter: Option<&str>, size: u32, out: &Path) -> Result<(), String> {
    std::fs::create_dir_all(out).map_err(|error| format!("{}: {error}", out.display()))?;
    let look = Look { alpha: Vec2::new(0.2, 0.4), frequency: 3.0, share: 0.97, exposure: 1.4 };
    let spectrum = Spectrum::new(2.17, 0.8, 16).map_err(|error| error.to_string())?;
    let octaves = GaussianOctaves::new(Gaussian::new(7), spectrum);
    let mut worst = 0.0_f64;
    for gpu in device::open(adapter)? {
        println!(
            "\n{}\n\n| picture | pixels that differ by more than 2 of 255 | largest difference | ms |\n|---|---|---|---|",
            gpu.name
        );
        let renderer = Renderer::new(&gpu, size)?;
        for zoom in ZOOMS {
            let scenes =
                [("teapot", scene::teapot_scene(zoom, size)?), ("plane", scene::plane_scene(zoom, size))];
            for (name, scene) in scenes {
                let at: [f64; 3] = (scene.focus * f64::from(look.frequency)).into();
                let anchored = octaves.anchored(at);
                let (ours, time) =
                    renderer.draw(&gpu, &scene, &look, &spectrum, &OctavesUniform::new(&anchored).words())?;
                let theirs = reference::picture(&scene, &look, anchored, size)?;
                let differences: Vec<u8> =
                    ours.iter().zip(&theirs).map(|(a, b)| difference(*a, *b)).collect();
                let share = differences.iter().filter(|&&d| d > 2).count() as f64 / differences.len() as f64;
                worst = worst.max(share);
                let largest = differences.iter().max().copied().unwrap_or(0);
                println!(
                    "| {name}, zoom {zoom} | {:.3} % | {largest} | {:.0} |",
                    100.0 * share,
                    time.as_secs_f64() * 1e3
                );
                let path = out.join(format!("gpu-{name}-{zoom}.png"));
                png(&path, size, &[&ours, &theirs])?;
            }
        }
    }
    println!("\npictures, by the shader left and by the crates right: {}", out.display());
    if worst <= 1e-3 { Ok(()) } else { Err(format!("{:.2} % of a picture's pixels differ", 100.0 * worst)) }
}

fn difference(a: [u8; 3], b: [u8; 3]) -> u8 {
    a.into_iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

/// Writes pictures beside each other.
fn png(path: &Path, size: u32, pictures: &[&[[u8; 3]]]) -> Result<(), String> {
    let stride = size as usize;
    let rows =
        (0..stride).flat_map(|y| pictures.iter().flat_map(move |picture| &picture[y * stride..][..stride]));
    let bytes: Vec<u8> = rows.flatten().copied().collect();
    let write = || -> Result<(), Box<dyn std::error::Error>> {
        let partial = path.with_extension("png.partial");
        let file = std::io::BufWriter::new(std::fs::File::create(&partial)?);
        let mut encoder = png::Encoder::new(file, size * pictures.len() as u32, size);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.write_header()?.write_image_data(&bytes)?;
        std::fs::rename(&partial, path)?;
        Ok(())
    };
    write().map_err(|error| format!("{}: {error}", path.display()))
}
