//! Evaluations and primary rays per second of the source's functions.

use asperity_fif::glam::DVec3;
use asperity_fif::{Axis, Cached, FifBuf, FixedSmooth, HeightField, Ray, paper};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

/// A Weyl sequence over the open domain `(0, 2)`: no short addresses.
fn points() -> Vec<f64> {
    (1..=1024).map(|i| 2.0 * (f64::from(i) * 0.618_033_988_749_895).fract()).collect()
}

/// A camera that looks down at the middle of the square; about nine rays in ten hit.
fn camera(side: u32) -> Vec<Ray> {
    let origin = DVec3::new(-2.5, -3.25, 4.9);
    let forward = (DVec3::new(1.0, 1.0, 0.6) - origin).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(side) - 0.5;
    let rays = (0..side * side).map(|i| {
        let direction = forward + right * (0.34 * at(i % side)) + up * (0.3 * at(i / side));
        Ray { origin, direction }
    });
    rays.collect()
}

fn evaluation(c: &mut Criterion) {
    let points = points();
    let mut group = c.benchmark_group("evaluate");
    group.throughput(Throughput::Elements(points.len() as u64));
    let uneven =
        FifBuf::affine(&[0.0, 0.4, 1.4, 2.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).expect("valid");
    let (f, g, f_hat) =
        (paper::f().expect("valid"), paper::g().expect("valid"), paper::f_hat().expect("valid"));
    for tolerance in [1e-6, 1e-12] {
        let mut run = |name: &str, value: &dyn Fn(f64) -> f64| {
            group.bench_function(format!("{name} to {tolerance:e}"), |b| {
                b.iter(|| points.iter().map(|&x| value(x)).sum::<f64>());
            });
        };
        run("f", &|x| f.evaluate(x, tolerance).value);
        run("g", &|x| g.evaluate(x, tolerance).value);
        run("f integral", &|x| f_hat.evaluate(x, tolerance).value);
        run("uneven", &|x| uneven.evaluate(x, tolerance).value);
    }
    group.finish();
}

fn trace<A: Axis>(surface: &HeightField<A, A>, rays: &[Ray]) -> f64 {
    rays.iter().filter_map(|ray| surface.first_hit(black_box(ray))).map(|hit| hit.t).sum()
}

fn rays(c: &mut Criterion) {
    let rays = camera(64);
    let mut group = c.benchmark_group("first hit");
    group.throughput(Throughput::Elements(rays.len() as u64)).sample_size(20);
    let (f, g) = (paper::f().expect("valid"), paper::g().expect("valid"));
    let f_hat = FixedSmooth::<2, 3, 2>::integral(f, 0.0).expect("valid");
    let g_hat = FixedSmooth::<2, 3, 2>::integral(g, 0.0).expect("valid");
    let smooth = HeightField::new(Cached::new(f_hat), Cached::new(f_hat));
    group.bench_function("f integral, cached", |b| b.iter(|| trace(&smooth, &rays)));
    let rough_slope = HeightField::new(Cached::new(g_hat), Cached::new(g_hat));
    group.bench_function("g integral, cached", |b| b.iter(|| trace(&rough_slope, &rays)));
    let plain = HeightField::new(f_hat, f_hat);
    group.bench_function("f integral, no table", |b| b.iter(|| trace(&plain, &rays)));
    let continuous = HeightField::new(Cached::new(f), Cached::new(f));
    group.bench_function("f, cached", |b| b.iter(|| trace(&continuous, &rays)));
    let rough = HeightField::new(Cached::new(g), Cached::new(g));
    group.bench_function("g, cached", |b| b.iter(|| trace(&rough, &rays)));
    group.finish();
}

fn construction(c: &mut Criterion) {
    c.bench_function("construct g", |b| b.iter_batched(|| (), |()| paper::g(), BatchSize::SmallInput));
    let g = paper::g().expect("valid");
    c.bench_function("extrema of g to 1e-6", |b| b.iter(|| g.extrema(1e-6)));
    c.bench_function("table of g", |b| b.iter(|| Cached::new(g)));
}

criterion_group!(benches, evaluation, rays, construction);
criterion_main!(benches);
