//! Equal bits at every SIMD level: batches against single points, for every noise, dimension and
//! sum.

use std::{panic, thread};

use asperity_lanes::{
    compare::{ORIGIN, Random, coordinate, cut, far_cases, grid, grids, lengths, near_cases, points},
    noise_kinds::{Testable, Visit, every_dimension, every_kind},
};
use asperity_noise::{
    Cellular, CellularOutput, Fbm, FbmSpectrum, Field, GaussianNoise, Grid, Metric, Normalization, Perlin,
    Point, Rotation, Simplex, SparseConvolution, ValueCatmullRom,
    glam::{Vec2, Vec3, Vec4},
    lattice::PermutationTable,
};

/// Checks applied to every noise.
enum Check {
    Near,
    Far,
    Lengths,
    Points,
}

impl Visit for Check {
    fn visit<V: Point<Coordinates = [f32; N]>, K: Testable<V, N>, const N: usize>(
        &mut self,
        name: &str,
        noise: K,
    ) {
        match self {
            Self::Near => grids::<V>(name, &noise.with_seed(7), &near_cases()),
            Self::Far => grids::<V>(name, &noise.with_seed(7), &far_cases()),
            Self::Lengths => lengths::<V>(name, &noise.with_seed(u32::MAX)),
            Self::Points => every_point::<V>(name, &noise.with_seed(7)),
        }
    }
}

fn every_point<V: Point>(name: &str, field: &dyn Field<V>) {
    points(name, field, 4001);
    for count in 0..20 {
        points(name, field, count);
    }
    // The value equals the value of the sample.
    let mut random = Random(5);
    for _ in 0..1000 {
        let p = V::from_axes(|_| coordinate(&mut random));
        let [alone, value] = [field.value(p), field.sample(p).value].map(f32::to_bits);
        assert_eq!(alone, value, "{name} at {p:?}");
    }
}

/// Runs a test on a stack large enough for the frames of unoptimized 64-byte registers. 2 MiB is
/// too small.
fn on_a_large_stack(test: impl FnOnce() + Send + 'static) {
    let thread = thread::Builder::new().stack_size(64 << 20).spawn(test).expect("a thread");
    if let Err(failure) = thread.join() {
        panic::resume_unwind(failure);
    }
}

#[test]
fn near_grids_have_the_scalar_bits() {
    on_a_large_stack(|| every_kind(&mut Check::Near));
}

#[test]
fn far_grids_have_the_scalar_bits() {
    on_a_large_stack(|| every_kind(&mut Check::Far));
}

#[test]
fn rows_of_any_length_have_the_scalar_bits() {
    on_a_large_stack(|| every_kind(&mut Check::Lengths));
}

#[test]
fn cellular_noise_has_the_scalar_bits() {
    on_a_large_stack(|| {
        for (basis, metric) in [
            (CellularOutput::F1, Metric::Euclidean),
            (CellularOutput::F2MinusF1, Metric::Manhattan),
            (CellularOutput::F2, Metric::Chebyshev),
            (CellularOutput::Cell, Metric::Euclidean),
        ] {
            let noise = Cellular::default().with_output(basis).with_metric(metric);
            for check in [&mut Check::Near, &mut Check::Far, &mut Check::Points] {
                every_dimension(check, &format!("{basis:?} {metric:?}"), noise);
            }
        }
    });
}

/// Lattices share all code except the hash, whose lookups are scalar.
#[test]
fn other_lattices_have_the_scalar_bits() {
    on_a_large_stack(|| {
        let near = |name: &str, field: &dyn Field<Vec2>| grids(name, field, &near_cases());
        let table = PermutationTable::new(1);
        near("Perlin 2002 by permutation 2-D", &Perlin::new(7).with_lattice(table));
        every_point::<Vec3>("simplex by permutation 3-D", &Simplex::new(7).with_classic_radius().with_lattice(table));
        const PERIODS: [u32; 2] = [5, 3];
        near("Perlin 2002 tiled 2-D", &Perlin::new(7).tiled(PERIODS).expect("periods"));
        near("Catmull-Rom tiled 2-D", &ValueCatmullRom::new(7).tiled(PERIODS).expect("periods"));
        near("sparse tiled 2-D", &SparseConvolution::new(7).tiled(PERIODS).expect("periods"));
        let tiled = Simplex::new(7).tiled([3, 9, 6]).expect("multiples of three");
        grids::<Vec3>("simplex tiled 3-D", &tiled, &near_cases());
        every_point::<Vec3>("simplex tiled 3-D", &tiled);
    });
}

#[test]
fn points_have_the_scalar_bits() {
    on_a_large_stack(|| every_kind(&mut Check::Points));
}

fn sum<V: Point<Coordinates = [f32; N]>, K: Field<V> + Copy, const N: usize>(name: &str, noise: K) {
    for rotation in [Rotation::Random, Rotation::Aligned] {
        for normalisation in [Normalization::UnitRange, Normalization::UnitVariance] {
            let octaves = Fbm::<K, V>::new(noise, FbmSpectrum::default()).with_seed(3);
            let octaves = octaves.with_normalization(normalisation).with_rotation(rotation);
            let name = format!("{name} {N}-D {rotation:?} {normalisation:?}");
            let first = |count| Box::new(octaves.with_octaves(count)) as Box<dyn Field<V>>;
            for count in [3.4, 1.0, 0.0] {
                grids(&name, first(count).as_ref(), &near_cases()[..4]);
                points(&name, first(count).as_ref(), 501);
            }
            grids(&name, first(2.5).as_ref(), &far_cases());
            let size = V::array(|axis| if axis == 0 { 700 } else { 1 });
            let step = cut([-0.01, 0.3, 0.2, 0.1]);
            grid(&name, first(2.5).as_ref(), &Grid { origin: cut(ORIGIN), step, size });
            let (field, p) = (first(3.4), cut(ORIGIN));
            assert_eq!(field.value(p).to_bits(), field.sample(p).value.to_bits(), "{name}");
        }
    }
}

fn sums<K: Field<f32> + Field<Vec2> + Field<Vec3> + Field<Vec4> + Copy>(name: &str, noise: K) {
    sum::<f32, K, 1>(name, noise);
    sum::<Vec2, K, 2>(name, noise);
    sum::<Vec3, K, 3>(name, noise);
    sum::<Vec4, K, 4>(name, noise);
}

#[test]
fn sums_have_the_scalar_bits() {
    on_a_large_stack(|| {
        sums("Perlin 2002", Perlin::default());
        sums("Gaussian", GaussianNoise::default());
        sum::<Vec3, _, 3>("simplex", Simplex::default());
    });
}
