//! A sphere of brushed metal under a sky, rendered with visible normals: `cargo run --release
//! --example sphere [out.png]`.

use std::{env, error::Error, fs::File};

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{Frame, Ggx, Microfacet, Rotated};

const SIZE: u32 = 256;
const SAMPLES: u32 = 256;

/// Radiance of a sky with a lamp.
fn sky(w: Vec3) -> Vec3 {
    let lamp = 16.0 * (60.0 * (w.dot(Vec3::new(-0.5, 0.62, 0.605)) - 1.0)).exp();
    Vec3::new(0.12, 0.09, 0.07).lerp(Vec3::new(0.4, 0.6, 0.9), (0.5 + 2.0 * w.y).clamp(0.0, 1.0)) + lamp
}

fn main() -> Result<(), Box<dyn Error>> {
    let facets = Rotated::new(Ggx::new(0.08, 0.35)?, 0.6)?;
    let mut pixels = Vec::new();
    for k in 0..SIZE * SIZE {
        let at = (Vec2::new((k % SIZE) as f32, (k / SIZE) as f32) * (2.0 / SIZE as f32) - 1.0) * 1.1;
        let (x, y, z2) = (at.x, -at.y, 1.0 - at.length_squared());
        let mut radiance = sky(Vec3::new(x, y, -2.0).normalize());
        if z2 > 0.0 {
            let frame = Frame::from_normal(Vec3::new(x, y, z2.sqrt()));
            let v = frame.to_local(Vec3::Z);
            // A low-discrepancy sequence (R₂).
            let u = |i: u32| (Vec2::new(0.754_877_7, 0.569_840_3) * i as f32).fract();
            let reflected = |m: Vec3| m * (2.0 * v.dot(m)) - v;
            let samples = (0..SAMPLES).map(|i| reflected(facets.sample_visible(v, u(i))));
            let sum: Vec3 = samples.map(|l| sky(frame.to_world(l)) * facets.g2(v, l) / facets.g1(v)).sum();
            radiance = sum / SAMPLES as f32;
        }
        pixels.extend((radiance / (radiance + 1.0)).to_array().map(|c| (c.sqrt() * 255.0) as u8));
    }
    let path = env::args().nth(1).unwrap_or("target/sphere.png".into());
    let mut encoder = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    encoder.set_color(png::ColorType::Rgb);
    Ok(encoder.write_header()?.write_image_data(&pixels)?)
}
