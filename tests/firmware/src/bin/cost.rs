//! One function alone, chosen by a feature, with the stack that its call takes.
#![no_std]
#![no_main]

use core::hint::black_box;

use asperity_firmware::{hexadecimal, stack};
use cortex_m_rt::entry;
use cortex_m_semihosting::{
    debug::{self, EXIT_FAILURE, EXIT_SUCCESS},
    hio,
};
use panic_halt as _;

#[entry]
fn main() -> ! {
    let depth = stack::depth(&mut || {
        black_box(function());
    });
    let said = hio::hstderr().is_ok_and(|mut err| {
        [&b"stack "[..], &hexadecimal(depth as u32), b"\n"].iter().all(|part| err.write_all(part).is_ok())
    });
    debug::exit(if said { EXIT_SUCCESS } else { EXIT_FAILURE });
    // Not reached in an emulator.
    loop {}
}

/// The function that is measured; nothing without a feature.
#[inline(never)]
#[allow(unreachable_code, unused_imports, unused_variables, reason = "one feature at a time")]
fn function() -> Option<[f32; 3]> {
    use asperity_fif::{HeightField, Intersect, Ray, glam::DVec3};
    use asperity_firmware::{bumps, clay, curve, normals};
    use asperity_ndf_sampling::{Ggx, Ndf};
    use asperity_noise::{Cellular, Field, Gaussian, GaussianOctaves, Perlin2002, Simplex, Spectrum};
    use asperity_shading::glam::{Vec2, Vec3};
    use asperity_shading::{Brdf, Footprint, LevelOfDetail};

    let p = black_box(Vec3::new(0.3, -4.2, 7.9));
    let z = black_box(Vec2::new(0.7, -1.1));
    let m = black_box(Vec3::new(0.0, 0.6, 0.8));
    #[cfg(feature = "perlin")]
    return Some(Perlin2002::new(7).sample(p).gradient.to_array());
    #[cfg(feature = "simplex")]
    return Some(Simplex::new(7).sample(p).gradient.to_array());
    #[cfg(feature = "cellular")]
    return Some(Cellular::new(7).sample(p).gradient.to_array());
    #[cfg(feature = "gaussian")]
    return Some(Gaussian::new(7).sample(p).gradient.to_array());
    #[cfg(feature = "gaussian-octaves")]
    return Some(
        GaussianOctaves::<3>::new(Gaussian::new(7), Spectrum::default())
            .detail(4.5)
            .sample(p)
            .gradient
            .to_array(),
    );
    #[cfg(feature = "ggx-normal")]
    return Some(Ggx::new(0.2, 0.4).ok()?.from_gaussian(z).to_array());
    #[cfg(feature = "ggx-density")]
    return Some([Ggx::new(0.2, 0.4).ok()?.density(m); 3]);
    #[cfg(feature = "packed-normal")]
    return Some(normals()?.from_gaussian(z).to_array());
    #[cfg(feature = "exact-radiance")]
    return {
        let seen = bumps()?.coordinates(p, Footprint::from_width(0.02));
        Some([LevelOfDetail::Exact.radiance(&Ggx::new(0.2, 0.4).ok()?, m, seen); 3])
    };
    #[cfg(feature = "oren-nayar")]
    return Some(clay()?.value(m, Vec3::Z).to_array());
    #[cfg(feature = "fif-value")]
    return Some([curve()?.evaluate(f64::from(p.z) * 0.5, 1e-6).value as f32; 3]);
    #[cfg(feature = "height-field-normal")]
    return {
        // Integrals have slopes.
        let smooth: asperity_fif::FixedFif<5, 3> = curve()?.integral(0.0).ok()?;
        Some(HeightField::new(smooth, smooth).normal(f64::from(p.z) * 0.5, 2.0)?.as_vec3().to_array())
    };
    #[cfg(feature = "height-field-hit")]
    return {
        let field = HeightField::new(curve()?, curve()?);
        let ray = Ray { origin: DVec3::new(3.0, 2.0, 9.0), direction: m.as_dvec3() * -1.0 };
        Some([field.first_hit(&ray)?.t as f32; 3])
    };
    None
}
