//! Writes a bump-mapped sphere, from afar, four and sixteen times nearer, as a PNG: `cargo run --release --example zoom [path]`.

use asperity_shading::environment::low_discrepancy_points;
use asperity_shading::glam::Vec3;
use asperity_shading::noise::{Gaussian, GaussianOctaves, Spectrum};
use asperity_shading::{BumpField, BumpMapped, Footprint, Ggx, LevelOfDetail, Material, SurfacePoint};
use asperity_shading::{Environment, reflected_radiance};

const SIDE: u32 = 224;

/// A wide soft box from the upper left; a pale sky and a darker ground fill the shadows. +z is towards the eye, +y up.
struct Studio;

impl Environment for Studio {
    fn radiance(&self, d: Vec3) -> Vec3 {
        let softbox = (d.dot(Vec3::new(-0.5, 0.65, 0.57)) - 0.55).max(0.0) * Vec3::new(9.0, 8.4, 7.6);
        softbox + Vec3::new(0.1, 0.09, 0.09).lerp(Vec3::new(0.5, 0.56, 0.66), 0.5 + 0.5 * d.y)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bumps = BumpField::new(GaussianOctaves::new(Gaussian::new(1), Spectrum::new(2.17, 0.6, 8)?), 5.0)?;
    let (ndf, colour) = (Ggx::new(0.2, 0.2)?, Vec3::new(0.95, 0.64, 0.54));
    let copper = BumpMapped { ndf, bumps, rule: LevelOfDetail::Exact, colour };
    let pixels: Vec<u8> = (0..3 * SIDE * SIDE)
        .flat_map(|k| {
            let (x, y, zoom) = (k % (3 * SIDE) % SIDE, k / (3 * SIDE), 4_u32.pow(k % (3 * SIDE) / SIDE));
            let pixel = 2.2 / (SIDE * zoom) as f32;
            let at = |i: u32| (i as f32 - 0.5 * SIDE as f32) * pixel;
            let (x, y) = (at(x) - 0.2 + 0.2 / zoom as f32, 0.2 - 0.2 / zoom as f32 - at(y));
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            let p = Vec3::new(x, y, z);
            let point = SurfacePoint::new(p, p, Footprint::from_distance(1.0, pixel, z));
            let frame = point.frame();
            let bsdf = copper.bsdf(&point, frame.to_local(Vec3::Z));
            let seen = || reflected_radiance(&bsdf, &Studio, &frame, Vec3::Z, low_discrepancy_points(32));
            let light = if z > 0.0 { seen() } else { Vec3::splat(0.02) };
            light.to_array().map(|c| (255.0 * (c / (0.8 + c)).powf(1.0 / 2.2)) as u8)
        })
        .collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/zoom.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, 3 * SIDE, SIDE);
    png.set_color(png::ColorType::Rgb);
    Ok(png.write_header()?.write_image_data(&pixels)?)
}
