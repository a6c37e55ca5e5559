//! Cost of a sum against the number of its octaves, and of a list against its length.
//!
//! `cargo xtask bench --growth` makes a page of it.

use std::hint::black_box;

use asperity_noise::{Field, Gaussian, GaussianOctaves, Grid, Octaves, Perlin2002, Spectrum, glam::Vec3};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

/// Octaves of any number up to 16 that do not grow fainter than `f32` tells.
fn spectrum() -> Spectrum {
    Spectrum::new(1.6, 0.7, 16).expect("in range")
}

fn place(k: &mut f32) -> Vec3 {
    *k = (*k + 1.0) % 1024.0;
    black_box(Vec3::new(0.37, 1.21, -0.83) * *k)
}

fn octaves(c: &mut Criterion) {
    let mut group = c.benchmark_group("growth/noise/octaves");
    let perlin = Octaves::new(Perlin2002::new(7), spectrum());
    let gaussian = GaussianOctaves::<3>::new(Gaussian::new(7), spectrum());
    let grid = Grid { origin: Vec3::ZERO, step: Vec3::splat(0.05), size: [16; 3] };
    for octaves in [1_u8, 2, 4, 8, 16] {
        let mut k = 0.0;
        let count = f32::from(octaves);
        let (sum, pair) = (perlin.first(count), gaussian.first(count));
        group.bench_function(BenchmarkId::new("Perlin 2002, 3-D, one sample", octaves), |b| {
            b.iter(|| sum.sample(place(&mut k)));
        });
        group.bench_function(BenchmarkId::new("Gaussian pair, 3-D, one sample", octaves), |b| {
            b.iter(|| pair.pair(place(&mut k)));
        });
        let mut values = vec![0.0; 4096];
        group.bench_function(BenchmarkId::new("Perlin 2002, 3-D, grid of 4096", octaves), |b| {
            b.iter(|| sum.grid_values(&grid, black_box(&mut values)));
        });
    }
    group.finish();
}

fn samples(c: &mut Criterion) {
    let mut group = c.benchmark_group("growth/noise/samples");
    let noise = Perlin2002::new(7);
    let points: Vec<Vec3> = (0..16_384_u16).map(|k| Vec3::new(0.37, 1.21, -0.83) * f32::from(k)).collect();
    let mut values = vec![0.0; points.len()];
    for count in [1, 4, 16, 64, 256, 1024, 4096, 16_384] {
        group.bench_function(BenchmarkId::new("Perlin 2002, 3-D, list", count), |b| {
            b.iter(|| noise.values(black_box(&points[..count]), &mut values[..count]));
        });
    }
    group.finish();
}

criterion_group!(benches, octaves, samples);
criterion_main!(benches);
