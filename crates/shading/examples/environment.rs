//! Renders a sphere of brushed metal under a sky to a PNG: `cargo run --release --example
//! environment [path]`.

use asperity_shading::environment::low_discrepancy_points;
use asperity_shading::glam::Vec3;
use asperity_shading::{CookTorrance, EnvironmentMap, Footprint, Frame, Ggx, Material, SurfacePoint};
use asperity_shading::{Environment, reflected_radiance};

const SIDE: u32 = 128;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sky = EnvironmentMap::from_fn(128, 64, |d| {
        let sun = (d.dot(Vec3::new(0.5, 0.3, 0.81)) - 0.97).max(0.0) * Vec3::new(1500.0, 1300.0, 1000.0);
        sun + Vec3::new(0.15, 0.13, 0.1).lerp(Vec3::new(0.5, 0.7, 1.0), 0.5 + 0.5 * d.z)
    })?;
    let metal = CookTorrance::new(Ggx::new(0.1, 0.4)?, Vec3::new(0.9, 0.85, 0.7));
    let wo = Vec3::NEG_Y;
    let pixels: Vec<u8> = (0..SIDE * SIDE)
        .flat_map(|k| {
            let at = |i: u32| 2.2 * (i as f32 / SIDE as f32 - 0.5);
            let (x, z) = (at(k % SIDE), -at(k / SIDE));
            let y2 = 1.0 - x * x - z * z;
            let normal = Vec3::new(x, -y2.max(0.0).sqrt(), z);
            let east = Vec3::new(-normal.y, normal.x, 0.0);
            let point = SurfacePoint::new(normal, normal, Footprint::from_width(0.0));
            let frame = Frame::from_normal_tangent(normal, east);
            let bsdf = metal.bsdf(&point, frame.to_local(wo));
            let seen = || reflected_radiance(&bsdf, &sky, &frame, wo, low_discrepancy_points(32));
            let light = if y2 > 0.0 { seen() } else { 0.6 * sky.radiance(Vec3::new(x, 1.0, z)) };
            light.to_array().map(|c| (255.0 * (c / (1.0 + c)).clamp(0.0, 1.0).powf(1.0 / 2.2)) as u8)
        })
        .collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/environment.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, SIDE, SIDE);
    png.set_color(png::ColorType::Rgb);
    png.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
