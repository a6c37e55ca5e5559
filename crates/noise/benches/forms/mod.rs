//! Every form that a kind of noise is evaluated in, in 1-D to 4-D: calls, rows, grids and lists of points.
//!
//! Names are those of the functions, the dimension and the kind: `fill_grid_with_gradients/3-d/perlin-2002`.

use std::{hint::black_box, time::Duration};

use asperity_noise::{
    Batch, Field, Grid, Kernel, Noise, Point, Seeded,
    glam::{Vec2, Vec3, Vec4},
};
use criterion::{BenchmarkGroup, Criterion, Throughput, measurement::WallTime};

const SEED: u32 = 7;
/// Distance of neighbours on a grid, in lattice cells.
const STEP: f32 = 0.05;
/// Points of a row, a grid or a list.
const POINTS: usize = 4096;

/// What writes values, and gradients if it has any.
type Fill<'a, const N: usize> = &'a mut dyn FnMut(&mut [f32], [&mut [f32]; N]);

/// A short run of each bench: there are hundreds.
pub(crate) fn configuration() -> Criterion {
    Criterion::default().warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(800))
}

/// Benches a kind in every form and dimension.
pub(crate) fn every_form<K>(criterion: &mut Criterion, name: &str, noise: K)
where
    K: Kernel<1> + Kernel<2> + Kernel<3> + Kernel<4> + Copy,
{
    of_dimension::<f32, K, 1>(criterion, name, noise, [POINTS]);
    of_dimension::<Vec2, K, 2>(criterion, name, noise, [64; 2]);
    of_dimension::<Vec3, K, 3>(criterion, name, noise, [16; 3]);
    of_dimension::<Vec4, K, 4>(criterion, name, noise, [8; 4]);
}

/// Benches a kind in every form in one dimension.
pub(crate) fn of_dimension<V: Point<N>, K: Kernel<N> + Noise<V> + Copy, const N: usize>(
    criterion: &mut Criterion,
    name: &str,
    noise: K,
    size: [usize; N],
) {
    let points = scattered::<N>();
    let at = |i: usize| V::from_coordinates(points.each_ref().map(|coordinates| coordinates[i]));
    calls(criterion, "value", N, name, |i| noise.value(at(i), SEED));
    calls(criterion, "sample", N, name, |i| noise.sample(at(i), SEED));
    batches::<V, _, N>(criterion, name, &Seeded(noise, SEED), size);
}

/// Benches the rows, grids and lists of points of a field.
pub(crate) fn batches<V: Point<N>, F: Field<N>, const N: usize>(
    criterion: &mut Criterion,
    name: &str,
    field: &F,
    size: [usize; N],
) {
    let points = scattered::<N>();
    let points = points.each_ref().map(Vec::as_slice);
    let origin = V::from_coordinates([-3.7; N]);
    let grid = Grid { origin, step: V::from_coordinates([STEP; N]), size };
    let (batch, mut values) = (Batch::new(), vec![0.0; POINTS]);
    let mut gradients = [(); N].map(|()| vec![0.0; POINTS]);
    let mut bench = |form: &str, run: Fill<'_, N>| {
        group(criterion, form, N, POINTS).bench_function(name, |bencher| {
            bencher.iter(|| {
                run(black_box(&mut values), gradients.each_mut().map(Vec::as_mut_slice));
            });
        });
    };
    bench("fill_row", &mut |values, _| batch.fill_row(field, origin, STEP, values));
    bench("fill_grid", &mut |values, _| batch.fill_grid(field, &grid, values).expect("one number per point"));
    bench("fill_grid_with_gradients", &mut |values, gradients| {
        batch.fill_grid_with_gradients(field, &grid, values, gradients).expect("one number per point");
    });
    bench("fill_points", &mut |values, _| {
        batch.fill_points(field, points, values).expect("one number per point");
    });
    bench("fill_points_with_gradients", &mut |values, gradients| {
        batch.fill_points_with_gradients(field, points, values, gradients).expect("one number per point");
    });
}

/// Benches calls at random points; every result passes through memory, so that calls are not computed together.
pub(crate) fn calls<T>(
    criterion: &mut Criterion,
    form: &str,
    dimension: usize,
    name: &str,
    evaluate: impl Fn(usize) -> T,
) {
    group(criterion, form, dimension, POINTS).bench_function(name, |bencher| {
        bencher.iter(|| {
            for i in 0..POINTS {
                black_box(evaluate(black_box(i)));
            }
        });
    });
}

fn group<'a>(
    criterion: &'a mut Criterion,
    form: &str,
    dimension: usize,
    points: usize,
) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(format!("{form}/{dimension}-d"));
    group.throughput(Throughput::Elements(points as u64));
    group
}

/// Points within ±1000, one list per axis, the same at every call.
fn scattered<const N: usize>() -> [Vec<f32>; N] {
    let mut state = 1_u64;
    [(); N].map(|()| {
        (0..POINTS)
            .map(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                ((state >> 40) as f32 / 8_388_608.0 - 1.0) * 1000.0
            })
            .collect()
    })
}
