//! Asperity itself: batches at every SIMD level of this machine, and single calls.

use std::hint::black_box;

use asperity_noise::{
    self as ours, Field, Noise, Normalisation, Octaves, Perlin2002, Point, Rotation, Simplex, Spectrum,
    Value,
    glam::{Vec2, Vec3, Vec4},
    simd::{self, Batch, Kernel},
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
    V: Point<Coordinates = [f32; N]>,
    Perlin2002: Kernel<N> + Noise<V>,
    Simplex: Kernel<N> + Noise<V>,
    Value: Kernel<N> + Noise<V>,
{
    match row.kind {
        Kind::Perlin => of_kind::<V, N>(row, step, Perlin2002::new(SEED)),
        Kind::Simplex => of_kind::<V, N>(row, step, Simplex::new(SEED)),
        Kind::Value => of_kind::<V, N>(row, step, Value::new(SEED)),
        Kind::Octaves => match Spectrum::new(2.0, 0.5, 5) {
            Ok(spectrum) => {
                let sum = Octaves::<_, N>::new(Perlin2002::new(SEED), spectrum);
                let sum = sum.with_normalisation(Normalisation::Range).with_rotation(Rotation::Aligned);
                batches::<V, N>(row.form, step, sum)
            }
            Err(_) => Vec::new(),
        },
    }
}

fn of_kind<V, const N: usize>(row: Row, step: f32, noise: impl Noise<V> + Copy + 'static) -> Vec<Contender>
where
    V: Point<Coordinates = [f32; N]>,
{
    match row.form {
        Form::Calls => {
            let call = move |p| noise.value(V::from_coordinates(p));
            vec![values(NAME, row.form, step, call)]
        }
        Form::CallsGradients => {
            let call = move |p| {
                let sample = noise.sample(V::from_coordinates(p));
                (sample.value, sample.gradient.coordinates())
            };
            vec![derivatives(NAME, row.form, step, call)]
        }
        Form::Grid | Form::GridGradients | Form::Points | Form::PointsGradients => {
            batches::<V, N>(row.form, step, noise)
        }
    }
}

/// One contender per level.
fn batches<V, const N: usize>(form: Form, step: f32, field: impl Field<V> + Copy + 'static) -> Vec<Contender>
where
    V: Point<Coordinates = [f32; N]>,
{
    simd::Level::available()
        .map(|at| {
            let level = if at == simd::Level::Scalar { Level::Scalar } else { Level::Simd(at.name()) };
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
    field: impl Field<V> + 'static,
) -> Box<dyn FnMut()>
where
    V: Point<Coordinates = [f32; N]>,
{
    let field = black_box(field);
    let grid = Grid::<N>::new(step);
    let (origin, size) = (V::from_coordinates(grid.origin), grid.size);
    let grid = ours::Grid { origin, step: V::from_axes(|_| grid.step), size: V::array(|axis| size[axis]) };
    let points = inputs::points::<N>();
    let samples = if matches!(form, Form::Grid | Form::GridGradients) { grid.len() } else { POINTS };
    let mut values = vec![0.0; samples];
    let mut slopes = V::array(|_| vec![0.0; samples]);
    Box::new(move || {
        let mut slots = slopes.as_mut().iter_mut();
        let slots = V::array(|_| slots.next().map(Vec::as_mut_slice).unwrap_or_default());
        let points = V::array(|axis| &points[axis][..]);
        let done = match form {
            Form::Grid => batch.grid_values(&field, &grid, &mut values),
            Form::GridGradients => batch.grid_samples(&field, &grid, &mut values, slots),
            Form::PointsGradients => batch.list_samples(&field, points, &mut values, slots),
            Form::Points | Form::Calls | Form::CallsGradients => {
                batch.list_values(&field, points, &mut values)
            }
        };
        done.expect("every array is as long as the grid or the list of points");
        black_box(&mut values);
    })
}
