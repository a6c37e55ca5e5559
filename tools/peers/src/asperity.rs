//! Asperity: batches at every SIMD level of this machine, and single calls.

use std::hint::black_box;

use asperity_noise::{
    self as ours, Cellular, Fbm, FbmSpectrum, Field, Normalization, Perlin, Point, Rotation, Simplex,
    ValueNoise,
    glam::{Vec2, Vec3, Vec4},
    simd::{Batch, Level},
};

use crate::{
    inputs::{self, Grid, SEED},
    measure::Contender,
    row::{Kind, Order, Row},
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
    Perlin: Field<V>,
    Simplex: Field<V>,
    Cellular: Field<V>,
    ValueNoise: Field<V>,
{
    match row.kind {
        Kind::Perlin => of::<V, N>(row, step, Perlin::new(SEED)),
        Kind::Simplex => of::<V, N>(row, step, Simplex::new(SEED)),
        Kind::Value => of::<V, N>(row, step, ValueNoise::new(SEED)),
        Kind::Cellular => of::<V, N>(row, step, Cellular::new(SEED)),
        Kind::Fbm => {
            let spectrum = FbmSpectrum::new(2.0, 0.5, 5).expect("five octaves");
            let sum = Fbm::<_, V>::new(Perlin::new(SEED), spectrum);
            of::<V, N>(
                row,
                step,
                sum.with_normalization(Normalization::UnitRange).with_rotation(Rotation::Aligned),
            )
        }
    }
}

/// Returns one contender per level, or one for single calls.
fn of<V, const N: usize>(row: Row, step: f32, field: impl Field<V> + Copy + 'static) -> Vec<Contender>
where
    V: Point<Coordinates = [f32; N]>,
{
    if row.order != Order::Calls {
        return Level::available().map(|level| batch::<V, N>(row, step, level, field)).collect();
    }
    vec![if row.gradients {
        derivatives(NAME, row, step, move |p| {
            let sample = field.sample(V::from_coordinates(p));
            (sample.value, sample.gradient.coordinates())
        })
    } else {
        values(NAME, row, step, move |p| field.value(V::from_coordinates(p)))
    }]
}

fn batch<V, const N: usize>(row: Row, step: f32, level: Level, field: impl Field<V> + 'static) -> Contender
where
    V: Point<Coordinates = [f32; N]>,
{
    let batch = Batch::with_level(level);
    let field = black_box(field);
    let grid = Grid::<N>::new(step);
    let (origin, size) = (V::from_coordinates(grid.origin), grid.size);
    let grid = ours::Grid { origin, step: V::from_axes(|_| grid.step), size: V::array(|axis| size[axis]) };
    let points = inputs::points::<N>();
    let samples = inputs::samples::<N>(row.order);
    let mut values = vec![0.0; samples];
    let mut slopes = V::array(|_| vec![0.0; samples]);
    let pass = Box::new(move || {
        let mut slots = slopes.as_mut().iter_mut();
        let slots = V::array(|_| slots.next().map(Vec::as_mut_slice).unwrap_or_default());
        let points = V::array(|axis| &points[axis][..]);
        let done = match (row.order, row.gradients) {
            (Order::Grid, false) => batch.grid_values(&field, &grid, &mut values),
            (Order::Grid, true) => batch.grid_samples(&field, &grid, &mut values, slots),
            (_, false) => batch.list_values(&field, points, &mut values),
            (_, true) => batch.list_samples(&field, points, &mut values, slots),
        };
        done.expect("every array is as long as the grid or the list of points");
        black_box(&mut values);
    });
    Contender { library: NAME, level: level.name(), samples, pass }
}
