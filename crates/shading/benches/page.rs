//! The tables of `docs/bench/shading.md`: how the cost of a pixel grows with its lights and with its octaves, with the slopes of its
//! columns over logarithms, and materials near and far.
//!
//! All numbers of a table take turns in one process, so that what else the machine does falls on all of them.

// Its tables are what it is run for.
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::Instant;

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::GaussianField;
use asperity_shading::material::{BrickWall, GlintField, Material};
use asperity_shading::noise::{Gaussian, GaussianOctaves, Spectrum};
use asperity_shading::{
    Beckmann, Brdf, Carpet, CarpetParameters, Footprint, Ggx, LevelOfDetail, MetallicPaint,
    MetallicPaintParameters, Ndf, Scratches, ScratchesParameters, SurfacePoint, TemperedGlass,
    TemperedGlassParameters, Variations, VariationsParameters, half_vector,
};

/// Calls of one measurement.
const CALLS: u16 = 64;

/// Nanoseconds of a call, the median of rounds in which all cases take turns.
fn medians(cases: &mut [Box<dyn FnMut() + '_>], rounds: usize) -> Vec<f64> {
    let mut times = vec![Vec::with_capacity(rounds); cases.len()];
    for _ in 0..rounds {
        for (case, times) in cases.iter_mut().zip(&mut times) {
            let start = Instant::now();
            (0..CALLS).for_each(|_| case());
            times.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS));
        }
    }
    let middle = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.into_iter().map(middle).collect()
}

/// Slope of the straight line through logarithms, by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<_> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let (mean_x, mean_y) = logs.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / count, b + y / count));
    let (xy, xx) = logs.iter().fold((0.0, 0.0), |(xy, xx), (x, y)| {
        (xy + (x - mean_x) * (y - mean_y), xx + (x - mean_x) * (x - mean_x))
    });
    xy / xx
}

/// Prints a table: a row for each number, a column for each density under each rule.
fn table(what: &str, numbers: &[u8], rounds: usize, pixel: impl Fn(u8) -> (usize, f32)) {
    let field =
        GaussianOctaves::<3>::new(Gaussian::new(1), Spectrum::new(2.17, 0.5, 16).expect("a spectrum"));
    let wo = Vec3::new(-0.1, 0.2, 1.0).normalize();
    let towards = |k: u8| Vec3::new(0.6 - 0.03 * f32::from(k), 0.3, 0.8).normalize();
    let halves: Vec<Vec3> = (0..64).map(|k| half_vector(towards(k), wo)).collect();
    let ndfs: [(&str, &dyn Ndf); 2] = [
        ("GGX", &Ggx::new(0.2, 0.4).expect("roughness in range")),
        ("Beckmann", &Beckmann::new(0.2, 0.4).expect("roughness in range")),
    ];
    let rules = [LevelOfDetail::Exact, LevelOfDetail::Fractal];
    let columns: Vec<_> = ndfs.iter().flat_map(|ndf| rules.map(|rule| (ndf, rule))).collect();
    let mut cases: Vec<Box<dyn FnMut() + '_>> = Vec::new();
    for &number in numbers {
        let (lights, octaves) = pixel(number);
        for &((_, ndf), rule) in &columns {
            let (halves, field, mut radiances, mut k) = (&halves[..lights], &field, [0.0; 64], 0.0_f32);
            cases.push(Box::new(move || {
                k = (k + 1.0) % 1024.0;
                let coordinates = field.coordinates(black_box(Vec3::new(0.37, 1.21, -0.83) * k), octaves);
                rule.radiances(*ndf, halves, coordinates, &mut radiances);
                black_box(&radiances);
            }));
        }
    }
    let times = medians(&mut cases, rounds);
    let header: String =
        columns.iter().map(|((name, _), rule)| format!(" {name}, `{rule:?}`, ns |")).collect();
    println!("\n| {what} |{header}\n|---|{}", "---|".repeat(columns.len()));
    let rows = || numbers.iter().zip(times.chunks(columns.len()));
    for (number, row) in rows() {
        let row: String = row.iter().map(|ns| format!(" {ns:.0} |")).collect();
        println!("| {number} |{row}");
    }
    let slopes = (0..columns.len()).map(|column| {
        let points: Vec<_> = rows().map(|(&number, row)| (f64::from(number), row[column])).collect();
        format!(" {:.2} |", slope(&points))
    });
    println!("| slope |{}", slopes.collect::<String>());
}

/// Calls of a function of a point of a plane, another one each time.
fn on_points<'a>(width: f32, f: impl Fn(&SurfacePoint) -> f32 + 'a) -> Box<dyn FnMut() + 'a> {
    let mut k = 0.0_f32;
    Box::new(move || {
        k = (k + 1.0) % 1024.0;
        let uv = Vec2::new(0.0137, 0.0211) * k;
        let point = SurfacePoint::new(uv.extend(0.3), Vec3::Z, Footprint::from_width(width));
        black_box(f(black_box(&point.with_uv(uv, [Vec3::X, Vec3::Y]))));
    })
}

/// Prints millions of points per second of each material at three widths of pixels: its BSDF made, and made and asked for a direction.
fn materials(rounds: usize) {
    const VALID: &str = "parameters in range";
    const WIDTHS: [f32; 3] = [1e-5, 2e-3, 10.0];
    let glints = GlintField::new(Beckmann::isotropic(0.3).expect(VALID), 1e-3, 0.1, 1).expect(VALID);
    let all: [(&str, Box<dyn Material>); 6] = [
        ("carpet", Box::new(Carpet::new(CarpetParameters::default()).expect(VALID))),
        ("paint", Box::new(MetallicPaint::new(MetallicPaintParameters::default()).expect(VALID))),
        ("scratches", Box::new(Scratches::new(ScratchesParameters::default()).expect(VALID))),
        ("glass", Box::new(TemperedGlass::new(TemperedGlassParameters::default()).expect(VALID))),
        ("variations", Box::new(Variations::new(VariationsParameters::default()).expect(VALID))),
        ("bricks", Box::new(BrickWall::default())),
    ];
    let (h, wi, wo) =
        (Vec3::new(0.2, 0.1, 0.97).normalize(), Vec3::new(2.0, -3.0, 6.0) / 7.0, Vec3::new(-0.6, 0.0, 0.8));
    let mut cases: Vec<Box<dyn FnMut() + '_>> = Vec::new();
    for width in WIDTHS {
        cases.push(on_points(width, |p| glints.density(h, p.position, p.footprint())));
        for (_, material) in &all {
            cases.push(on_points(width, move |p| material.bsdf(p, wo).emitted().x));
            cases.push(on_points(width, move |p| material.bsdf(p, wo).value(wi, wo).x));
        }
    }
    let times = medians(&mut cases, rounds);
    let [near, between, far] = [0, 1, 2].map(|k| &times[k * times.len() / 3..]);
    println!("\n| | near | between | far |\n|---|---|---|---|");
    let row = |name: &str, k: usize| {
        let [near, between, far] = [near, between, far].map(|times| 1e3 / times[k]);
        println!("| {name} | {near:.2} | {between:.2} | {far:.2} |");
    };
    row("glints, density", 0);
    for (k, (name, _)) in all.iter().enumerate() {
        row(name, 1 + 2 * k);
        row(&format!("{name}, asked once"), 2 + 2 * k);
    }
}

fn main() {
    // As a test, once.
    let rounds = if std::env::args().any(|arg| arg == "--bench") { 2001 } else { 1 };
    table("lights, four octaves", &[1, 2, 4, 8, 16, 32, 64], rounds, |lights| (lights.into(), 4.0));
    table("octaves, one light", &[1, 2, 4, 8, 16], rounds, |octaves| (1, octaves.into()));
    materials(rounds.div_ceil(4));
}
