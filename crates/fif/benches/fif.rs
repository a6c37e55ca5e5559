//! Evaluations and primary rays per second for the functions of the source.

use asperity_fif::glam::DVec3;
use asperity_fif::{
    Fif, FixedFif, HeightField, Intersect, Interval, Jet, PeriodicSurface, Ray, System, cochran_2000,
    system::Piece,
};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

/// A Weyl sequence over the open domain `(0, 2)`, which has no short addresses.
fn points() -> Vec<f64> {
    (1..=1024).map(|i| 2.0 * (f64::from(i) * 0.618_033_988_749_895).fract()).collect()
}

/// A camera that looks down at the center of the square; about 90 % of the rays hit.
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
        Fif::affine(&[0.0, 0.4, 1.4, 2.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).expect("valid");
    let (f, g, f_hat) = (
        cochran_2000::f().expect("valid"),
        cochran_2000::g().expect("valid"),
        cochran_2000::f_hat().expect("valid"),
    );
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

/// Algorithm 2 as printed and the tables, at the same points; to 10⁻¹², `f32` to 10⁻⁶.
fn tables<S: AsRef<[Piece<C>]>, const C: usize>(c: &mut Criterion, name: &str, f: &System<S, C>) {
    let points: Vec<f64> = points()
        .into_iter()
        .chain((1..=3072).map(|i| 2.0 * (f64::from(i) * 0.754_877_666).fract()))
        .collect();
    let mut values = vec![0.0; points.len()];
    let fast = f.table(1e-12).expect("gentle factors");
    let fast32 = f.table(1e-6).expect("gentle factors").to_f32();
    let points32: Vec<f32> = points.iter().map(|&x| x as f32).collect();
    let mut values32 = vec![0.0; points.len()];
    let mut nodes = vec![0.0; (1 << 16) + 1];
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function("algorithm 2", |b| {
        b.iter(|| points.iter().map(|&x| f.algorithm_two(x, 1e-12)).sum::<f64>());
    });
    group.bench_function("plain", |b| {
        b.iter(|| points.iter().map(|&x| f.evaluate(x, 1e-12).value).sum::<f64>());
    });
    group.bench_function("table", |b| b.iter(|| points.iter().map(|&x| fast.value(x)).sum::<f64>()));
    group.bench_function("table, batch", |b| b.iter(|| fast.values(black_box(&points), &mut values)));
    group.bench_function("f32", |b| b.iter(|| points32.iter().map(|&x| fast32.value(x)).sum::<f32>()));
    group.bench_function("f32, batch", |b| b.iter(|| fast32.values(black_box(&points32), &mut values32)));
    group.throughput(Throughput::Elements(nodes.len() as u64));
    group.bench_function("grid", |b| b.iter(|| f.grid(black_box(&mut nodes))));
    group.finish();
}

fn fast(c: &mut Criterion) {
    tables(c, "f, table", &cochran_2000::f().expect("valid"));
    tables(c, "g, table", &cochran_2000::g().expect("valid"));
    tables(c, "f integral, table", &cochran_2000::f_hat().expect("valid"));
    tables(c, "g integral, table", &cochran_2000::g_hat().expect("valid"));
    jets(c, "f integral, jets", &cochran_2000::f_hat().expect("valid"));
    jets(c, "g integral, jets", &cochran_2000::g_hat().expect("valid"));
    let f = Fif::affine(&[0.0, 0.4, 1.4, 2.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).expect("valid");
    let points = points();
    let mut group = c.benchmark_group("uneven, table");
    group.throughput(Throughput::Elements(points.len() as u64));
    for tolerance in [1e-6, 1e-12] {
        let table = f.table(tolerance).expect("gentle factors");
        group.bench_function(format!("algorithm 2 at {tolerance:e}"), |b| {
            b.iter(|| points.iter().map(|&x| f.algorithm_two(x, tolerance)).sum::<f64>());
        });
        group.bench_function(format!("table to {tolerance:e}"), |b| {
            b.iter(|| points.iter().map(|&x| table.value(x)).sum::<f64>());
        });
    }
    group.finish();
}

/// Value, slope and integral compared with the value alone, to 10⁻¹².
fn jets<const C: usize>(c: &mut Criterion, name: &str, f: &FixedFif<2, C>) {
    let points = points();
    let table = f.table(1e-12).expect("gentle factors");
    let [mut value, mut slope, mut integral] = [0; 3].map(|_| vec![0.0; points.len()]);
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function("values", |b| b.iter(|| table.values(black_box(&points), &mut value)));
    group.bench_function("jets, batch", |b| {
        b.iter(|| {
            let out: Jet<&mut [f64]> = Jet { value: &mut value, slope: &mut slope, integral: &mut integral };
            table.jets(black_box(&points), out)
        });
    });
    group.bench_function("jets", |b| {
        b.iter(|| {
            let sum = |jet: Jet| jet.value + jet.slope + jet.integral;
            points.iter().map(|&x| sum(table.jet(x))).sum::<f64>()
        });
    });
    group.finish();
}

fn trace(surface: &impl Intersect, rays: &[Ray]) -> f64 {
    rays.iter().filter_map(|ray| surface.intersect(black_box(ray))).map(|hit| hit.t).sum()
}

fn rays(c: &mut Criterion) {
    let rays = camera(64);
    let mut group = c.benchmark_group("first hit");
    group.throughput(Throughput::Elements(rays.len() as u64)).sample_size(20);
    let [f, g] = [cochran_2000::f(), cochran_2000::g()].map(|f| f.expect("valid"));
    let [f_hat, g_hat] = [cochran_2000::f_hat(), cochran_2000::g_hat()].map(|f| f.expect("valid"));
    let plain = HeightField::new(f_hat, f_hat);
    let smooth = plain.clone().tabulated();
    group.bench_function("f integral, cached", |b| b.iter(|| trace(&smooth, &rays)));
    let rough_slope = HeightField::new(g_hat, g_hat).tabulated();
    group.bench_function("g integral, cached", |b| b.iter(|| trace(&rough_slope, &rays)));
    group.bench_function("f integral, no table", |b| b.iter(|| trace(&plain, &rays)));
    let continuous = HeightField::new(f, f).tabulated();
    group.bench_function("f, cached", |b| b.iter(|| trace(&continuous, &rays)));
    let rough = HeightField::new(g, g).tabulated();
    group.bench_function("g, cached", |b| b.iter(|| trace(&rough, &rays)));
    group.finish();
    let mut group = c.benchmark_group("rays in a batch");
    group.throughput(Throughput::Elements(rays.len() as u64)).sample_size(20);
    let all = Interval::new(0.0, f64::INFINITY);
    let z: [f64; 16] = core::array::from_fn(|k| ((7 * k) % 16) as f64 / 16.0);
    let d: [[f64; 2]; 16] = core::array::from_fn(|k| [((5 * k) % 16) as f64 / 8.0 - 1.0, 0.25 * z[15 - k]]);
    let torus = PeriodicSurface::new(4, [[2, -1], [1, 2]], 0.375, &z, &d).expect("valid").tabulated();
    let halved = |ray: &Ray| Ray { origin: 0.5 * ray.origin, direction: 0.5 * ray.direction };
    let onto_torus: Vec<Ray> = rays.iter().step_by(16).map(halved).collect();
    let mut hits = vec![None; rays.len()];
    for tolerance in [1e-4, 1e-12] {
        for (name, surface) in [("f integral", &smooth), ("g integral", &rough_slope)] {
            group.bench_function(format!("{name} to {tolerance:e}"), |b| {
                b.iter(|| surface.intersect_batch(black_box(&rays), all, tolerance, &mut hits));
            });
        }
        group.bench_function(format!("torus to {tolerance:e}, one of 16"), |b| {
            b.iter(|| {
                torus.intersect_batch(black_box(&onto_torus), all, tolerance, &mut hits[..onto_torus.len()])
            });
        });
    }
    group.bench_function("f, any hit", |b| {
        b.iter(|| black_box(&rays).iter().filter(|ray| continuous.occluded(ray, all)).count());
    });
    group.finish();
}

fn construction(c: &mut Criterion) {
    c.bench_function("construct g", |b| b.iter_batched(|| (), |()| cochran_2000::g(), BatchSize::SmallInput));
    let g = cochran_2000::g().expect("valid");
    c.bench_function("extrema of g to 1e-6", |b| b.iter(|| g.extrema(1e-6)));
    c.bench_function("table of g", |b| b.iter(|| HeightField::new(g, g).tabulated()));
}

criterion_group!(benches, evaluation, fast, rays, construction);
criterion_main!(benches);
