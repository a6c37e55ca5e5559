//! Growth of cost: values, jets and rays against the tolerance, tables and rays against the number of cells, each with the slope of its
//! line on two logarithmic scales.
//!
//! `cargo bench -p asperity-fif --bench tolerance -- --ship docs/bench/fif.md` writes the page.

use std::fmt::Write as _;
use std::hint::black_box;
use std::io::Write as _;
use std::time::Instant;

use asperity_fif::glam::DVec3;
use asperity_fif::{FixedFif, HeightField, Hit, Intersect, Interval, Jet, Ray, Torus, paper};

const ALL: Interval = Interval::new(0.0, f64::INFINITY);
const SMOOTH: [&str; 2] = ["integral of f", "integral of g"];

/// Whether everything is measured, or a little once, where the program runs as a test.
struct Effort {
    full: bool,
}

impl Effort {
    fn tolerances(&self) -> Vec<f64> {
        (3..=if self.full { 12 } else { 4 }).map(|digits| 10_f64.powi(-digits)).collect()
    }

    /// A Weyl sequence over the open domain `(0, 2)`: no short addresses.
    fn points(&self) -> Vec<f64> {
        let count: u32 = if self.full { 4096 } else { 64 };
        (1..=count).map(|i| 2.0 * (f64::from(i) * 0.618_033_988_749_895).fract()).collect()
    }

    /// A camera that looks down at the middle of the square; about nine rays in ten hit.
    fn camera(&self, side: u32) -> Vec<Ray> {
        let side = if self.full { side } else { 3 };
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

    /// Nanoseconds of one of `count` calls: the least of many short turns, which other programs disturb least.
    fn time(&self, turns: u32, count: usize, mut run: impl FnMut()) -> f64 {
        let turns = if self.full { turns } else { 1 };
        let turn = |_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64() * 1e9 / count as f64
        };
        (0..turns).map(turn).fold(f64::INFINITY, f64::min)
    }
}

/// Lines of costs over one quantity.
struct Growth {
    title: &'static str,
    over: &'static str,
    at: Vec<f64>,
    lines: Vec<(String, Vec<f64>)>,
}

impl Growth {
    fn new(title: &'static str, over: &'static str, at: Vec<f64>) -> Self {
        Self { title, over, at, lines: Vec::new() }
    }

    fn line(&mut self, name: &str, cost: impl FnMut(f64) -> f64) {
        self.lines.push((name.to_owned(), self.at.iter().copied().map(cost).collect()));
    }

    /// A table in Markdown with the slopes.
    fn markdown(&self) -> String {
        let mut text = format!("## {}\n\n| {} |", self.title, self.over);
        let count = |x: f64| if x < 1.0 { format!("{x:.0e}") } else { format!("{x}") };
        self.at.iter().for_each(|&x| write!(text, " {} |", count(x)).expect("a string grows"));
        write!(text, " slope |\n|---|{}---|\n", "---|".repeat(self.at.len())).expect("a string grows");
        for (name, costs) in &self.lines {
            write!(text, "| {name} |").expect("a string grows");
            costs.iter().for_each(|cost| {
                write!(text, " {cost:.0$} |", usize::from(*cost < 100.0)).expect("a string grows");
            });
            writeln!(text, " {:+.3} |", self.slope(costs)).expect("a string grows");
        }
        text + "\n"
    }

    /// Of the line of least squares through the logarithms; against `1/x` where the quantity is a tolerance.
    fn slope(&self, costs: &[f64]) -> f64 {
        let sign = if self.at.first() > self.at.last() { -1.0 } else { 1.0 };
        let points = || self.at.iter().zip(costs).map(|(x, y)| (sign * x.ln(), y.ln()));
        let n = self.at.len() as f64;
        let (sx, sy) = points().fold((0.0, 0.0), |(sx, sy), (x, y)| (sx + x, sy + y));
        let (x0, y0) = (sx / n, sy / n);
        let (xy, xx) = points()
            .fold((0.0, 0.0), |(xy, xx), (x, y)| (xy + (x - x0) * (y - y0), xx + (x - x0) * (x - x0)));
        xy / xx
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let ship = arguments.iter().skip_while(|a| *a != "--ship").nth(1);
    let effort = Effort { full: arguments.iter().any(|a| a == "--bench") };
    let growths = [values(&effort), jets(&effort), builds(&effort), rays(&effort), cells(&effort)];
    let mut text = format!(
        "# Growth of cost of fractal interpolation functions\n\nOne thread of {}; the least of many short turns, in nanoseconds a value, a \
         jet, a ray or a table. The slope is that of the line of least squares through the logarithms of cost and of one over the tolerance, or of \
         cells. f, g and their integrals are the source's. `cargo bench -p asperity-fif --bench tolerance -- --ship docs/bench/fif.md` makes this page.\n\n",
        processor()
    );
    growths.iter().for_each(|growth| text += &growth.markdown());
    text += &rough(&effort);
    std::io::stdout().write_all(text.as_bytes()).expect("standard output takes text");
    if let Some(file) = ship {
        // Written beside and renamed, so that the page is whole or the old one.
        let part = format!("{file}.part");
        std::fs::write(&part, text)
            .and_then(|()| std::fs::rename(part, file))
            .expect("the page can be written");
    }
}

fn curves() -> [FixedFif<2, 3>; 2] {
    [paper::f_hat(), paper::g_hat()].map(|f| f.expect("the source's system is valid"))
}

fn values(effort: &Effort) -> Growth {
    let mut growth = Growth::new("Values", "ns, to", effort.tolerances());
    let points = effort.points();
    let [f, g] = [paper::f(), paper::g()].map(|f| f.expect("the source's system is valid"));
    for (name, f) in [("f", &f), ("g", &g)] {
        growth.line(&format!("{name}, `evaluate`"), |tolerance| {
            effort.time(40, points.len(), || {
                black_box(points.iter().map(|&x| f.evaluate(x, tolerance).value).sum::<f64>());
            })
        });
        tables(effort, &mut growth, name, f);
    }
    SMOOTH.into_iter().zip(curves()).for_each(|(name, f)| tables(effort, &mut growth, name, &f));
    growth
}

/// One by one and many, in both precisions.
fn tables<const C: usize>(effort: &Effort, growth: &mut Growth, name: &str, f: &FixedFif<2, C>) {
    let points = effort.points();
    let narrow: Vec<f32> = points.iter().map(|&x| x as f32).collect();
    let (mut out, mut narrow_out) = (vec![0.0; points.len()], vec![0.0; points.len()]);
    let table = |tolerance: f64| f.table(tolerance).expect("gentle factors");
    growth.line(&format!("{name}, `Table::value`"), |tolerance| {
        let table = table(tolerance);
        effort.time(400, points.len(), || {
            black_box(points.iter().map(|&x| table.value(x)).sum::<f64>());
        })
    });
    growth.line(&format!("{name}, `Table::values`"), |tolerance| {
        let table = table(tolerance);
        effort.time(400, points.len(), || table.values(black_box(&points), &mut out).expect("one length"))
    });
    growth.line(&format!("{name}, `Table32::value`"), |tolerance| {
        let table = table(tolerance).to_f32();
        effort.time(400, points.len(), || {
            black_box(narrow.iter().map(|&x| table.value(x)).sum::<f32>());
        })
    });
    growth.line(&format!("{name}, `Table32::values`"), |tolerance| {
        let table = table(tolerance).to_f32();
        effort.time(400, points.len(), || {
            table.values(black_box(&narrow), &mut narrow_out).expect("one length");
        })
    });
}

fn jets(effort: &Effort) -> Growth {
    let mut growth = Growth::new("Value, slope and integral", "ns, to", effort.tolerances());
    let points = effort.points();
    let [mut value, mut slope, mut integral] = [0; 3].map(|_| vec![0.0; points.len()]);
    for (name, f) in SMOOTH.into_iter().zip(curves()) {
        growth.line(&format!("{name}, `jet`"), |tolerance| {
            let table = f.table(tolerance).expect("gentle factors");
            let sum = |jet: Jet| jet.value + jet.slope + jet.integral;
            effort.time(200, points.len(), || {
                black_box(points.iter().map(|&x| sum(table.jet(x))).sum::<f64>());
            })
        });
        growth.line(&format!("{name}, `jets`"), |tolerance| {
            let table = f.table(tolerance).expect("gentle factors");
            effort.time(200, points.len(), || {
                let out: Jet<&mut [f64]> =
                    Jet { value: &mut value, slope: &mut slope, integral: &mut integral };
                table.jets(black_box(&points), out).expect("one length");
            })
        });
    }
    growth
}

fn builds(effort: &Effort) -> Growth {
    let mut growth = Growth::new("Making a table", "ns, to", effort.tolerances());
    let rough = paper::g().expect("the source's system is valid");
    growth.line("g", |tolerance| effort.time(50, 1, || drop(black_box(rough.table(tolerance)))));
    for (name, f) in SMOOTH.into_iter().zip(curves()) {
        growth.line(name, |tolerance| effort.time(50, 1, || drop(black_box(f.table(tolerance)))));
    }
    growth
}

/// Nanoseconds a ray, by parts of a turn short enough that most are not disturbed.
fn by_parts(effort: &Effort, turns: u32, part: usize, rays: &[Ray], mut trace: impl FnMut(&[Ray])) -> f64 {
    let parts = rays.chunks(part);
    let times =
        parts.map(|rays| rays.len() as f64 * effort.time(turns, rays.len(), || trace(black_box(rays))));
    times.sum::<f64>() / rays.len() as f64
}

fn first_hits(effort: &Effort, part: usize, surface: &impl Intersect, rays: &[Ray], tolerance: f64) -> f64 {
    let mut hits: Vec<Option<Hit>> = vec![None; part];
    by_parts(effort, 30, part, rays, |rays| {
        surface.first_hits(rays, ALL, tolerance, &mut hits[..rays.len()]).expect("one length");
    })
}

fn rays(effort: &Effort) -> Growth {
    let mut growth = Growth::new("First hits of primary rays, in a batch", "ns, to", effort.tolerances());
    let rays = effort.camera(64);
    for (name, f) in SMOOTH.into_iter().zip(curves()) {
        let surface = HeightField::new(f, f).tabulated();
        growth.line(name, |tolerance| first_hits(effort, 4096, &surface, &rays, tolerance));
    }
    let z: [f64; 16] = core::array::from_fn(|k| ((7 * k) % 16) as f64 / 16.0);
    let d: [[f64; 2]; 16] = core::array::from_fn(|k| [((5 * k) % 16) as f64 / 8.0 - 1.0, 0.25 * z[15 - k]]);
    let torus = Torus::new(4, [[2, -1], [1, 2]], 0.375, &z, &d).expect("a valid torus").tabulated();
    let rays: Vec<Ray> = effort
        .camera(16)
        .into_iter()
        .map(|ray| Ray { origin: 0.5 * ray.origin, direction: 0.5 * ray.direction })
        .collect();
    growth.line("torus of 4 × 4 nodes", |tolerance| first_hits(effort, 16, &torus, &rays, tolerance));
    growth
}

fn cells(effort: &Effort) -> Growth {
    let mut growth = Growth::new(
        "Cells of a height field's tables",
        "cells",
        if effort.full { vec![16.0, 64.0, 256.0, 1024.0, 4096.0] } else { vec![4.0, 16.0] },
    );
    let (rays, [f, _]) = (effort.camera(32), curves());
    let with = |cells: f64| HeightField::new(f, f).tabulated_with(cells as usize);
    growth.line("bytes, both axes", |cells| {
        let surface = with(cells);
        (surface.x.bytes() + surface.y.bytes()) as f64
    });
    growth.line("ns to make them", |cells| effort.time(10, 1, || drop(black_box(with(cells)))));
    growth
        .line("ns a ray to 1e-4, integral of f", |cells| first_hits(effort, 1024, &with(cells), &rays, 1e-4));
    let rough = paper::f().expect("the source's system is valid");
    growth.line("ns a ray, f itself", |cells| {
        let surface = HeightField::new(rough, rough).tabulated_with(cells as usize);
        first_hits(effort, 32, &surface, &rays, 0.0)
    });
    growth
}

/// Rays on surfaces that are only continuous, all misses proven.
fn rough(effort: &Effort) -> String {
    let mut text = String::from(
        "## Primary rays on rough surfaces\n\n| | first hits a second | of these certain | `hits_any` a second |\n|---|---|---|---|\n",
    );
    for (name, f, side, part) in [("f", paper::f(), 48, 32), ("g", paper::g(), 16, 2)] {
        let f = f.expect("the source's system is valid");
        let (surface, rays) = (HeightField::new(f, f).tabulated(), effort.camera(side));
        let mut hits: Vec<Option<Hit>> = Vec::new();
        let first = by_parts(effort, 10, part, &rays, |rays| {
            hits = rays.iter().map(|ray| surface.first_hit(ray)).collect();
        });
        hits = rays.iter().map(|ray| surface.first_hit(ray)).collect();
        let any = by_parts(effort, 10, part, &rays, |rays| {
            black_box(rays.iter().filter(|ray| surface.hits_any(ray, ALL)).count());
        });
        let certain = hits.iter().flatten().filter(|hit| hit.certain).count() as f64;
        let part = certain / hits.iter().flatten().count() as f64;
        let (first, any) = (1e9 / first, 1e9 / any);
        writeln!(
            text,
            "| {name}×{name}, {} rays | {first:.0} | {:.0} % | {any:.0} |",
            rays.len(),
            100.0 * part
        )
        .expect("a string grows");
    }
    text
}

fn processor() -> String {
    let file = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = file.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    name.map_or_else(|| "an unknown processor".into(), |(_, name)| name.into())
}
