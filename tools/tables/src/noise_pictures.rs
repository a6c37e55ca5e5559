//! The small images of the noise crate's pages: a PNG for the README, and the same PNG in a line of
//! Markdown for rustdoc.
//!
//! A crate's documentation can only display images embedded in its text, so the lines contain the
//! PNG as a data URL.

use asperity_noise::{
    Billow, Cellular, Fbm, FbmSpectrum, Field, GaussianNoise, Normalization, Perlin, PerlinClassic, Plasma,
    Ridged, RidgedMultifractal, Simplex, SparseConvolution, Turbulence, ValueCatmullRom, ValueGradient,
    ValueNoise, Warp, WhiteNoise, ops::Power,
};
use glam::Vec2;
use png::{BitDepth, ColorType, Compression, Encoder};

use asperity_render::failure::Failure;

/// Side in pixels.
const SIDE: u32 = 128;
const SEED: u32 = 1;
const OCTAVES: f32 = 6.0;

/// A file with its name.
type File = (String, Vec<u8>);

/// Returns every generated file, identical on every platform: values have the same bits, and gray
/// needs no library function.
pub(crate) fn noise_pictures() -> Result<Vec<File>, Failure> {
    let tiled = Perlin::new(SEED).tiled([3, 3])?;
    let sum = |spectrum| {
        Fbm::<_, Vec2>::new(Simplex::new(SEED), spectrum).with_normalization(Normalization::UnitRange)
    };
    let (clouds, threads) = (sum(FbmSpectrum::CLOUD).with_octaves(OCTAVES), sum(FbmSpectrum::THREADS));
    let threads = threads.with_shape(Plasma);
    let ridges = RidgedMultifractal::<_, Vec2>::new(Simplex::new(SEED), FbmSpectrum::CLOUD, 2.0)?;
    let by = [1, 2].map(|k| {
        Fbm::<_, Vec2>::new(Simplex::new(SEED + k), FbmSpectrum::CLOUD)
            .with_normalization(Normalization::UnitRange)
    });
    let warp = Warp::new(clouds, by.map(|by| by.with_octaves(3.0)), 0.45)?;
    let pictures = [
        picture("white", [-1.2, 1.2], &|p| WhiteNoise::new(SEED).value(p))?,
        picture("value", [-1.0, 1.0], &|p| ValueNoise::new(SEED).value(p))?,
        picture("value_catmull_rom", [-0.7, 0.7], &|p| ValueCatmullRom::new(SEED).value(p))?,
        picture("perlin_1985", [-0.75, 0.75], &|p| PerlinClassic::new(SEED).value(p))?,
        picture("perlin_2002", [-0.75, 0.75], &|p| Perlin::new(SEED).value(p))?,
        picture("value_gradient", [-0.6, 0.6], &|p| ValueGradient::new(SEED).value(p))?,
        picture("simplex", [-1.0, 1.0], &|p| Simplex::new(SEED).value(p))?,
        picture("sparse", [-2.5, 2.5], &|p| SparseConvolution::new(SEED).value(p))?,
        picture("cellular", [0.0, 1.1], &|p| Cellular::new(SEED).value(p))?,
        picture("gaussian", [-2.5, 2.5], &|p| GaussianNoise::new(SEED).value(p))?,
        picture("tiled", [-0.75, 0.75], &|p| tiled.value(p * 1.5))?,
        picture("octaves", [-0.6, 0.6], &|p| clouds.value(p))?,
        picture("turbulence", [0.0, 0.8], &|p| clouds.with_shape(Turbulence).value(p))?,
        picture("plasma", [0.2, 1.0], &|p| clouds.with_shape(Plasma).value(p))?,
        picture("billow", [-1.0, 0.6], &|p| clouds.with_shape(Billow).value(p))?,
        picture("ridged", [0.0, 1.0], &|p| clouds.with_shape(Ridged).value(p))?,
        picture("power", [0.0, 0.5], &|p| Power(threads, 7).value(p))?,
        picture("ridged_multifractal", [0.0, 1.0], &|p| ridges.with_octaves(OCTAVES).value(p))?,
        picture("warp", [-0.6, 0.6], &|p| warp.value(p))?,
    ];
    Ok(pictures.into_iter().flatten().collect())
}

/// Renders a function over 4 × 4 cells in gray, between the values of black and white.
fn picture(stem: &str, [black, white]: [f32; 2], value: &dyn Fn(Vec2) -> f32) -> Result<[File; 2], Failure> {
    let step = 4.0 / SIDE as f32;
    let mut pixels = Vec::new();
    for y in 0..SIDE {
        for x in 0..SIDE {
            let p = Vec2::new((x as f32 + 0.5) * step, 4.0 - (y as f32 + 0.5) * step);
            let share = (value(p) - black) / (white - black);
            // 64 shades: half the bytes, without visible bands.
            pixels.push((share * 63.0 + 0.5).clamp(0.0, 63.0) as u8 * 4);
        }
    }
    let mut png = Vec::new();
    let mut encoder = Encoder::new(&mut png, SIDE, SIDE);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    encoder.write_header()?.write_image_data(&pixels)?;
    let line = format!("![A square of it, in gray.](data:image/png;base64,{})\n", base64(&png));
    Ok([(format!("{stem}.png"), png), (format!("{stem}.md"), line.into_bytes())])
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
