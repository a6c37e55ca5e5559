//! The functions selected by features, alone or all together, with the stack used by their calls.
#![no_std]
#![no_main]
#![allow(dead_code, unused_imports, reason = "those of other features")]

use core::hint::black_box;

use asperity_fif::{FixedFif, HeightField, Intersect, Ray, glam::DVec3};
use asperity_firmware::{bumps, clay, curve, hexadecimal, normals, stack};
use asperity_ndf_sampling::{Ggx, Ndf};
use asperity_noise::{Cellular, FbmSpectrum, Field, GaussianFbm, GaussianNoise, Perlin, Simplex};
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{Brdf, Footprint, Frame, LevelOfDetail};
use cortex_m_rt::entry;
use cortex_m_semihosting::{
    debug::{self, EXIT_FAILURE, EXIT_SUCCESS},
    hio,
};
use panic_halt as _;

#[entry]
fn main() -> ! {
    let depth = stack::depth(&mut || {
        for probe in PROBES {
            black_box(probe());
        }
    });
    let said = hio::hstderr().is_ok_and(|mut err| {
        [&b"stack "[..], &hexadecimal(depth as u32), b"\n"].iter().all(|part| err.write_all(part).is_ok())
    });
    debug::exit(if said { EXIT_SUCCESS } else { EXIT_FAILURE });
    // Not reached in an emulator.
    loop {}
}

/// The functions of the features.
const PROBES: &[fn() -> Option<[f32; 3]>] = &[
    #[cfg(feature = "perlin")]
    perlin,
    #[cfg(feature = "simplex")]
    simplex,
    #[cfg(feature = "cellular")]
    cellular,
    #[cfg(feature = "gaussian")]
    gaussian,
    #[cfg(feature = "gaussian-octaves")]
    gaussian_octaves,
    #[cfg(feature = "ggx-normal")]
    ggx_normal,
    #[cfg(feature = "ggx-density")]
    ggx_density,
    #[cfg(feature = "packed-normal")]
    packed_normal,
    #[cfg(feature = "exact-radiance")]
    exact_radiance,
    #[cfg(feature = "oren-nayar")]
    oren_nayar,
    #[cfg(feature = "fif-value")]
    fif_value,
    #[cfg(feature = "height-field-normal")]
    height_field_normal,
    #[cfg(feature = "height-field-hit")]
    height_field_hit,
];

fn place() -> Vec3 {
    black_box(Vec3::new(0.3, -4.2, 7.9))
}

fn gaussian_pair() -> Vec2 {
    black_box(Vec2::new(0.7, -1.1))
}

fn facet() -> Vec3 {
    black_box(Vec3::new(0.0, 0.6, 0.8))
}

fn perlin() -> Option<[f32; 3]> {
    Some(Perlin::new(7).sample(place()).gradient.to_array())
}

fn simplex() -> Option<[f32; 3]> {
    Some(Simplex::new(7).sample(place()).gradient.to_array())
}

fn cellular() -> Option<[f32; 3]> {
    Some(Cellular::new(7).sample(place()).gradient.to_array())
}

fn gaussian() -> Option<[f32; 3]> {
    Some(GaussianNoise::new(7).sample(place()).gradient.to_array())
}

fn gaussian_octaves() -> Option<[f32; 3]> {
    let octaves = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::default());
    Some(octaves.sample_with_octaves(place(), 4.5).gradient.to_array())
}

fn ggx_normal() -> Option<[f32; 3]> {
    Some(Ggx::new(0.2, 0.4).ok()?.warp_gaussian(gaussian_pair()).to_array())
}

fn ggx_density() -> Option<[f32; 3]> {
    Some([Ggx::new(0.2, 0.4).ok()?.d(facet()); 3])
}

fn packed_normal() -> Option<[f32; 3]> {
    Some(normals()?.warp_gaussian(gaussian_pair()).to_array())
}

fn exact_radiance() -> Option<[f32; 3]> {
    let seen = bumps()?.coordinates(place(), &Frame::IDENTITY, Footprint::from_width(0.02));
    Some([LevelOfDetail::Exact.radiance(&Ggx::new(0.2, 0.4).ok()?, facet(), seen); 3])
}

fn oren_nayar() -> Option<[f32; 3]> {
    Some(clay()?.eval(Vec3::Z, facet()).to_array())
}

fn fif_value() -> Option<[f32; 3]> {
    Some([curve()?.evaluate(f64::from(place().z) * 0.5, 1e-6).value as f32; 3])
}

fn height_field_normal() -> Option<[f32; 3]> {
    // Integrals have slopes.
    let smooth: FixedFif<5, 3> = curve()?.integral(0.0).ok()?;
    let field = HeightField::new(smooth, smooth);
    Some(field.normal(f64::from(place().z) * 0.5, 2.0)?.as_vec3().to_array())
}

fn height_field_hit() -> Option<[f32; 3]> {
    let field = HeightField::new(curve()?, curve()?);
    let ray = Ray { origin: DVec3::new(3.0, 2.0, 9.0), direction: facet().as_dvec3() * -1.0 };
    Some([field.intersect(&ray)?.t as f32; 3])
}
