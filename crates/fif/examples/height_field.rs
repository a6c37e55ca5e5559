//! Ray traces a fractal terrain with sun and shadows to `target/height_field.png` or a given path.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_fif::{Fif, HeightField, Intersect, Interval, Ray, Surface, glam::DVec3};
use std::{env, fs::File, io::BufWriter};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let x: Vec<f64> = (0..=8).map(|k| f64::from(k) / 8.0).collect();
    // Rough slopes, whose integrals are the two curves of the terrain.
    let f = Fif::affine(&x, &[0.9, -0.7, 0.4, -0.9, 1.0, -0.3, 0.6, -0.8, 0.7], &[0.5; 8])?;
    let g = Fif::affine(&x, &[-0.6, 0.8, -0.9, 0.5, -0.2, 0.9, -0.7, 0.6, -0.9], &[-0.55; 8])?;
    let (f, g): (Fif<3>, Fif<3>) = (f.integral(0.3)?, g.integral(0.3)?);
    let terrain = HeightField::new(f, g).tabulated();
    let (eye, sun) = (DVec3::new(-0.45, -0.7, 0.75), DVec3::new(-0.6, 0.3, 0.5).normalize());
    let forward = (DVec3::new(0.5, 0.45, terrain.range().middle()) - eye).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let size = 360_u32;
    let at = |k: u32| (f64::from(k) + 0.5) / f64::from(size) - 0.5;
    let pixel = |k: u32| {
        let direction = forward + right * 0.8 * at(k % size) - right.cross(forward) * 0.8 * at(k / size);
        let all = Interval::new(0.0, f64::INFINITY);
        let Some(hit) = terrain.intersect_within(&Ray { origin: eye, direction }, all, 1e-4) else {
            return [150, 180, 215];
        };
        let normal = hit.normal.unwrap_or(DVec3::Z);
        let above = Ray { origin: DVec3::new(hit.x, hit.y, hit.height + 2e-3), direction: sun };
        let lit = if terrain.occluded(&above, all) { 0.0 } else { normal.dot(sun).max(0.0) };
        DVec3::new(215.0, 195.0, 165.0).to_array().map(|c| (c * (0.2 + 0.8 * lit)) as u8)
    };
    let pixels: Vec<u8> = (0..size * size).flat_map(pixel).collect();
    let path = env::args().nth(1).unwrap_or_else(|| "target/height_field.png".into());
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(&path)?), size, size);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels)?;
    println!("{path}");
    Ok(())
}
