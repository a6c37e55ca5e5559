//! Asperity itself: batches at every SIMD level of this machine, and single calls.

use std::{array, hint::black_box};

use asperity_noise::{
    self as ours, Batch, Field, Kernel, Noise, Normalisation, Octaves, Perlin2002, Point, Rotation, Seeded,
    Simplex, Spectrum, Value,
    glam::{Vec2, Vec3, Vec4},
};

use crate::{
    inputs::{self, Grid, POINTS, SEED},
    level::Level,
    measure::Contender,
    row::{Form, Kind, Row},
    scalar::{derivatives, values},
};

/// Name in the table.
const NAME: &str = "asperity";

pub(crate) fn contenders(row: Row, step: f32) -> Vec<Contender> {
    match row.dimension {
        2 => of_dimension::<Vec2, 2>(row, step),
        3 => of_dimension::<Vec3, 3>(row, step),
        4 => of_dimension::<Vec4, 4>(row, step),
        _ => Vec::new(),
    }
}

fn of_dimension<V, const N: usize>(row: Row, step: f32) -> Vec<Contender>
where
    V: Point<N> + 'static,
    Perlin2002: Kernel<N> + Noise<V>,
    Simplex: Kernel<N> + Noise<V>,
    Value: Kernel<N> + Noise<V>,
{
    match row.kind {
        Kind::Perlin => of_kind::<V, N>(row, step, Perlin2002::default()),
        Kind::Simplex => of_kind::<V, N>(row, step, Simplex::CONTINUOUS),
        Kind::Value => of_kind::<V, N>(row, step, Value::default()),
        Kind::Octaves => match Spectrum::new(2.0, 0.5, 5) {
            Ok(spectrum) => {
                let sum = Octaves::<_, N>::new(Perlin2002::default(), spectrum, Normalisation::Range, SEED);
                // A field of octaves borrows its sum; this one lives as long as the program.
                let sum = Box::leak(Box::new(sum.with_rotation(Rotation::Aligned)));
                batches::<V, N>(row.form, step, sum.first(5.0))
            }
            Err(_) => Vec::new(),
        },
    }
}

fn of_kind<V, const N: usize>(
    row: Row,
    step: f32,
    noise: impl Kernel<N> + Noise<V> + Copy + 'static,
) -> Vec<Contender>
where
    V: Point<N> + 'static,
{
    match row.form {
        Form::Calls => {
            let call = move |p| noise.value(V::from_coordinates(p), SEED);
            vec![values(NAME, row.form, step, call)]
        }
        Form::CallsGradients => {
            let call = move |p| {
                let sample = noise.sample(V::from_coordinates(p), SEED);
                (sample.value, sample.gradient.coordinates())
            };
            vec![derivatives(NAME, row.form, step, call)]
        }
        Form::Grid | Form::GridGradients | Form::Points | Form::PointsGradients => {
            batches::<V, N>(row.form, step, Seeded(noise, SEED))
        }
    }
}

/// One contender per level.
fn batches<V, const N: usize>(form: Form, step: f32, field: impl Field<N> + Copy + 'static) -> Vec<Contender>
where
    V: Point<N> + 'static,
{
    ours::Level::available()
        .map(|at| {
            let level = if at == ours::Level::Scalar { Level::Scalar } else { Level::Simd(at.name()) };
            let samples = match form {
                Form::Grid | Form::GridGradients => Grid::<N>::new(step).samples(),
                _ => POINTS,
            };
            Contender {
                library: NAME,
                level,
                samples,
                pass: pass::<V, N>(form, step, Batch::with_level(at), field),
            }
        })
        .collect()
}

fn pass<V, const N: usize>(
    form: Form,
    step: f32,
    batch: Batch,
    field: impl Field<N> + 'static,
) -> Box<dyn FnMut()>
where
    V: Point<N> + 'static,
{
    let field = black_box(field);
    let grid = Grid::<N>::new(step);
    let (origin, size) = (V::from_coordinates(grid.origin), grid.size);
    let grid = ours::Grid { origin, step: V::from_coordinates([grid.step; N]), size };
    let points = inputs::points::<N>();
    let samples = if matches!(form, Form::Grid | Form::GridGradients) { grid.len() } else { POINTS };
    let mut values = vec![0.0; samples];
    let mut slopes: [Vec<f32>; N] = array::from_fn(|_| vec![0.0; samples]);
    Box::new(move || {
        let slots = slopes.each_mut().map(Vec::as_mut_slice);
        let points = points.each_ref().map(Vec::as_slice);
        let done = match form {
            Form::Grid => batch.fill_grid(&field, &grid, &mut values),
            Form::GridGradients => batch.fill_grid_with_gradients(&field, &grid, &mut values, slots),
            Form::PointsGradients => batch.fill_points_with_gradients(&field, points, &mut values, slots),
            Form::Points | Form::Calls | Form::CallsGradients => {
                batch.fill_points(&field, points, &mut values)
            }
        };
        done.expect("every array is as long as the grid or the list of points");
        black_box((&mut values, &mut slopes));
    })
}
