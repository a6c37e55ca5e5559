//! Writes warped fBm hills, lit by their gradients, as a PNG:
//! `cargo run --example heightmap [path]`.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, Grid, Perlin, ScaleBias, Warp,
    glam::{Vec2, Vec3},
};

const SIDE: usize = 256;

fn hills(seed: u32) -> impl Field<Vec2> {
    let fbm = |k| Fbm::new(Perlin::new(seed + k), FbmSpectrum::default());
    Warp::new(ScaleBias(fbm(0), 0.3, 0.0), [fbm(1), fbm(2)], 0.2).expect("a finite strength")
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let grid = Grid { origin: Vec2::ZERO, step: Vec2::splat(3.0 / SIDE as f32), size: [SIDE; 2] };
    let [mut heights, mut dx, mut dy] = [(); 3].map(|()| vec![0.0; grid.len()]);
    hills(42).grid_samples(&grid, &mut heights, [&mut dx, &mut dy])?;
    let sun = Vec3::new(-0.6, -0.4, 0.7).normalize();
    let light = dx.iter().zip(&dy).map(|(&x, &y)| Vec3::new(-x, -y, 1.0).normalize().dot(sun).max(0.0));
    let pixels: Vec<u8> = light.map(|l| (255.0 * (0.1 + 0.9 * l).powf(1.0 / 2.2)) as u8).collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/heightmap.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, SIDE as u32, SIDE as u32);
    png.set_color(png::ColorType::Grayscale);
    png.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
