//! Writes tiling hills, fBm of a noise of your own, as a PNG lit by their normals:
//! `cargo run --example heightmap [path]`.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, Grid, Rotation, Sample,
    glam::{Vec2, Vec3},
};

/// A noise of your own: a dome of random height in each cell, the same in every eighth cell.
struct Domes(u32);

impl Field<Vec2> for Domes {
    fn sample(&self, p: Vec2) -> Sample<Vec2> {
        let (cell, d) = (p.floor().rem_euclid(Vec2::splat(8.0)), p - p.floor() - 0.5);
        let mut word = (cell.x as u32 | (cell.y as u32) << 3 | self.0 << 6).wrapping_mul(0x9E37_79B9);
        word = (word ^ word >> 15).wrapping_mul(0x85EB_CA77);
        let (height, inside) =
            ((word ^ word >> 13) as f32 / 2_147_483_648.0 - 1.0, 1.0 - 4.0 * d.length_squared());
        if inside <= 0.0 {
            return Sample::default();
        }
        Sample { value: height * inside * inside, gradient: -16.0 * height * inside * d }
    }

    fn range(&self) -> [f32; 2] {
        [-1.0, 1.0]
    }

    // Independent octaves. Without this method all octaves have the same domes.
    fn with_octave_seed(&self, seed: u32) -> Option<Self> {
        Some(Self(seed))
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    const SIDE: usize = 256;
    // An integer lacunarity and parallel octaves keep the period.
    let hills = Fbm::new(Domes(42), FbmSpectrum::new(2.0, 0.35, 5)?).with_rotation(Rotation::Aligned);
    let grid = Grid { origin: Vec2::ZERO, step: Vec2::splat(8.0 / SIDE as f32), size: [SIDE; 2] };
    let [mut heights, mut dx, mut dy] = [(); 3].map(|()| vec![0.0; grid.len()]);
    hills.grid_samples(&grid, &mut heights, [&mut dx, &mut dy])?;

    let sun = Vec3::new(-0.6, -0.4, 0.7).normalize();
    let normals = dx.iter().zip(&dy).map(|(x, y)| Vec3::new(-0.6 * x, -0.6 * y, 1.0).normalize());
    let pixels: Vec<u8> = normals.map(|n| (255.0 * n.dot(sun).max(0.0).powf(1.0 / 2.2)) as u8).collect();
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/heightmap.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, SIDE as u32, SIDE as u32);
    png.set_color(png::ColorType::Grayscale);
    png.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
