//! Seven tasks, one function each, and a line of numbers for each:
//! `cargo run --example seven_tasks`.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_noise::{
    Fbm, FbmSpectrum, Field, Grid, Perlin, Ridged, Sample, Simplex, Warp,
    glam::{Vec2, Vec3, Vec4},
    ops::Unit,
};

fn heightmap(heights: &mut [f32; 64 * 64]) {
    let noise = Fbm::new(Perlin::new(42), FbmSpectrum::default());
    let grid = Grid { origin: Vec2::ZERO, step: Vec2::splat(0.05), size: [64, 64] };
    noise.grid_values(&grid, heights).expect("a height for each point");
}

fn tileable_fbm() -> impl Field<Vec2> {
    let fbm = Fbm::new(Perlin::new(42), FbmSpectrum::CLOUD);
    fbm.tiled([8, 8]).expect("periods that lacunarity 2 keeps")
}

fn domain_warp() -> impl Field<Vec2> {
    let fbm = |seed| Fbm::new(Perlin::new(seed), FbmSpectrum::default());
    Warp::new(fbm(1), [fbm(2), fbm(3)], 0.3).expect("a finite strength")
}

fn ridged() -> impl Field<Vec2> {
    Fbm::new(Simplex::new(42), FbmSpectrum::default()).with_shape(Ridged)
}

fn loop_in_4d(p: Vec2, turn: f32) -> f32 {
    let (sin, cos) = (turn * std::f32::consts::TAU).sin_cos();
    Simplex::new(42).value(Vec4::new(p.x, p.y, cos, sin))
}

fn normals(normals: &mut [Vec3; 32 * 32]) {
    let points: [Vec2; 32 * 32] = std::array::from_fn(|i| Vec2::new((i % 32) as f32, (i / 32) as f32) * 0.1);
    let mut samples = [Sample::default(); 32 * 32];
    Perlin::new(42).samples(&points, &mut samples).expect("a sample for each point");
    *normals = samples.map(|sample| (-sample.gradient).extend(1.0).normalize());
}

fn unit_value(p: Vec2) -> f32 {
    Unit(Fbm::new(Perlin::new(42), FbmSpectrum::default())).value(p)
}

fn main() {
    let (p, mut heights, mut up) = (Vec2::new(0.3, 1.7), [0.0; 64 * 64], [Vec3::ZERO; 32 * 32]);
    heightmap(&mut heights);
    normals(&mut up);
    println!("heightmap     {:?}", heights.iter().fold([0.0_f32; 2], |[a, b], h| [a.min(*h), b.max(*h)]));
    let tiles = [p, p + Vec2::new(8.0, -16.0)].map(|p| tileable_fbm().value(p));
    println!("tileable fBm  {tiles:?}");
    println!("domain warp   {:?}", domain_warp().sample(p));
    println!("ridged        {:?}", ridged().value(p));
    println!("4-D loop      {:?}", [0.0, 0.25, 0.5, 0.75, 1.0].map(|turn| loop_in_4d(p, turn)));
    println!("normals       {}", up[33]);
    println!("in [0, 1]     {}", unit_value(p));
}
