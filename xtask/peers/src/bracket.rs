//! `bracket-noise`: the first FastNoise in Rust, `f32` and permutation tables.

use bracket_noise::prelude::{FastNoise, FractalType, Interp, NoiseType};

use crate::{
    inputs::SEED,
    measure::Contender,
    row::{Kind, Row},
    scalar::values,
};

const NAME: &str = "bracket-noise";

pub(crate) fn contender(row: Row, step: f32) -> Option<Contender> {
    let mut noise = FastNoise::seeded(u64::from(SEED));
    noise.set_frequency(1.0);
    noise.set_interp(Interp::Quintic);
    noise.set_noise_type(match row.kind {
        Kind::Perlin => NoiseType::Perlin,
        Kind::Value => NoiseType::Value,
        Kind::Simplex => NoiseType::Simplex,
        Kind::Octaves => NoiseType::PerlinFractal,
    });
    noise.set_fractal_type(FractalType::FBM);
    noise.set_fractal_octaves(5);
    noise.set_fractal_lacunarity(2.0);
    noise.set_fractal_gain(0.5);
    match row.dimension {
        2 => Some(values(NAME, row.form, step, move |[x, y]: [f32; 2]| noise.get_noise(x, y))),
        3 => Some(values(NAME, row.form, step, move |[x, y, z]: [f32; 3]| noise.get_noise3d(x, y, z))),
        _ => None,
    }
}
