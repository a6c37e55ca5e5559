//! Rays per second against fractal height fields: Asperity compared with Embree on meshes of
//! similar error, interleaved.
//!
//! `cargo run --release -- [--rounds N] [--largest SIDE] [--ship FILE]` prints a Markdown table,
//! explained in ../README.md.

mod embree;

use std::{error::Error, fs, hint::black_box, path::PathBuf, time::Instant};

use asperity_fif::{FixedFif, HeightField, Hit, Intersect, Interval, Ray, cochran_2000, glam::DVec3};
use embree::Mesh;

type Surface = HeightField<FixedFif<2, 3>, FixedFif<2, 3>>;

const RAYS: u32 = 512 * 512;
const ALL: Interval = Interval::new(0.0, f64::INFINITY);
/// The side of the square under the surfaces.
const SIZE: f64 = 2.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let option = |name: &str| arguments.iter().skip_while(|a| *a != name).nth(1).cloned();
    let rounds: usize = option("--rounds").map_or(Ok(5), |text| text.parse())?;
    let largest: usize = option("--largest").map_or(Ok(2048), |text| text.parse())?;
    let mut text = format!(
        "# Rays against fractal height fields\n\nOne thread of {}. Each round traces {RAYS} different rays with each library, {rounds} \
         interleaved rounds, medians of the thread's CPU time. Errors are the 99th percentile of the distance of hits along the ray, \
         in units of the square's side. The side of the mesh is the smallest power of two that reaches the target error, or the largest \
         that was tried. Asperity's tolerance is the target error, certified for every ray. `tools/peers/fif` prints this table.\n\n\
         | surface | rays | target error | mesh | mesh error | Embree, M rays/s | Asperity's error | single rays | batch | best ratio | target ratio |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
        processor()
    );
    let mut costs = String::from("\n| | build | memory |\n|---|---|---|\n");
    for (name, curve) in [("f̂×f̂", cochran_2000::f_hat()?), ("ĝ×ĝ", cochran_2000::g_hat()?)] {
        let plain = HeightField::new(curve, curve);
        // Repeated for the resolution of the thread clock, which is milliseconds.
        const BUILDS: u32 = 32;
        let surface = plain.clone().tabulated();
        let build = |_| drop(black_box(black_box(plain.clone()).tabulated()));
        let took = timed(|| (0..BUILDS).for_each(build)).1 * 1e3 / f64::from(BUILDS);
        let memory = (surface.x().bytes() + surface.y().bytes()) as f64 * 1e-6;
        costs += &format!("| {name}, Asperity | {took:.2} ms | {memory:.3} MB |\n");
        let sets = [("primary", primary()), ("random", random())];
        let exact: Vec<Vec<Option<Hit>>> =
            sets.iter().map(|(_, rays)| trace(&surface, rays, 0.0).0).collect();
        let mut side = 64;
        let mut mesh = None;
        let mut errors = [f64::INFINITY; 2];
        for (goal, wanted) in [(1e-4, 0.9), (1e-6, 1.6)] {
            for (k, (kind, rays)) in sets.iter().enumerate() {
                while mesh.is_none() || (errors[k] > goal && side < largest) {
                    if mesh.is_some() {
                        side *= 2;
                    }
                    drop(mesh.take());
                    let nodes: Vec<f64> = (0..=side)
                        .map(|i| curve.evaluate(SIZE * i as f64 / side as f64, 0.0).value)
                        .collect();
                    let before = resident();
                    let (built, took) = timed(|| Mesh::new(side, |i, j| nodes[i] * nodes[j]));
                    let (took, memory) = (took * 1e3, resident() - before);
                    costs += &format!("| {name}, Embree, {side}² | {took:.0} ms | {memory:.0} MB |\n");
                    for (error, ((_, rays), exact)) in errors.iter_mut().zip(sets.iter().zip(&exact)) {
                        let found = intersect(&built, rays).0;
                        *error = percentile(rays, exact, |i| f64::from(found[i]));
                    }
                    mesh = Some(built);
                }
                let Some(built) = &mesh else { continue };
                let tolerance = goal * SIZE;
                let mut times = [const { Vec::new() }; 3];
                let mut ours = Vec::new();
                for _ in 0..rounds {
                    times[0].push(intersect(built, rays).1);
                    let (hits, single) = trace(&surface, rays, tolerance);
                    times[1].push(single);
                    times[2].push(batch(&surface, rays, tolerance));
                    ours = hits;
                }
                let error = percentile(rays, &exact[k], |i| ours[i].map_or(f64::INFINITY, |hit| hit.t));
                let [theirs, single, batch] = times.map(|times| f64::from(RAYS) / median(times) * 1e-6);
                let (its_error, ratio) = (errors[k], single.max(batch) / theirs);
                text += &format!(
                    "| {name} | {kind} | {goal:e} | {side}² | {its_error:.1e} | {theirs:.2} | {error:.1e} | {single:.2} | {batch:.2} | \
                     {ratio:.2} | {wanted} |\n"
                );
                eprintln!("{}", text.lines().last().unwrap_or_default());
            }
        }
    }
    text += &costs;
    println!("{text}");
    if let Some(file) = option("--ship") {
        // Written to a temporary file and renamed, so that the table is always complete.
        let part = PathBuf::from(&file).with_extension("part");
        fs::write(&part, text)?;
        fs::rename(part, file)?;
    }
    Ok(())
}

/// A camera that looks down at the center of the square. Six rays in seven hit f̂×f̂.
fn primary() -> Vec<Ray> {
    let origin = DVec3::new(-2.5, -3.25, 4.9);
    let forward = DVec3::new(3.5, 4.25, -4.3).normalize();
    let right = DVec3::new(forward.y, -forward.x, 0.0).normalize();
    let up = right.cross(forward);
    let at = |i: u32| (f64::from(i) + 0.5) / 512.0 - 0.5;
    (0..RAYS)
        .map(|i| single(origin, forward + right * (0.34 * at(i % 512)) + up * (0.3 * at(i / 512))))
        .collect()
}

/// From above the square toward a larger square on the ground.
fn random() -> Vec<Ray> {
    let mut state = 7_u64;
    let mut next = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / 9_007_199_254_740_992.0
    };
    (0..RAYS)
        .map(|_| {
            let from = DVec3::new(2.0 * next(), 2.0 * next(), 4.5);
            let to = DVec3::new(4.0 * next() - 1.0, 4.0 * next() - 1.0, 0.5 * next());
            single(from, to - from)
        })
        .collect()
}

/// Rounds a ray to single precision, so that both use the same ray.
fn single(origin: DVec3, direction: DVec3) -> Ray {
    Ray { origin: origin.as_vec3().as_dvec3(), direction: direction.as_vec3().as_dvec3() }
}

/// Returns `t` of every ray on the mesh, and the seconds taken.
fn intersect(mesh: &Mesh, rays: &[Ray]) -> (Vec<f32>, f64) {
    let single = |ray: &Ray| [ray.origin, ray.direction].map(|v| v.as_vec3().to_array());
    let rays: Vec<[[f32; 3]; 2]> = rays.iter().map(single).collect();
    let mut found = vec![0.0; rays.len()];
    let ((), took) = timed(|| {
        for ([origin, direction], t) in rays.iter().zip(&mut found) {
            *t = mesh.intersect(*origin, *direction);
        }
    });
    (black_box(found), took)
}

/// Returns the hits, ray by ray, and the seconds taken.
fn trace(surface: &Surface, rays: &[Ray], tolerance: f64) -> (Vec<Option<Hit>>, f64) {
    let mut hits = vec![None; rays.len()];
    let ((), took) = timed(|| {
        for (ray, hit) in rays.iter().zip(&mut hits) {
            *hit = surface.intersect_within(ray, ALL, tolerance);
        }
    });
    (black_box(hits), took)
}

/// Returns the seconds for all rays in a batch.
fn batch(surface: &Surface, rays: &[Ray], tolerance: f64) -> f64 {
    let mut hits = vec![None; rays.len()];
    let (done, took) = timed(|| surface.intersect_batch(rays, ALL, tolerance, &mut hits));
    done.expect("one length");
    black_box(hits);
    took
}

/// Returns the 99th percentile of the distance to the exact hit, over rays that hit both.
fn percentile(rays: &[Ray], exact: &[Option<Hit>], t: impl Fn(usize) -> f64) -> f64 {
    let mut errors: Vec<f64> = rays
        .iter()
        .zip(exact)
        .enumerate()
        .filter_map(|(i, (ray, exact))| {
            Some((t(i) - exact.as_ref()?.t).abs() * ray.direction.length() / SIZE)
        })
        .filter(|error| error.is_finite())
        .collect();
    errors.sort_by(f64::total_cmp);
    errors.get(errors.len() * 99 / 100).copied().unwrap_or(f64::INFINITY)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Returns a function's result and this thread's CPU seconds. Linux counts them with a resolution
/// of milliseconds, excluding other programs.
fn timed<T>(run: impl FnOnce() -> T) -> (T, f64) {
    let thread = || {
        let times = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
        Some(times.split_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
    };
    let (start, before) = (Instant::now(), thread());
    let given = run();
    let took = before.and_then(|before| Some(thread()? - before));
    (given, took.unwrap_or_else(|| start.elapsed().as_secs_f64()))
}

/// Returns the memory of this process in MB.
fn resident() -> f64 {
    let kilobytes = line("/proc/self/status", "VmRSS:");
    let kilobytes = kilobytes.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kb| kb * 1.024e-3)
}

fn processor() -> String {
    let name =
        line("/proc/cpuinfo", "model name").and_then(|text| Some(text.split_once(':')?.1.trim().into()));
    name.unwrap_or_else(|| "an unknown processor".into())
}

/// Returns the rest of the first line of a file that begins with a word.
fn line(file: &str, word: &str) -> Option<String> {
    fs::read_to_string(file).ok()?.lines().find_map(|line| line.strip_prefix(word)).map(str::to_owned)
}
