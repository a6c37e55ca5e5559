//! `libnoise`: `f64`, permutation tables, adapters.

use libnoise::{Fbm, Generator, ImprovedPerlin, Simplex, Source, Value};

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
    ImprovedPerlin<N>: Generator<N>,
    Value<N>: Generator<N>,
    Simplex<N>: Generator<N>,
    Fbm<N, ImprovedPerlin<N>>: Generator<N>,
{
    let seed = u64::from(SEED);
    match row.kind {
        Kind::Perlin => of(row, step, Source::<N>::improved_perlin(seed)),
        Kind::Value => of(row, step, Source::<N>::value(seed)),
        Kind::Simplex => of(row, step, Source::<N>::simplex(seed)),
        Kind::Octaves => of(row, step, Source::<N>::improved_perlin(seed).fbm(5, 1.0, 2.0, 0.5)),
    }
}

fn of<const N: usize>(row: Row, step: f32, noise: impl Generator<N> + 'static) -> Contender {
    values("libnoise", row.form, step, move |p: [f64; N]| noise.sample(p) as f32)
}
