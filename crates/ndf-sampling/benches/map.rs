//! Time per call and per element of a batch of `NdfMap`s, 256², GGX (0.2, 0.4), and of their
//! construction.

mod each;

use std::hint::black_box;

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{Ggx, Measure, Ndf, NdfMap, Reconstruction};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

use each::each;

const SIZE: usize = 256;
const SAMPLES: usize = 1 << 16;

const KINDS: [(&str, Reconstruction); 2] =
    [("constant", Reconstruction::Constant), ("bilinear", Reconstruction::Bilinear)];

/// Uniform numbers without a pattern that a branch predictor could learn.
fn uniforms() -> [Vec<f32>; 2] {
    let mix = |k: u32| {
        let k = (k ^ (k >> 16)).wrapping_mul(0x7FEB_352D);
        let k = (k ^ (k >> 15)).wrapping_mul(0x846C_A68B);
        ((k ^ (k >> 16)) >> 8) as f32 / (1 << 24) as f32
    };
    [1_u32, 2].map(|axis| (0..SAMPLES as u32).map(|k| mix(2 * k + axis)).collect())
}

fn map(kind: Reconstruction) -> NdfMap {
    NdfMap::from_ndf(SIZE, SIZE, kind, &Ggx::new(0.2, 0.4).expect("roughness in range")).expect("a density")
}

fn calls(c: &mut Criterion) {
    let [u1, u2] = uniforms();
    let u: Vec<Vec2> = u1.iter().zip(&u2).map(|(&x, &y)| Vec2::new(x, y)).collect();
    for (name, kind) in KINDS {
        let map = map(kind);
        let packed = map.view();
        let normals: Vec<Vec3> = u.iter().map(|&u| map.sample(u)).collect();
        let maps: [(&str, &dyn Ndf); 2] = [("map", &map), ("packed", &packed)];
        for (form, ndf) in maps {
            each(c, &format!("call/sample/{name}/{form}"), &u, |u| ndf.sample(u));
            each(c, &format!("call/invert/{name}/{form}"), &normals, |m| ndf.invert(m));
            each(c, &format!("call/density/{name}/{form}"), &normals, |m| ndf.d(m));
        }
    }
}

fn batches(c: &mut Criterion) {
    let [u1, u2] = uniforms();
    let mut group = c.benchmark_group("batch");
    group.throughput(Throughput::Elements(SAMPLES as u64));
    for (name, kind) in KINDS {
        let map = map(kind);
        let packed = map.view();
        let [mut x, mut y, mut to, mut density] = [(); 4].map(|()| vec![0.0; SAMPLES]);
        group.bench_function(format!("sample/{name}"), |b| {
            b.iter(|| packed.inverse_batch([&u1, &u2], [&mut x, &mut y]));
        });
        group.bench_function(format!("forward/{name}"), |b| {
            b.iter(|| packed.forward_batch([&x, &y], [&mut to, &mut density]));
        });
        group.bench_function(format!("density/{name}"), |b| {
            b.iter(|| packed.d_batch([&x, &y], &mut density));
        });
    }
    group.finish();
}

fn construction(c: &mut Criterion) {
    let ggx = Ggx::new(0.2, 0.4).expect("roughness in range");
    let texels: Vec<f32> = (0..SIZE * SIZE)
        .map(|k| {
            let [x, y] = [k % SIZE, k / SIZE].map(|k| (2 * k + 1) as f32 / SIZE as f32 - 1.0);
            ggx.d(Vec3::new(x, y, (1.0 - x * x - y * y).max(1e-6).sqrt()))
        })
        .collect();
    let mut group = c.benchmark_group("build");
    group.sample_size(20);
    for (name, kind) in KINDS {
        let build =
            || NdfMap::from_texels(SIZE, SIZE, black_box(&texels), Measure::ProjectedSolidAngle, kind);
        group.bench_function(format!("texels/{name}"), |b| b.iter(build));
    }
    group.finish();
}

criterion_group!(benches, calls, batches, construction);
criterion_main!(benches);
