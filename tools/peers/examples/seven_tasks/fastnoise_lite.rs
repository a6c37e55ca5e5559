//! `fastnoise-lite` 1.1: `f32`; one generator, configured by setters.

use std::array::from_fn;

use asperity_noise::glam::Vec3;
use fastnoise_lite::{FastNoiseLite, FractalType};

pub(crate) fn heightmap(heights: &mut [f32; 64 * 64]) {
    let mut noise = FastNoiseLite::with_seed(42);
    noise.set_frequency(Some(0.05));
    noise.set_fractal_type(Some(FractalType::FBm));
    *heights = from_fn(|i| noise.get_noise_2d((i % 64) as f32, (i / 64) as f32));
}

/// It has neither periods nor 4-D noise, so four copies are blended manually.
pub(crate) fn tileable_fbm() -> impl Fn(f32, f32) -> f32 {
    let mut noise = FastNoiseLite::with_seed(42);
    noise.set_frequency(Some(1.0));
    noise.set_fractal_type(Some(FractalType::FBm));
    move |x, y| {
        let (x, y) = (x.rem_euclid(8.0), y.rem_euclid(8.0));
        let row = |y| noise.get_noise_2d(x, y) * (1.0 - x / 8.0) + noise.get_noise_2d(x - 8.0, y) * (x / 8.0);
        row(y) * (1.0 - y / 8.0) + row(y - 8.0) * (y / 8.0)
    }
}

/// Two generators, because a warp with several octaves is a separate fractal type.
pub(crate) fn domain_warp() -> impl Fn(f32, f32) -> f32 {
    let mut warp = FastNoiseLite::with_seed(100);
    warp.set_frequency(Some(1.0));
    warp.set_fractal_type(Some(FractalType::DomainWarpIndependent));
    warp.set_domain_warp_amp(Some(0.3));
    let mut noise = FastNoiseLite::with_seed(1);
    noise.set_frequency(Some(1.0));
    noise.set_fractal_type(Some(FractalType::FBm));
    move |x, y| {
        let (x, y) = warp.domain_warp_2d(x, y);
        noise.get_noise_2d(x, y)
    }
}

pub(crate) fn ridged() -> FastNoiseLite {
    let mut noise = FastNoiseLite::with_seed(42);
    noise.set_frequency(Some(1.0));
    noise.set_fractal_type(Some(FractalType::Ridged));
    noise
}

/// It has no 4-D noise, so one path through 3-D noise is faded into another.
pub(crate) fn loop_in_4d([x, y]: [f32; 2], turn: f32) -> f32 {
    let mut noise = FastNoiseLite::with_seed(42);
    noise.set_frequency(Some(1.0));
    let turn = turn.rem_euclid(1.0);
    noise.get_noise_3d(x, y, turn) * (1.0 - turn) + noise.get_noise_3d(x, y, turn - 1.0) * turn
}

/// It has no derivatives, so finite differences are used.
pub(crate) fn normals(normals: &mut [Vec3; 32 * 32]) {
    let mut noise = FastNoiseLite::with_seed(42);
    noise.set_frequency(Some(1.0));
    *normals = from_fn(|i| {
        let (x, y, h) = ((i % 32) as f32 * 0.1, (i / 32) as f32 * 0.1, 0.01);
        let f = |x, y| noise.get_noise_2d(x, y);
        Vec3::new(f(x - h, y) - f(x + h, y), f(x, y - h) - f(x, y + h), 2.0 * h).normalize()
    });
}

pub(crate) fn unit_value([x, y]: [f32; 2]) -> f32 {
    let mut noise = FastNoiseLite::with_seed(42);
    noise.set_frequency(Some(1.0));
    noise.set_fractal_type(Some(FractalType::FBm));
    (0.5 + 0.5 * noise.get_noise_2d(x, y)).clamp(0.0, 1.0)
}
