//! The seven tasks of `crates/noise/examples/seven_tasks.rs` with three other libraries.
//! `cargo run --example seven_tasks` prints the number of lines of each body, and the result of
//! each function.

mod fastnoise_lite;
mod noise_functions;
mod noise_rs;

use ::noise::NoiseFn as _;
use ::noise_functions::Noise as _;
use asperity_noise::glam::Vec3;

const TASKS: [&str; 7] =
    ["heightmap", "tileable_fbm", "domain_warp", "ridged", "loop_in_4d", "normals", "unit_value"];

const SOURCES: [(&str, &str); 4] = [
    ("asperity-noise", include_str!("../../../../crates/noise/examples/seven_tasks.rs")),
    ("noise", include_str!("noise_rs.rs")),
    ("fastnoise-lite", include_str!("fastnoise_lite.rs")),
    ("noise-functions", include_str!("noise_functions.rs")),
];

/// Returns the number of nonblank lines of a function's body, between its signature and the brace
/// below its `fn`.
fn body_lines(source: &str, function: &str) -> usize {
    let signature = format!("fn {function}(");
    let body = source.lines().skip_while(|line| !line.contains(&signature)).skip(1);
    body.take_while(|&line| line != "}").filter(|line| !line.trim().is_empty()).count()
}

fn main() {
    println!("| body lines |{}", SOURCES.map(|(name, _)| format!(" `{name}` |")).concat());
    println!("|---|{}", "--:|".repeat(SOURCES.len()));
    for task in TASKS {
        let lines = SOURCES.map(|(_, source)| format!(" {} |", body_lines(source, task)));
        println!("| `{task}` |{}", lines.concat());
    }
    let sums = SOURCES.map(|(_, source)| TASKS.map(|task| body_lines(source, task)).iter().sum::<usize>());
    println!("| all |{}", sums.map(|sum| format!(" {sum} |")).concat());
    noise_rs_values();
    fastnoise_lite_values();
    noise_functions_values();
}

fn noise_rs_values() {
    let (p, mut heights, mut normals) = ([0.3, 1.7], [0.0; 64 * 64], [Vec3::ZERO; 32 * 32]);
    noise_rs::heightmap(&mut heights);
    noise_rs::normals(&mut normals);
    let (map, [warped, ridged]) =
        (noise_rs::tileable_fbm(), [noise_rs::domain_warp().get(p), noise_rs::ridged().get(p)]);
    let turns = [0.0, 0.5, 1.0].map(|turn| noise_rs::loop_in_4d(p, turn));
    let unit = noise_rs::unit_value(p);
    println!("\nnoise: {} {} {warped} {ridged} {turns:?} {} {unit}", heights[99], map[(4, 21)], normals[33]);
}

fn fastnoise_lite_values() {
    let ([x, y], mut heights, mut normals) = ([0.3, 1.7], [0.0; 64 * 64], [Vec3::ZERO; 32 * 32]);
    fastnoise_lite::heightmap(&mut heights);
    fastnoise_lite::normals(&mut normals);
    let tiles = [0.0, 8.0].map(|d| fastnoise_lite::tileable_fbm()(x + d, y - d));
    let [warped, ridged] = [fastnoise_lite::domain_warp()(x, y), fastnoise_lite::ridged().get_noise_2d(x, y)];
    let turns = [0.0, 0.5, 1.0].map(|turn| fastnoise_lite::loop_in_4d([x, y], turn));
    let unit = fastnoise_lite::unit_value([x, y]);
    println!("fastnoise-lite: {} {tiles:?} {warped} {ridged} {turns:?} {} {unit}", heights[99], normals[33]);
}

fn noise_functions_values() {
    let (p, mut heights, mut normals) = ([0.3, 1.7], [0.0; 64 * 64], [Vec3::ZERO; 32 * 32]);
    noise_functions::heightmap(&mut heights);
    noise_functions::normals(&mut normals);
    let tiles = [0.0, 8.0].map(|d| noise_functions::tileable_fbm().sample2([p[0] + d, p[1] - d]));
    let [warped, ridged] = [noise_functions::domain_warp().sample2(p), noise_functions::ridged().sample2(p)];
    let turns = [0.0, 0.5, 1.0].map(|turn| noise_functions::loop_in_4d(p, turn));
    let unit = noise_functions::unit_value(p);
    println!("noise-functions: {} {tiles:?} {warped} {ridged} {turns:?} {} {unit}", heights[99], normals[33]);
}
