//! Maps from and to Gaussian coordinates, Φ and Φ⁻¹: reference values and inversion.

use asperity_ndf_sampling::{Beckmann, Ggx, Ndf, inverse_phi, phi};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::reference::{self, numbers, rows};
use glam::{Vec2, Vec3};
use proptest::prelude::*;

#[test]
fn gaussian_maps_equal_the_reference() {
    let reference = reference::read("ndf/sampling_maps.json");
    let points = rows(&reference["z"]);
    let (mut worst, mut compared) = (0.0_f32, 0);
    for item in reference["items"].as_array().unwrap() {
        let alpha = |name: &str| item[name].as_f64().unwrap_or(f64::NAN) as f32;
        let ndf: Box<dyn Ndf> = match item["model"].as_str().unwrap() {
            "ggx" => Box::new(Ggx::new(alpha("alpha_x"), alpha("alpha_y")).unwrap()),
            "beckmann" => Box::new(Beckmann::new(alpha("alpha_x"), alpha("alpha_y")).unwrap()),
            _ => continue,
        };
        for (z, m) in points.iter().zip(rows(&item["radial_from_gaussian"])) {
            let z = Vec2::new(z[0] as f32, z[1] as f32);
            let expected = Vec3::new(m[0] as f32, m[1] as f32, m[2] as f32);
            let got = ndf.from_gaussian(z);
            // Every component to its own relative error: small slopes and small cosines keep their digits.
            for (got, expected) in got.to_array().into_iter().zip(expected.to_array()) {
                let error = if expected == 0.0 { got.abs() } else { (got / expected - 1.0).abs() };
                worst = worst.max(error);
                assert!(error < 2e-6, "{item:?} at {z}: {got:e} != {expected:e}", item = item["model"]);
            }
            assert_abs_diff_eq!(
                ndf.to_gaussian(expected),
                z,
                epsilon = 4e-6,
                "{z}: {}",
                ndf.to_gaussian(expected)
            );
            compared += 1;
        }
    }
    println!("worst relative error of T: {worst:e} over {compared} points");
    assert!(compared >= 120, "{compared}");
}

#[test]
fn phi_and_its_inverse_equal_the_reference() {
    let reference = reference::read("ndf/gaussian.json");
    let pairs = |x: &str, y: &str| numbers(&reference[x]).into_iter().zip(numbers(&reference[y]));
    let mut worst = [0.0_f64; 2];
    for (z, expected) in pairs("z", "Phi") {
        let error = (phi(z) / expected - 1.0).abs();
        worst[0] = worst[0].max(error);
        assert!(error < 2e-15, "Φ({z}) = {:e} != {expected:e}", phi(z));
    }
    for (u, expected) in pairs("u", "Phi_inv") {
        let error = (inverse_phi(u) - expected).abs() / expected.abs().max(1.0);
        worst[1] = worst[1].max(error);
        assert!(error < 4e-15, "Φ⁻¹({u}) = {} != {expected}", inverse_phi(u));
    }
    println!("worst errors of Φ and Φ⁻¹: {worst:?}");
}

/// Both densities of the roughnesses.
fn both(alpha_x: f32, alpha_y: f32) -> [Box<dyn Ndf>; 2] {
    [
        Box::new(Ggx::new(alpha_x, alpha_y).expect("valid")),
        Box::new(Beckmann::new(alpha_x, alpha_y).expect("valid")),
    ]
}

/// The distance that `T⁻¹(T(z))` may keep from `z`: measured 1.9e-6 at |z| = 6.
const ROUND_TRIP: f32 = 4e-6;

#[test]
fn inverse_undoes_the_map_for_every_roughness() {
    let mut worst = 0.0_f32;
    for alpha in [1e-4, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0] {
        for ndf in both(alpha, alpha).into_iter().chain(both(alpha, 0.3 * alpha)) {
            for (j, k) in (-48..=48).flat_map(|j| (-48..=48).map(move |k| (j, k))) {
                let z = Vec2::new(j as f32, k as f32) * 0.125;
                if z.length() <= 6.0 {
                    let back = ndf.to_gaussian(ndf.from_gaussian(z));
                    worst = worst.max((back - z).length());
                }
            }
        }
    }
    println!("worst |T⁻¹(T(z)) − z|: {worst:e}");
    assert!(worst < ROUND_TRIP, "{worst:e}");
}

#[test]
fn smooth_at_the_origin() {
    // No seam and no pole: the map is linear there, with the slope α/√2 for both densities.
    for ndf in both(0.3, 0.6) {
        for k in 0..64 {
            let (sin, cos) = (k as f32 * 0.1).sin_cos();
            for radius in [1e-8_f32, 1e-6, 1e-5, 1.1e-5, 1e-3] {
                let m = ndf.from_gaussian(Vec2::new(cos, sin) * radius);
                let slope = Vec2::new(m.x / m.z / 0.3, m.y / m.z / 0.6) * std::f32::consts::SQRT_2 / radius;
                assert_abs_diff_eq!(slope, Vec2::new(cos, sin), epsilon = 2e-6, "{k} {radius}: {slope}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(2), failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn inverse_undoes_the_map(
        log_x in -4.0_f32..1.0, log_y in -4.0_f32..1.0, radius in 0.0_f32..6.0, angle in 0.0_f32..6.3,
    ) {
        let z = Vec2::from_angle(angle) * radius;
        for ndf in both(10f32.powf(log_x), 10f32.powf(log_y)) {
            let m = ndf.from_gaussian(z);
            prop_assert!((m.length() - 1.0).abs() < 3e-7 && m.z > 0.0);
            // Roughness above 1 and its ratio magnify the rounding of the shorter coordinate of m.
            prop_assert!((ndf.to_gaussian(m) - z).length() < 2.0 * ROUND_TRIP, "{z} -> {m} -> {}", ndf.to_gaussian(m));
        }
    }

    #[test]
    fn density_follows_from_the_map(alpha_x in 0.05_f32..1.0, alpha_y in 0.05_f32..1.0, x in -3.0_f32..3.0, y in -3.0_f32..3.0) {
        // D dn_x dn_y = N(z) dz: the Jacobian by central differences in f32 limits this to some per mille.
        for ndf in both(alpha_x, alpha_y) {
            let e = 0.01;
            let at = |dx: f32, dy: f32| {
                let m = ndf.from_gaussian(Vec2::new(x + dx, y + dy)).as_dvec3();
                [m.x, m.y]
            };
            let d = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| (a[k] - b[k]) / (2.0 * f64::from(e)));
            let ([xx, yx], [xy, yy]) = (d(at(e, 0.0), at(-e, 0.0)), d(at(0.0, e), at(0.0, -e)));
            let jacobian = xx * yy - xy * yx;
            let gaussian = (-0.5 * f64::from(x * x + y * y)).exp() / std::f64::consts::TAU;
            let density = f64::from(ndf.density(ndf.from_gaussian(Vec2::new(x, y))));
            let ratio = density * jacobian / gaussian;
            prop_assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
        }
    }
}
