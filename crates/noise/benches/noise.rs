//! Every kind of noise in 1-D to 4-D, its sums and its lattices: calls, grids and lists of points.
//!
//! A name consists of the method, the dimension and the kind: `grid_samples/3-d/perlin-2002`. A
//! part of a name as argument selects the matching benchmarks:
//! `cargo bench -p asperity-noise -- 3-d/perlin`.

use std::{hint::black_box, time::Duration};

use asperity_noise::{
    Cellular, Fbm, FbmSpectrum, Field, GaussianNoise, Grid, Perlin, PerlinClassic, Point, RidgedMultifractal,
    Rotation, Simplex, SparseConvolution, Turbulence, ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
    glam::{Vec2, Vec3, Vec4},
    lattice::{ChainedTable, PermutationTable},
    simd::Batch,
};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// The reason why a benchmark of a list cannot fail.
const ONE: &str = "one number per point";

const SEED: u32 = 7;
/// Distance of neighbors on a grid, in lattice cells.
const STEP: f32 = 0.05;
/// Points of a grid or a list.
const POINTS: usize = 4096;

fn kinds(criterion: &mut Criterion) {
    every_dimension(criterion, "white", WhiteNoise::new(SEED));
    every_dimension(criterion, "value", ValueNoise::new(SEED));
    every_dimension(criterion, "value-catmull-rom", ValueCatmullRom::new(SEED));
    every_dimension(criterion, "perlin-1985", PerlinClassic::new(SEED));
    every_dimension(criterion, "perlin-2002", Perlin::new(SEED));
    every_dimension(criterion, "value-gradient", ValueGradient::new(SEED));
    every_dimension(criterion, "simplex", Simplex::new(SEED));
    every_dimension(criterion, "simplex-wide", Simplex::new(SEED).with_classic_radius());
    every_dimension(criterion, "sparse", SparseConvolution::new(SEED));
    every_dimension(criterion, "cellular", Cellular::new(SEED));
    every_dimension(criterion, "gaussian", GaussianNoise::new(SEED));
}

fn every_dimension<K>(criterion: &mut Criterion, name: &str, noise: K)
where
    K: Field<f32> + Field<Vec2> + Field<Vec3> + Field<Vec4>,
{
    field::<f32>(criterion, name, &noise, [POINTS]);
    field::<Vec2>(criterion, name, &noise, [64; 2]);
    field::<Vec3>(criterion, name, &noise, [16; 3]);
    field::<Vec4>(criterion, name, &noise, [8; 4]);
}

fn sums(criterion: &mut Criterion) {
    fn of_dimension<V: Point>(criterion: &mut Criterion, size: fn() -> V::Array<usize>)
    where
        Perlin: Field<V>,
    {
        let rotated = Fbm::<_, V>::new(Perlin::new(1), FbmSpectrum::default()).with_octaves(8.0);
        field::<V>(criterion, "perlin-2002-octaves-8-rotated", &rotated, size());
        let aligned = rotated.with_rotation(Rotation::Aligned);
        field::<V>(criterion, "perlin-2002-octaves-8", &aligned, size());
        field::<V>(criterion, "perlin-2002-turbulence-8", &aligned.with_shape(Turbulence), size());
        let ridged = RidgedMultifractal::<_, V>::new(Perlin::new(1), FbmSpectrum::default(), 2.0);
        let ridged = ridged.expect("a feedback in range").with_octaves(8.0);
        field::<V>(criterion, "perlin-2002-ridged-multifractal-8", &ridged, size());
    }
    of_dimension::<Vec2>(criterion, || [64; 2]);
    of_dimension::<Vec3>(criterion, || [16; 3]);
}

/// Benchmarks pairs of channels, and the lattices of gradient noise.
///
/// The points are on a line that crosses a border of cells every few steps, like a scan line of an
/// image.
fn lines(criterion: &mut Criterion) {
    let line = |i: usize| Vec3::new(0.3, -7.0, 2.0) + Vec3::new(0.21, 0.17, -0.13) * i as f32;
    let noise = GaussianNoise::new(1);
    calls(criterion, "pair/3-d/gaussian", |i| noise.pair(line(i)));
    let sum = Fbm::<_, Vec3>::new(noise, FbmSpectrum::default()).with_octaves(8.0);
    calls(criterion, "sample/3-d/gaussian-octaves-8", |i| sum.sample(line(i)));
    calls(criterion, "detail/3-d/gaussian-octaves-8", |i| sum.sample_with_octaves(line(i), 8.0));
    calls(criterion, "pair/3-d/gaussian-octaves-8", |i| sum.pair(line(i)));
    calls(criterion, "pair/3-d/gaussian-octaves-4", |i| sum.pair_with_octaves(line(i), 4.0));
    let frame = [Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.48, 0.36, 0.8)];
    calls(criterion, "whitened/3-d/gaussian-octaves-8", |i| sum.whitened_gradient(line(i), frame));
    calls(criterion, "whitened/3-d/gaussian-octaves-4", |i| {
        sum.whitened_gradient_with_octaves(line(i), frame, 4.0)
    });
    let table = PermutationTable::new(1);
    let noise = Perlin::new(1);
    calls(criterion, "value/3-d/perlin-2002-integer-hash", |i| noise.value(line(i)));
    let noise = Perlin::new(1).with_lattice(table);
    calls(criterion, "value/3-d/perlin-2002-permutation-table", |i| noise.value(line(i)));
    let noise = Perlin::new(1).with_lattice(ChainedTable(table));
    calls(criterion, "value/3-d/perlin-2002-chained-table", |i| noise.value(line(i)));
    let noise = Perlin::new(1).tiled([16; 3]).expect("periods in range");
    calls(criterion, "value/3-d/perlin-2002-tiled", |i| noise.value(line(i)));
}

/// A call that writes values, and gradients if it has them.
type Run<'r, V> = &'r mut dyn for<'a> FnMut(&'a mut [f32], <V as Point>::Array<&'a mut [f32]>);

/// Benchmarks calls, a grid and lists of points of a field.
fn field<V: Point>(criterion: &mut Criterion, name: &str, field: &dyn Field<V>, size: V::Array<usize>) {
    let dimension = size.as_ref().len();
    let lists = V::array(scattered);
    let lists = || V::array(|axis| &lists.as_ref()[axis][..]);
    let points: Vec<V> = (0..POINTS).map(|i| V::from_axes(|axis| lists().as_ref()[axis][i])).collect();
    let id = |form: &str| format!("{form}/{dimension}-d/{name}");
    calls(criterion, &id("value"), |i| field.value(points[i]));
    calls(criterion, &id("sample"), |i| field.sample(points[i]));
    let grid = Grid { origin: V::from_axes(|_| -3.7), step: V::from_axes(|_| STEP), size };
    let (mut values, mut slopes) = (vec![0.0; POINTS], V::array(|_| vec![0.0; POINTS]));
    let mut bench = |form: &str, run: Run<'_, V>| {
        calls_of(criterion, &id(form), &mut || {
            let mut slopes = slopes.as_mut().iter_mut();
            let slopes = V::array(|_| slopes.next().map(Vec::as_mut_slice).unwrap_or_default());
            run(black_box(&mut values), slopes);
        });
    };
    let batch = Batch::new();
    bench("grid_values", &mut |values, _| field.grid_values(&grid, values).expect(ONE));
    bench("grid_samples", &mut |values, slopes| field.grid_samples(&grid, values, slopes).expect(ONE));
    bench("values", &mut |values, _| field.values(&points, values).expect(ONE));
    bench("list_values", &mut |values, _| batch.list_values(field, lists(), values).expect(ONE));
    bench("list_samples", &mut |values, slopes| {
        batch.list_samples(field, lists(), values, slopes).expect(ONE);
    });
}

/// Benchmarks calls at points. Every result passes through memory, so that calls are not merged.
fn calls<T>(criterion: &mut Criterion, id: &str, evaluate: impl Fn(usize) -> T) {
    calls_of(criterion, id, &mut || {
        for i in 0..POINTS {
            black_box(evaluate(black_box(i)));
        }
    });
}

/// Benchmarks a call for all points.
fn calls_of(criterion: &mut Criterion, id: &str, run: &mut dyn FnMut()) {
    let (group, name) = id.rsplit_once('/').unwrap_or(("", id));
    let mut group = criterion.benchmark_group(group);
    group.throughput(Throughput::Elements(POINTS as u64));
    group.bench_function(name, |bencher| bencher.iter(&mut *run));
}

/// Coordinates within ±1000, the same in every call.
fn scattered(axis: usize) -> Vec<f32> {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 40) as f32 / 8_388_608.0 - 1.0) * 1000.0
    };
    (0..axis * POINTS).for_each(|_| {
        next();
    });
    (0..POINTS).map(|_| next()).collect()
}

/// A short run of each benchmark, as there are hundreds.
fn configuration() -> Criterion {
    Criterion::default().warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(800))
}

criterion_group! { name = benches; config = configuration(); targets = kinds, sums, lines }
criterion_main!(benches);
