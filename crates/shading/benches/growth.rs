//! Cost of a pixel against the number of its lights and of its octaves.
//!
//! `cargo xtask bench --growth` makes a page of it.

use std::hint::black_box;

use asperity_shading::glam::Vec3;
use asperity_shading::level_of_detail::GaussianField;
use asperity_shading::noise::{Gaussian, GaussianOctaves, Spectrum};
use asperity_shading::{Beckmann, Ggx, LevelOfDetail, Ndf, half_vector};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

fn growth(c: &mut Criterion) {
    let ndfs: [(&str, &dyn Ndf); 2] = [
        ("GGX", &Ggx::new(0.2, 0.4).expect("roughness in range")),
        ("Beckmann", &Beckmann::new(0.2, 0.4).expect("roughness in range")),
    ];
    let field = GaussianOctaves::<3>::new(Gaussian::new(1), Spectrum::new(1.6, 0.7, 16).expect("in range"));
    let wo = Vec3::new(-0.1, 0.2, 1.0).normalize();
    let halves: Vec<Vec3> = (0..64_u8)
        .map(|k| half_vector(Vec3::new(0.6 - 0.015 * f32::from(k), 0.3, 0.8).normalize(), wo))
        .collect();
    let mut radiances = [0.0; 64];
    let mut k = 0.0;
    let mut pixel = |octaves: f32, lights: usize, ndf: &dyn Ndf, rule: LevelOfDetail| {
        k = (k + 1.0) % 1024.0;
        let coordinates = field.coordinates(black_box(Vec3::new(0.37, 1.21, -0.83) * k), octaves);
        rule.radiances(ndf, &halves[..lights], coordinates, black_box(&mut radiances));
    };
    let mut group = c.benchmark_group("growth/shading/lights");
    for lights in [1, 2, 4, 8, 16, 32, 64] {
        for (name, ndf) in ndfs {
            for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
                let id = BenchmarkId::new(format!("a pixel of 4 octaves, {name}, {rule:?}"), lights);
                group.bench_function(id, |b| b.iter(|| pixel(4.0, lights, ndf, rule)));
            }
        }
    }
    group.finish();
    let mut group = c.benchmark_group("growth/shading/octaves");
    for octaves in [1_u8, 2, 4, 8, 16] {
        group.bench_function(BenchmarkId::new("a pixel of 1 light, GGX, Exact", octaves), |b| {
            b.iter(|| pixel(f32::from(octaves), 1, ndfs[0].1, LevelOfDetail::Exact));
        });
    }
    group.finish();
}

criterion_group!(benches, growth);
criterion_main!(benches);
