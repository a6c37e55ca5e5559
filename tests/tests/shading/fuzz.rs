//! Fuzz: property tests, and albedos compared with integrals.

use asperity_shading::check;
use asperity_shading::glam::Vec3;
use asperity_shading::reflectance::{CharlieSheen, ZeltnerFuzz, directional_albedo};

use crate::checked::quick;

const VALID: &str = "in range";

fn view(z: f32) -> Vec3 {
    Vec3::new(0.6 * (1.0 - z * z).sqrt(), -0.8 * (1.0 - z * z).sqrt(), z)
}

#[test]
fn fuzz_passes_the_checks() {
    for (k, alpha) in [0.07, 0.15, 0.3, 0.6, 1.0].into_iter().enumerate() {
        let charlie = check::brdf(&CharlieSheen::new(Vec3::ONE, alpha).expect(VALID), quick(k as u32));
        assert!(charlie.passed(), "{alpha}: {charlie}");
        let zeltner = check::brdf(&ZeltnerFuzz::new(Vec3::ONE, alpha).expect(VALID), quick(9 + k as u32));
        assert!(zeltner.failures().all(|name| name == "reciprocity"), "{alpha}: {zeltner}");
    }
}

#[test]
fn fuzz_albedos_are_the_integrals() {
    let (mut worst, color) = ([0.0_f32; 2], Vec3::new(1.0, 0.5, 0.2));
    for alpha in [0.07, 0.08, 0.12, 0.2, 0.35, 0.5, 0.75, 0.93, 1.0] {
        let charlie = CharlieSheen::new(color, alpha).expect(VALID);
        let zeltner = ZeltnerFuzz::new(color, alpha).expect(VALID);
        for z in [0.002, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0] {
            let error = (charlie.albedo(z) - directional_albedo(&charlie, view(z), 1 << 15)).abs();
            worst[0] = worst[0].max(error.max_element());
            let error = (zeltner.albedo(z) - directional_albedo(&zeltner, view(z), 1 << 8)).abs();
            worst[1] = worst[1].max(error.max_element());
            assert!((charlie.transmittance(z) - (1.0 - charlie.albedo(z).x)).abs() < 1e-6);
            assert!((zeltner.transmittance(z) - (1.0 - zeltner.albedo(z).x)).abs() < 1e-6);
        }
    }
    println!("{worst:?}");
    assert!(worst[0] < 2e-3 && worst[1] < 1e-5, "{worst:?}");
}

#[test]
fn fuzz_parameters_are_checked() {
    for bad in [f32::NAN, 0.0, 1.1] {
        assert!(CharlieSheen::new(Vec3::ONE, bad).is_err() && ZeltnerFuzz::new(Vec3::ONE, bad).is_err());
        let color = Vec3::new(0.5, bad - 0.1 * f32::from(u8::from(bad == 0.0)), 1.0);
        assert!(CharlieSheen::new(color, 0.5).is_err() && ZeltnerFuzz::new(color, 0.5).is_err());
    }
    assert!(CharlieSheen::new(Vec3::ONE, 0.06).is_err() && ZeltnerFuzz::new(Vec3::ONE, 0.01).is_ok());
    for z in [f32::NAN, f32::NEG_INFINITY, 0.0, 2.0] {
        assert!((0.0..=1.0).contains(&CharlieSheen::new(Vec3::ONE, 0.3).expect(VALID).albedo(z).x));
        assert!((0.0..=1.0).contains(&ZeltnerFuzz::new(Vec3::ONE, 0.3).expect(VALID).albedo(z).x));
    }
}
