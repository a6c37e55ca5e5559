//! Calls every crate, and compares each result with a value derived by hand.
#![no_std]

use asperity_fif::FixedFif;
use asperity_ndf_sampling::{Ggx, Ndf};
use asperity_noise::{FbmSpectrum, Field, GaussianFbm, GaussianNoise, Perlin};
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::{
    LevelOfDetail, far_field,
    glam::{Vec2, Vec3},
};

/// Provides the part of libc that a freestanding program lacks.
#[cfg(not(test))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Returns 0 if every crate's call gives the expected result, or the number of the first that does
/// not.
#[must_use]
pub fn run() -> i32 {
    let wrong = [noise, ndf_sampling, fif, shading, shaders].iter().position(|agrees| !agrees());
    wrong.map_or(0, |index| index as i32 + 1)
}

/// Perlin noise is 0 at lattice points. Unresolved Gaussian noise is 0, resolved noise is not.
fn noise() -> bool {
    let Ok(spectrum) = FbmSpectrum::new(2.17, 0.5, 8) else { return false };
    let field = GaussianFbm::new(GaussianNoise::new(1), spectrum);
    let p = Vec3::new(0.3, -4.2, 7.9);
    let [a, b] = field.pair_with_octaves(p, 4.5);
    Perlin::new(1).sample(Vec3::new(3.0, -2.0, 5.0)).value == 0.0
        && field.sample_with_octaves(p, 0.0).value == 0.0
        && a.value != b.value
        && a.value.is_finite()
}

/// The coordinates of a normal round-trip, and the peak of GGX is 1/(π αx αy).
fn ndf_sampling() -> bool {
    let Ok(ggx) = Ggx::new(0.2, 0.4) else { return false };
    let z = Vec2::new(0.7, -1.1);
    let back = ggx.invert(ggx.warp_gaussian(z)) - z;
    let peak = ggx.d(Vec3::Z) * core::f32::consts::PI * 0.08 - 1.0;
    back.x.abs() < 1e-4 && back.y.abs() < 1e-4 && peak.abs() < 1e-5
}

/// Takagi's function at one third of its period: f(2/3) = 4/3.
fn fif() -> bool {
    let Ok(f) = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], &[0.5, 0.5]) else {
        return false;
    };
    let value = f.evaluate(2.0 / 3.0, 1e-12).value - 4.0 / 3.0;
    value.abs() < 1e-9
}

/// In the far field both rules equal the density.
fn shading() -> bool {
    let Ok(ggx) = Ggx::new(0.2, 0.4) else { return false };
    let h = Vec3::new(0.0, 0.6, 0.8);
    let far = far_field(&ggx, h);
    let rules = [LevelOfDetail::Exact, LevelOfDetail::Fractal];
    far > 0.0 && rules.into_iter().all(|rule| rule.radiance(&ggx, h, ResolvedBumps::FAR) == far)
}

/// Sources are constants: a part lists its dependencies and defines its functions.
fn shaders() -> bool {
    let part = asperity_wgsl::noise::PERLIN;
    !part.needs().is_empty() && part.names().any(|name| name == "perlin_noise_3d")
}
