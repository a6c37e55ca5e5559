//! `fastnoise-lite`: one configurable generator, `f32`.

use fastnoise_lite::{FastNoiseLite, FractalType, NoiseType};

use crate::{
    inputs::SEED,
    measure::Contender,
    row::{Kind, Row},
    scalar::values,
};

const NAME: &str = "fastnoise-lite";

pub(crate) fn contender(row: Row, step: f32) -> Option<Contender> {
    let mut noise = FastNoiseLite::with_seed(SEED as i32);
    noise.set_frequency(Some(1.0));
    noise.set_noise_type(Some(match row.kind {
        Kind::Perlin | Kind::Octaves => NoiseType::Perlin,
        Kind::Value => NoiseType::Value,
        Kind::Simplex => NoiseType::OpenSimplex2,
    }));
    if row.kind == Kind::Octaves {
        noise.set_fractal_type(Some(FractalType::FBm));
        noise.set_fractal_octaves(Some(5));
        noise.set_fractal_lacunarity(Some(2.0));
        noise.set_fractal_gain(Some(0.5));
    }
    match row.dimension {
        2 => Some(values(NAME, row.form, step, move |[x, y]: [f32; 2]| noise.get_noise_2d(x, y))),
        3 => Some(values(NAME, row.form, step, move |[x, y, z]: [f32; 3]| noise.get_noise_3d(x, y, z))),
        _ => None,
    }
}
