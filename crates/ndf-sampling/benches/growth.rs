//! Cost of a map against the number of its texels, and of a batch against its length.
//!
//! `cargo xtask bench --growth` makes a page of it.

use std::hint::black_box;

use asperity_ndf_sampling::{Ggx, NdfMap, PackedMapRef, Reconstruction};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

const SAMPLES: usize = 4096;

fn uniforms() -> [Vec<f32>; 2] {
    [0.754_877_7_f64, 0.569_840_3]
        .map(|step| (1..=SAMPLES as u32).map(|k| (f64::from(k) * step).fract() as f32).collect())
}

fn map(side: usize) -> NdfMap {
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    NdfMap::from_ndf(side, side, Reconstruction::Bilinear, &ggx).expect("a density")
}

fn texels(c: &mut Criterion) {
    let mut group = c.benchmark_group("growth/ndf-sampling/texels");
    let [u1, u2] = uniforms();
    let [mut x, mut y] = [(); 2].map(|()| vec![0.0; SAMPLES]);
    for side in [32, 64, 128, 256, 512, 1024] {
        let map = map(side);
        let texels = side * side;
        group.bench_function(BenchmarkId::new("packing", texels), |b| b.iter(|| black_box(&map).pack()));
        let array = map.pack();
        let packed = PackedMapRef::new(&array).expect("packed");
        group.bench_function(BenchmarkId::new("4096 samples", texels), |b| {
            b.iter(|| packed.inverses([&u1, &u2], [black_box(&mut x), &mut y]));
        });
    }
    group.finish();
}

fn samples(c: &mut Criterion) {
    let mut group = c.benchmark_group("growth/ndf-sampling/samples");
    let [u1, u2] = uniforms();
    let [mut x, mut y] = [(); 2].map(|()| vec![0.0; SAMPLES]);
    let array = map(256).pack();
    let packed = PackedMapRef::new(&array).expect("packed");
    for count in [1, 4, 16, 64, 256, 1024, 4096] {
        group.bench_function(BenchmarkId::new("256² map, bilinear", count), |b| {
            b.iter(|| {
                packed.inverses([&u1[..count], &u2[..count]], [black_box(&mut x[..count]), &mut y[..count]])
            });
        });
    }
    group.finish();
}

criterion_group!(benches, texels, samples);
criterion_main!(benches);
