//! `noise`: the oldest of the Rust libraries; `f64` and permutation tables.

use noise::{
    Fbm, MultiFractal, NoiseFn, Perlin, Simplex, Value, core::simplex, permutationtable::PermutationTable,
};

use crate::{
    inputs::SEED,
    measure::Contender,
    row::{Form, Kind, Row},
    scalar::{derivatives, values},
};

const NAME: &str = "noise";

pub(crate) fn contender(row: Row, step: f32) -> Option<Contender> {
    match row.dimension {
        2 => of_dimension::<2>(row, step).or_else(|| simplex_derivatives(row, step)),
        3 => of_dimension::<3>(row, step).or_else(|| simplex_derivatives(row, step)),
        4 => of_dimension::<4>(row, step).or_else(|| simplex_derivatives(row, step)),
        _ => None,
    }
}

fn of_dimension<const N: usize>(row: Row, step: f32) -> Option<Contender>
where
    Perlin: NoiseFn<f64, N>,
    Value: NoiseFn<f64, N>,
    Simplex: NoiseFn<f64, N>,
    Fbm<Perlin>: NoiseFn<f64, N>,
{
    let with_gradient =
        matches!(row.form, Form::GridGradients | Form::PointsGradients | Form::CallsGradients);
    match row.kind {
        Kind::Perlin => Some(of(row, step, Perlin::new(SEED))),
        Kind::Value => Some(of(row, step, Value::new(SEED))),
        // Its simplex noise has a derivative.
        Kind::Simplex if with_gradient => None,
        Kind::Simplex => Some(of(row, step, Simplex::new(SEED))),
        Kind::Octaves => {
            let sum = Fbm::<Perlin>::new(SEED).set_octaves(5).set_lacunarity(2.0).set_persistence(0.5);
            Some(of(row, step, sum))
        }
    }
}

fn of<const N: usize>(row: Row, step: f32, noise: impl NoiseFn<f64, N> + 'static) -> Contender {
    values(NAME, row.form, step, move |p: [f64; N]| noise.get(p) as f32)
}

fn simplex_derivatives(row: Row, step: f32) -> Option<Contender> {
    let table = PermutationTable::new(SEED);
    Some(match row.dimension {
        2 => derivatives(NAME, row.form, step, move |p: [f64; 2]| {
            narrow(simplex::simplex_2d(p.into(), &table))
        }),
        3 => derivatives(NAME, row.form, step, move |p: [f64; 3]| {
            narrow(simplex::simplex_3d(p.into(), &table))
        }),
        4 => derivatives(NAME, row.form, step, move |p: [f64; 4]| {
            narrow(simplex::simplex_4d(p.into(), &table))
        }),
        _ => return None,
    })
}

fn narrow<const N: usize>((value, gradient): (f64, [f64; N])) -> (f32, [f32; N]) {
    (value as f32, gradient.map(|x| x as f32))
}
