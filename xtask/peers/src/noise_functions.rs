//! `noise-functions`: `f32`, hashes and small tables, no state.

use noise_functions::{Noise, Perlin, Sample, Simplex, Value};

use crate::{
    inputs::SEED,
    measure::Contender,
    row::{Kind, Row},
    scalar::values,
};

pub(crate) fn contender(row: Row, step: f32) -> Option<Contender> {
    match row.dimension {
        2 => Some(of_dimension::<2>(row, step)),
        3 => Some(of_dimension::<3>(row, step)),
        4 => Some(of_dimension::<4>(row, step)),
        _ => None,
    }
}

fn of_dimension<const N: usize>(row: Row, step: f32) -> Contender
where
    Perlin: Sample<N>,
    Value: Sample<N>,
    Simplex: Sample<N>,
{
    match row.kind {
        Kind::Perlin => of(row, step, Perlin),
        Kind::Value => of(row, step, Value),
        Kind::Simplex => of(row, step, Simplex),
        Kind::Octaves => of(row, step, Perlin.fbm(5, 0.5, 2.0)),
    }
}

fn of<const N: usize>(row: Row, step: f32, noise: impl Sample<N> + 'static) -> Contender {
    values("noise-functions", row.form, step, move |p: [f32; N]| noise.sample_with_seed(p, SEED as i32))
}
