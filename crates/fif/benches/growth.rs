//! Cost of values, tables and rays against what errors they may have.
//!
//! `cargo xtask bench --growth` makes a page of it.

use std::hint::black_box;

use asperity_fif::glam::DVec3;
use asperity_fif::{HeightField, Intersect, Interval, Ray, paper};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

/// Digits that are asked for: the tolerance is 10 to minus this.
const DIGITS: [i32; 5] = [2, 4, 6, 8, 12];

/// A ray from its origin on.
const ALL: Interval = Interval { lo: 0.0, hi: f64::INFINITY };

fn tolerance(c: &mut Criterion) {
    let mut group = c.benchmark_group("growth/fif/1 over the tolerance");
    let (f, g, f_hat) =
        (paper::f().expect("valid"), paper::g().expect("valid"), paper::f_hat().expect("valid"));
    let mut k = 0_u32;
    let mut next = move || {
        k = (k + 1) % 1024;
        black_box(2.0 * (f64::from(k) * 0.618_033_988_749_895).fract())
    };
    for digits in DIGITS {
        let (tolerance, id) = (10_f64.powi(-digits), format!("1e{digits}"));
        group.bench_function(BenchmarkId::new("f, Algorithm 2", &id), |b| {
            b.iter(|| f.evaluate(next(), tolerance));
        });
        group.bench_function(BenchmarkId::new("g, Algorithm 2", &id), |b| {
            b.iter(|| g.evaluate(next(), tolerance));
        });
        group.bench_function(BenchmarkId::new("building a table of f", &id), |b| {
            b.iter(|| f.table(tolerance).expect("gentle factors"));
        });
        let table = f.table(tolerance).expect("gentle factors");
        group.bench_function(BenchmarkId::new("f, from its table", &id), |b| b.iter(|| table.value(next())));
    }
    let surface = HeightField::new(f_hat, f_hat).tabulated();
    let origin = DVec3::new(-2.5, -3.25, 4.9);
    for digits in [2, 4, 6, 8] {
        group.bench_function(BenchmarkId::new("a ray at f̂×f̂", format!("1e{digits}")), |b| {
            b.iter(|| {
                let target = DVec3::new(next(), next(), 0.6);
                surface.first_hit_within(
                    &Ray { origin, direction: target - origin },
                    ALL,
                    10_f64.powi(-digits),
                )
            });
        });
    }
    group.finish();
}

criterion_group!(benches, tolerance);
criterion_main!(benches);
