//! Writes tiling hills, fBm of a noise of your own, as a PNG lit by their normals:
//! `cargo run --example heightmap [path]`.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, Grid, Rotation, Sample,
    glam::{Vec2, Vec3},
};

/// A field of your own: dunes that repeat every two cells.
struct Dunes;

impl Field<Vec2> for Dunes {
    fn sample(&self, p: Vec2) -> Sample<Vec2> {
        use std::f32::consts::PI;
        let ((sx, cx), (sy, cy)) = ((PI * p.x).sin_cos(), (PI * (p.y + 0.5 * (PI * p.x).cos())).sin_cos());
        let bend = Vec2::new(-0.5 * PI * PI * sx, PI);
        Sample { value: cx * sy, gradient: Vec2::new(-PI * sx * sy, 0.0) + cx * cy * bend }
    }

    fn range(&self) -> [f32; 2] {
        [-1.0, 1.0]
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    const SIDE: usize = 256;
    // An integer lacunarity and parallel octaves keep the period.
    let hills = Fbm::new(Dunes, FbmSpectrum::CLOUD).with_rotation(Rotation::Aligned).with_octaves(6.0);
    let grid = Grid { origin: Vec2::ZERO, step: Vec2::splat(2.0 / SIDE as f32), size: [SIDE; 2] };
    let [mut heights, mut dx, mut dy] = [(); 3].map(|()| vec![0.0; grid.len()]);
    hills.grid_samples(&grid, &mut heights, [&mut dx, &mut dy])?;

    let sun = Vec3::new(-0.6, -0.4, 0.7).normalize();
    let normals = dx.iter().zip(&dy).map(|(x, y)| Vec3::new(-0.2 * x, -0.2 * y, 1.0).normalize());
    let pixels: Vec<u8> = normals.map(|n| (255.0 * n.dot(sun).max(0.0).powf(1.0 / 2.2)) as u8).collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/heightmap.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, SIDE as u32, SIDE as u32);
    png.set_color(png::ColorType::Grayscale);
    png.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
