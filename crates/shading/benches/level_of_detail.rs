//! Time per pixel of the two rules of level of detail, of the far field, and of the Fresnel terms.

use std::hint::black_box;

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{
    Beckmann, Conductor, Coordinates, Dielectric, Ggx, LevelOfDetail, Ndf, Schlick, far_field, half_vector,
};
use criterion::{Criterion, criterion_group, criterion_main};

fn rules(c: &mut Criterion) {
    let h = half_vector(Vec3::new(0.36, 0.48, 0.8), Vec3::new(-0.1, 0.2, 1.0).normalize());
    let coordinates = Coordinates { z: Vec2::new(0.7, -1.2), share: 0.75, fade: 1.0 };
    let ndfs: [(&str, &dyn Ndf); 2] = [
        ("ggx", &Ggx::new(0.2, 0.4).expect("roughness in range")),
        ("beckmann", &Beckmann::isotropic(0.3).expect("roughness in range")),
    ];
    for (name, ndf) in ndfs {
        c.bench_function(&format!("far_field/{name}"), |b| b.iter(|| far_field(ndf, black_box(h))));
        for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
            c.bench_function(&format!("{rule:?}/{name}").to_lowercase(), |b| {
                b.iter(|| rule.radiance(ndf, black_box(h), black_box(coordinates)));
            });
        }
    }
}

fn fresnel(c: &mut Criterion) {
    let glass = Dielectric::new(1.5).expect("index in range");
    let gold = Conductor::new(0.2, 3.0).expect("index in range");
    let schlick = Schlick::new(0.04).expect("share in range");
    c.bench_function("fresnel/dielectric", |b| b.iter(|| glass.reflectance(black_box(0.6))));
    c.bench_function("fresnel/conductor", |b| b.iter(|| gold.reflectance(black_box(0.6))));
    c.bench_function("fresnel/schlick", |b| b.iter(|| schlick.reflectance(black_box(0.6))));
}

criterion_group!(benches, rules, fresnel);
criterion_main!(benches);
