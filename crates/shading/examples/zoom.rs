//! Renders a bump-mapped sphere at three distances (1, 1/4, 1/16) to a PNG: `cargo run --example
//! zoom [path]`.

use asperity_shading::environment::low_discrepancy_points;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::{BumpField, BumpMapped, Footprint, Ggx, LevelOfDetail, Material, SurfacePoint};

const SIDE: u32 = 224;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bumps =
        BumpField::new(GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::new(2.17, 0.6, 8)?), 5.0)?;
    let (ndf, color) = (Ggx::new(0.3, 0.3)?, Vec3::new(0.95, 0.64, 0.54));
    let copper = BumpMapped { ndf, bumps, rule: LevelOfDetail::Exact, color };
    // A sky that is bright above and to the left, over a dim ground.
    let sky = |w: Vec3| 0.05 + 0.95 * (0.5 + 0.5 * w.dot(Vec3::new(-0.45, 0.75, 0.48))).powi(10);
    let pixels: Vec<u8> = (0..3 * SIDE * SIDE)
        .flat_map(|k| {
            let (x, y, zoom) = (k % (3 * SIDE) % SIDE, k / (3 * SIDE), 4_u32.pow(k % (3 * SIDE) / SIDE));
            let pixel = 2.2 / (SIDE * zoom) as f32;
            let at = |i: u32| (i as f32 - 0.5 * SIDE as f32) * pixel;
            let (x, y) = (at(x) + 0.2 - 0.2 / zoom as f32, 0.2 - 0.2 / zoom as f32 - at(y));
            let z = (1.0 - x * x - y * y).max(0.0).sqrt();
            let p = Vec3::new(x, y, z);
            let point = SurfacePoint::new(p, p, Footprint::from_distance(1.0, pixel, z));
            let bsdf = copper.bsdf(&point, Vec3::Z);
            let lit = |(uc, u, _): (f32, Vec2, Vec2)| {
                bsdf.sample(Vec3::Z, uc, u).map_or(Vec3::ZERO, |s| sky(s.wi) * s.weight())
            };
            let light: Vec3 = low_discrepancy_points(32).filter(|_| z > 0.0).map(lit).sum::<Vec3>() / 32.0;
            light.to_array().map(|c| (255.0 * c.powf(1.0 / 2.2)) as u8)
        })
        .collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/zoom.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, 3 * SIDE, SIDE);
    png.set_color(png::ColorType::Rgb);
    Ok(png.write_header()?.write_image_data(&pixels)?)
}
