//! `noise-functions` 0.8: `f32`; methods chained on stateless noises.

use std::{array::from_fn, f32::consts::TAU};

use asperity_noise::glam::Vec3;
use noise_functions::{Noise, Perlin, Sample, Simplex};

pub(crate) fn heightmap(heights: &mut [f32; 64 * 64]) {
    let noise = Perlin.fbm(6, 0.5, 2.0).seed(42).frequency(0.05);
    *heights = from_fn(|i| noise.sample2([(i % 64) as f32, (i / 64) as f32]));
}

/// 4-D noise on two circles, each twice as long as the tile, so that features are half as large.
pub(crate) fn tileable_fbm() -> impl Sample<2> {
    Perlin.fbm(6, 0.5, 2.0).tileable(8.0, 8.0).seed(42)
}

pub(crate) fn domain_warp() -> impl Sample<2> {
    let fbm = Perlin.fbm(6, 0.5, 2.0);
    fbm.seed(0).translate_xy(fbm.seed(100).mul(0.3), fbm.seed(200).mul(0.3))
}

pub(crate) fn ridged() -> impl Sample<2> {
    Simplex.ridged().fbm(6, 0.5, 2.0).seed(42)
}

pub(crate) fn loop_in_4d([x, y]: [f32; 2], turn: f32) -> f32 {
    let (sin, cos) = (turn * TAU).sin_cos();
    Simplex.seed(42).sample4([x, y, cos, sin])
}

/// It has no derivatives, so finite differences are used.
pub(crate) fn normals(normals: &mut [Vec3; 32 * 32]) {
    *normals = from_fn(|i| {
        let (x, y, h) = ((i % 32) as f32 * 0.1, (i / 32) as f32 * 0.1, 0.01);
        let f = |x, y| Perlin.seed(42).sample2([x, y]);
        Vec3::new(f(x - h, y) - f(x + h, y), f(x, y - h) - f(x, y + h), 2.0 * h).normalize()
    });
}

pub(crate) fn unit_value(p: [f32; 2]) -> f32 {
    (0.5 + 0.5 * Perlin.fbm(6, 0.5, 2.0).seed(42).sample2(p)).clamp(0.0, 1.0)
}
