//! Two sums of value noise as a normal map with GGX normals: `cargo run --example bump_map
//! [out.png]`.

use std::{array, env, error::Error, fs::File};

use asperity_ndf_sampling::{Ggx, KurtoticDistribution, Ndf, NoiseDistribution, glam::Vec2};

const SIZE: u32 = 256;

/// A number in ±1 for each lattice point.
fn lattice(x: u32, y: u32, seed: u32) -> f32 {
    let hash = (x ^ (seed << 8)).wrapping_mul(0x9E37_79B9) ^ y.wrapping_mul(0x85EB_CA6B);
    let hash = (hash ^ (hash >> 15)).wrapping_mul(0x2C1B_3C6D);
    (hash ^ (hash >> 12)).wrapping_mul(0x297A_2D39) as i32 as f32 / 2_147_483_648.0
}

/// A sum of four octaves.
fn noise(at: Vec2, seed: u32) -> f32 {
    let octave = |k: u32| {
        let (p, mix) = (at * (1 << k) as f32, |a: f32, b: f32, t: f32| a + (b - a) * t * t * (3.0 - 2.0 * t));
        let at = |x: u32, y: u32| lattice(p.x as u32 + x, p.y as u32 + y, seed + k);
        let row = |y| mix(at(0, y), at(1, y), p.x.fract());
        mix(row(0), row(1), p.y.fract()) / (1 << k) as f32
    };
    (0..4).map(octave).sum()
}

fn main() -> Result<(), Box<dyn Error>> {
    let places = (0..SIZE * SIZE).map(|k| Vec2::new((k % SIZE) as f32, (k / SIZE) as f32) / 16.0);
    let values: Vec<[f32; 2]> = places.map(|at| array::from_fn(|i| noise(at, 4 * i as u32))).collect();
    // The noise is not quite Gaussian. Its kurtosis corrects this, so the normals have the exact
    // distribution.
    let [m2, m4] = [2, 4].map(|n| values.iter().map(|r| r[0].powi(n)).sum::<f32>() / values.len() as f32);
    let noise = KurtoticDistribution::new(m2.sqrt(), m4 / (m2 * m2) - 3.0)?;
    let ggx = Ggx::new(0.3, 0.5)?;
    let normals = values.iter().map(|r| ggx.warp_gaussian(Vec2::from(r.map(|r| noise.invert(r)))));
    let rgb = normals.flat_map(|n| (n * 127.5 + 127.5).round().to_array());
    let pixels: Vec<u8> = rgb.map(|c| c as u8).collect();
    let path = env::args().nth(1).unwrap_or("target/bump_map.png".into());
    let mut encoder = png::Encoder::new(File::create(path)?, SIZE, SIZE);
    encoder.set_color(png::ColorType::Rgb);
    Ok(encoder.write_header()?.write_image_data(&pixels)?)
}
