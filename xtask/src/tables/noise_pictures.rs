//! The small pictures of the noise crate's pages: a PNG for the README, and the same within a line of Markdown for rustdoc.
//!
//! The documentation of a crate can show only what lies in its own text, so the lines hold their PNG as a data URL.

use asperity_noise::{
    Billow, Field, Gaussian, IntegerHash, Noise, Normalisation, Octaves, Perlin1985, Perlin2002, Plasma,
    Power, Ridged, RidgedMultifractal, Simplex, Sparse, Spectrum, Tiled, Turbulence, Value, ValueCatmullRom,
    ValueGradient, Warp, White,
};
use glam::Vec2;
use png::{BitDepth, ColorType, Compression, Encoder};

use crate::failure::Failure;

/// Side in pixels.
const SIDE: u32 = 128;
const SEED: u32 = 1;
const OCTAVES: f32 = 6.0;

/// Every generated file by its name, the same on every platform: values have the same bits, and grey needs no library function.
pub(super) fn noise_pictures() -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let mut files = Files(Vec::new());
    files.kind("white", &White::default(), 1.2)?;
    files.kind("value", &Value::default(), 1.0)?;
    files.kind("value_catmull_rom", &ValueCatmullRom::default(), 0.7)?;
    files.kind("perlin_1985", &Perlin1985::default(), 0.75)?;
    files.kind("perlin_2002", &Perlin2002::default(), 0.75)?;
    files.kind("value_gradient", &ValueGradient::default(), 0.6)?;
    files.kind("simplex", &Simplex::new(0), 1.0)?;
    files.kind("sparse", &Sparse::default(), 2.5)?;
    files.kind("gaussian", &Gaussian::default(), 2.5)?;
    let tiled = Perlin2002::new(SEED).with_lattice(Tiled::new(IntegerHash, [3, 3])?);
    files.add("tiled", [-0.75, 0.75], |p| tiled.value(p * 1.5))?;

    let sum = |spectrum| {
        Octaves::<_, 2>::new(Simplex::new(SEED), spectrum).with_normalisation(Normalisation::Range)
    };
    let (clouds, threads) = (sum(Spectrum::CLOUD).first(OCTAVES), sum(Spectrum::THREADS));
    files.add("octaves", [-0.6, 0.6], |p| clouds.value(p))?;
    files.add("turbulence", [0.0, 0.8], |p| clouds.with_shape(Turbulence).value(p))?;
    files.add("plasma", [0.2, 1.0], |p| clouds.with_shape(Plasma).value(p))?;
    files.add("billow", [-1.0, 0.6], |p| clouds.with_shape(Billow).value(p))?;
    files.add("ridged", [0.0, 1.0], |p| clouds.with_shape(Ridged).value(p))?;
    let threads = threads.with_shape(Plasma);
    files.add("power", [0.0, 0.5], |p| Power(threads, 7).value(p))?;
    let ridges = RidgedMultifractal::<_, 2>::new(Simplex::new(SEED), Spectrum::CLOUD, 2.0)?;
    files.add("ridged_multifractal", [0.0, 1.0], |p| ridges.first(OCTAVES).value(p))?;
    let by = [1, 2].map(|k| {
        Octaves::<_, 2>::new(Simplex::new(SEED + k), Spectrum::CLOUD).with_normalisation(Normalisation::Range)
    });
    let warp = Warp::new(clouds, by.map(|by| by.first(3.0)), 0.45)?;
    files.add("warp", [-0.6, 0.6], |p| warp.value(p))?;
    Ok(files.0)
}

struct Files(Vec<(String, Vec<u8>)>);

impl Files {
    /// A kind of noise over 4 × 4 cells, black and white at ∓`white`.
    fn kind<K: Noise<Vec2> + Copy>(&mut self, stem: &str, noise: &K, white: f32) -> Result<(), Failure> {
        self.add(stem, [-white, white], |p| noise.with_seed(SEED).value(p))
    }

    /// A function over 4 × 4 cells, in grey between what is black and what is white.
    fn add(
        &mut self,
        stem: &str,
        [black, white]: [f32; 2],
        value: impl Fn(Vec2) -> f32,
    ) -> Result<(), Failure> {
        let step = 4.0 / SIDE as f32;
        let mut pixels = Vec::new();
        for y in 0..SIDE {
            for x in 0..SIDE {
                let p = Vec2::new((x as f32 + 0.5) * step, 4.0 - (y as f32 + 0.5) * step);
                let share = (value(p) - black) / (white - black);
                // 64 shades: half the bytes, and no band to be seen.
                pixels.push((share * 63.0 + 0.5).clamp(0.0, 63.0) as u8 * 4);
            }
        }
        let mut png = Vec::new();
        let mut encoder = Encoder::new(&mut png, SIDE, SIDE);
        encoder.set_color(ColorType::Grayscale);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::High);
        encoder.write_header()?.write_image_data(&pixels)?;
        let line = format!("![A square of it, in grey.](data:image/png;base64,{})\n", base64(&png));
        self.0.push((format!("{stem}.png"), png));
        self.0.push((format!("{stem}.md"), line.into_bytes()));
        Ok(())
    }
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for group in bytes.chunks(3) {
        let word =
            group.iter().fold(0_u32, |word, &byte| word << 8 | u32::from(byte)) << (8 * (3 - group.len()));
        for k in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * k) & 63) as usize];
            text.push(if k <= group.len() { letter.into() } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_small_and_not_flat() {
        let files = noise_pictures().unwrap();
        for (name, bytes) in &files {
            assert!(bytes.len() < 16_000, "{name}: {} bytes", bytes.len());
            if name.ends_with(".png") {
                let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
                let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
                reader.next_frame(&mut pixels).unwrap();
                let (low, high) = (pixels.iter().min().unwrap(), pixels.iter().max().unwrap());
                assert!(high - low > 100, "{name}: from {low} to {high}");
            }
        }
    }
}
