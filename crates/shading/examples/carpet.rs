//! Renders a piece of car carpet under one lamp to a PNG: `cargo run --example carpet [path]`.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{Carpet, CarpetParameters, Footprint, Material, SurfacePoint};

const SIDE: u32 = 512;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let carpet = Carpet::new(CarpetParameters { diffuse: Vec3::new(0.35, 0.2, 0.12), ..Default::default() })?;
    let (wi, wo) = (Vec3::new(0.6, 0.3, 0.74).normalize(), Vec3::Z);
    let metre = 0.12 / SIDE as f32;
    let pixels: Vec<u8> = (0..SIDE * SIDE)
        .flat_map(|k| {
            let uv = Vec2::new((k % SIDE) as f32, (k / SIDE) as f32) * metre;
            let point = SurfacePoint::new(uv.extend(0.0), Vec3::Z, Footprint::from_width(metre))
                .with_uv(uv, [Vec3::X, Vec3::Y]);
            let light = 5.0 * carpet.bsdf(&point, wo).eval_cos(wo, wi);
            light.to_array().map(|c| (255.0 * c.clamp(0.0, 1.0).powf(1.0 / 2.2)) as u8)
        })
        .collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/carpet.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, SIDE, SIDE);
    png.set_color(png::ColorType::Rgb);
    png.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
