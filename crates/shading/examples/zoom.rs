//! Writes a bump-mapped sphere, from afar, four and sixteen times nearer, as a PNG: `cargo run --example zoom [path]`.

use asperity_shading::glam::Vec3;
use asperity_shading::noise::{Gaussian, GaussianOctaves, Spectrum};
use asperity_shading::{BumpField, BumpMapped, Footprint, Ggx, LevelOfDetail, Material, SurfacePoint};

const SIDE: u32 = 256;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bumps = BumpField::new(GaussianOctaves::new(Gaussian::new(1), Spectrum::new(2.17, 0.8, 8)?), 12.0)?;
    let (ndf, colour) = (Ggx::new(0.25, 0.25)?, Vec3::new(0.95, 0.64, 0.54));
    let copper = BumpMapped { ndf, bumps, rule: LevelOfDetail::Exact, colour };
    let lamp = Vec3::new(0.4, 0.5, 0.77).normalize();
    let pixels: Vec<u8> = (0..3 * SIDE * SIDE)
        .flat_map(|k| {
            let (x, y, zoom) = (k % (3 * SIDE) % SIDE, k / (3 * SIDE), 4_u32.pow(k % (3 * SIDE) / SIDE));
            let pixel = 2.2 / (SIDE * zoom) as f32;
            let at = |i: u32| (i as f32 - 0.5 * SIDE as f32) * pixel;
            let (x, y) = (at(x) + 0.2 - 0.2 / zoom as f32, 0.2 - 0.2 / zoom as f32 - at(y));
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            let normal = Vec3::new(x, y, z);
            let point = SurfacePoint::new(normal, normal, Footprint::from_distance(1.0, pixel, z));
            let frame = point.frame();
            let (wi, wo) = (frame.to_local(lamp), frame.to_local(Vec3::Z));
            let light = if z > 0.0 { 3.0 * copper.bsdf(&point, wo).scattered(wi, wo) } else { Vec3::ZERO };
            light.to_array().map(|c| (255.0 * c.clamp(0.0, 1.0).powf(1.0 / 2.2)) as u8)
        })
        .collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/zoom.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, 3 * SIDE, SIDE);
    png.set_color(png::ColorType::Rgb);
    png.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
