//! Gaussian noise, its two channels at once, and its octaves.

#[allow(dead_code, reason = "each bench uses some of the forms")]
mod forms;

use asperity_noise::{
    Gaussian, GaussianOctaves, Spectrum,
    glam::{Vec2, Vec3},
};
use criterion::{Criterion, criterion_group, criterion_main};
use forms::{calls, configuration, every_form};

fn gaussian(criterion: &mut Criterion) {
    let noise = Gaussian::default();
    every_form(criterion, "gaussian", noise);
    calls(criterion, "pair", 2, "gaussian", |i| noise.pair(line(i).truncate(), 1));
    calls(criterion, "pair", 3, "gaussian", |i| noise.pair(line(i), 1));

    let plane = GaussianOctaves::<2>::new(Spectrum::default(), 1);
    let space = GaussianOctaves::<3>::new(Spectrum::default(), 1);
    calls(criterion, "sample", 2, "gaussian-octaves-8", |i| plane.sample::<Vec2>(line(i).truncate(), 8.0));
    calls(criterion, "sample", 3, "gaussian-octaves-8", |i| space.sample::<Vec3>(line(i), 8.0));
    calls(criterion, "pair", 2, "gaussian-octaves-8", |i| plane.pair::<Vec2>(line(i).truncate(), 8.0));
    calls(criterion, "pair", 3, "gaussian-octaves-8", |i| space.pair::<Vec3>(line(i), 8.0));
}

/// Points along a line that crosses a border of cells every few steps, as a scan line of a picture does.
fn line(i: usize) -> Vec3 {
    let t = i as f32;
    Vec3::new(0.3 + 0.21 * t, -7.0 + 0.17 * t, 2.0 - 0.13 * t)
}

criterion_group! { name = benches; config = configuration(); targets = gaussian }
criterion_main!(benches);
