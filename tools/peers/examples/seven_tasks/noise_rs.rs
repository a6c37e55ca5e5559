//! `noise` 0.9: `f64`; nested generators.

use std::{array::from_fn, f64::consts::TAU};

use asperity_noise::glam::Vec3;
use noise::{
    Fbm, NoiseFn, Perlin, RidgedMulti, Seedable, Simplex, Turbulence,
    utils::{NoiseMap, NoiseMapBuilder, PlaneMapBuilder},
};

pub(crate) fn heightmap(heights: &mut [f64; 64 * 64]) {
    let noise = Fbm::<Perlin>::new(42);
    *heights = from_fn(|i| noise.get([(i % 64) as f64 * 0.05, (i / 64) as f64 * 0.05]));
}

/// A map, not a field: four copies are blended, so the center of the tile has half the contrast of
/// its corners.
pub(crate) fn tileable_fbm() -> NoiseMap {
    let map = PlaneMapBuilder::<_, 3>::new(Fbm::<Perlin>::new(42)).set_is_seamless(true);
    map.set_x_bounds(0.0, 8.0).set_y_bounds(0.0, 8.0).build()
}

pub(crate) fn domain_warp() -> impl NoiseFn<f64, 2> {
    Turbulence::<_, Perlin>::new(Fbm::<Perlin>::new(1)).set_power(0.3).set_roughness(6).set_seed(100)
}

pub(crate) fn ridged() -> impl NoiseFn<f64, 2> {
    RidgedMulti::<Simplex>::new(42)
}

pub(crate) fn loop_in_4d([x, y]: [f64; 2], turn: f64) -> f64 {
    let (sin, cos) = (turn * TAU).sin_cos();
    Simplex::new(42).get([x, y, cos, sin])
}

/// Finite differences. Simplex noise has derivatives in the module `core`, but in 0.9.0 the 2-D
/// derivatives do not match its values.
pub(crate) fn normals(normals: &mut [Vec3; 32 * 32]) {
    let noise = Perlin::new(42);
    *normals = from_fn(|i| {
        let (x, y, h) = ((i % 32) as f64 * 0.1, (i / 32) as f64 * 0.1, 0.01);
        let f = |x, y| noise.get([x, y]) as f32;
        Vec3::new(f(x - h, y) - f(x + h, y), f(x, y - h) - f(x, y + h), 2.0 * h as f32).normalize()
    });
}

pub(crate) fn unit_value(p: [f64; 2]) -> f64 {
    (0.5 + 0.5 * Fbm::<Perlin>::new(42).get(p)).clamp(0.0, 1.0)
}
