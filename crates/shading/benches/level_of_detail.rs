//! Time per pixel of both level-of-detail rules, of the far field, and of the Fresnel terms.

use std::hint::black_box;

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::{GaussianField, IndependentChannels, RemappedOctaves, ResolvedBumps};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise, Perlin};
use asperity_shading::{
    Beckmann, Conductor, Dielectric, Frame, Ggx, LevelOfDetail, Ndf, Schlick, far_field, half_vector,
};
use criterion::{Criterion, criterion_group, criterion_main};

fn rules(c: &mut Criterion) {
    let h = half_vector(Vec3::new(0.36, 0.48, 0.8), Vec3::new(-0.1, 0.2, 1.0).normalize());
    let coordinates = ResolvedBumps { z: Vec2::new(0.7, -1.2), variance: 0.75, blend: 1.0 };
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

/// A pixel of a bump map by either rule: noise of four octaves, and a number of lights.
fn pixels(c: &mut Criterion) {
    let field = GaussianFbm::<Vec3>::new(GaussianNoise::new(1), FbmSpectrum::default());
    let ndf: &dyn Ndf = &Ggx::new(0.2, 0.4).expect("roughness in range");
    let frame = Frame::from_normal(Vec3::ONE);
    let wo = Vec3::new(-0.1, 0.2, 1.0).normalize();
    for lights in [1_u8, 8, 32] {
        let halves: Vec<Vec3> = (0..lights)
            .map(|k| half_vector(Vec3::new(0.6 - 0.03 * f32::from(k), 0.3, 0.8).normalize(), wo))
            .collect();
        for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
            let (mut k, mut radiances) = (0.0_f32, vec![0.0; halves.len()]);
            c.bench_function(&format!("pixel/{lights}_lights/{rule:?}").to_lowercase(), |b| {
                b.iter(|| {
                    k = (k + 1.0) % 1024.0;
                    let coordinates =
                        field.coordinates(black_box(Vec3::new(0.37, 1.21, -0.83) * k), &frame, 4.0);
                    rule.radiances(ndf, &halves, coordinates, &mut radiances);
                    radiances.iter().sum::<f32>()
                });
            });
        }
    }
}

fn fields(c: &mut Criterion) {
    let gaussian = GaussianFbm::<Vec3>::new(GaussianNoise::new(1), FbmSpectrum::default());
    let perlin = RemappedOctaves::new(Perlin::default(), FbmSpectrum::default(), 1).expect("a distribution");
    let fields: [(&str, &dyn GaussianField); 3] =
        [("gaussian", &gaussian), ("channels", &IndependentChannels(gaussian)), ("perlin_2002", &perlin)];
    let frame = Frame::from_normal(Vec3::ONE);
    for (name, field) in fields {
        for octaves in [1_u8, 2, 3, 4, 6, 8] {
            let mut k = 0.0_f32;
            c.bench_function(&format!("coordinates/{name}/{octaves}_octaves"), |b| {
                b.iter(|| {
                    k = (k + 1.0) % 1024.0;
                    let p = black_box(Vec3::new(0.37, 1.21, -0.83) * k);
                    field.coordinates(p, black_box(&frame), f32::from(octaves))
                });
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

criterion_group!(benches, rules, pixels, fields, fresnel);
criterion_main!(benches);
