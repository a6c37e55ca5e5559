//! Φ and Φ⁻¹ against reference values; maps from and to Gaussian coordinates over a grid, and at
//! the origin.

use asperity_ndf_sampling::{Beckmann, Ggx, Ndf, gaussian_cdf, inverse_gaussian_cdf};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::reference::{self, numbers};
use glam::Vec2;

#[test]
fn phi_and_its_inverse_match_the_reference() {
    let reference = reference::read("ndf/gaussian.json");
    let pairs = |x: &str, y: &str| numbers(&reference[x]).into_iter().zip(numbers(&reference[y]));
    let mut worst = [0.0_f64; 2];
    for (z, expected) in pairs("z", "Phi") {
        let error = (gaussian_cdf(z) / expected - 1.0).abs();
        worst[0] = worst[0].max(error);
        assert!(error < 2e-15, "Φ({z}) = {:e} != {expected:e}", gaussian_cdf(z));
    }
    for (u, expected) in pairs("u", "Phi_inv") {
        let error = (inverse_gaussian_cdf(u) - expected).abs() / expected.abs().max(1.0);
        worst[1] = worst[1].max(error);
        assert!(error < 4e-15, "Φ⁻¹({u}) = {} != {expected}", inverse_gaussian_cdf(u));
    }
    println!("worst errors of Φ and Φ⁻¹: {worst:?}");
}

/// Returns both densities of the roughnesses.
fn both(alpha_x: f32, alpha_y: f32) -> [Box<dyn Ndf>; 2] {
    [
        Box::new(Ggx::new(alpha_x, alpha_y).expect("valid")),
        Box::new(Beckmann::new(alpha_x, alpha_y).expect("valid")),
    ]
}

/// Tolerance of `T⁻¹(T(z))` relative to `z`: measured 1.9e-6 at |z| = 6.
const ROUND_TRIP: f32 = 4e-6;

#[test]
fn inverse_undoes_the_map_for_every_roughness() {
    let mut worst = 0.0_f32;
    for alpha in [1e-4, 1e-3, 0.01, 0.05, 0.2, 0.5, 1.0, 10.0] {
        for ndf in both(alpha, alpha).into_iter().chain(both(alpha, 0.3 * alpha)) {
            for (j, k) in (-48..=48).flat_map(|j| (-48..=48).map(move |k| (j, k))) {
                let z = Vec2::new(j as f32, k as f32) * 0.125;
                if z.length() <= 6.0 {
                    let back = ndf.invert(ndf.warp_gaussian(z));
                    // Roughness above 1 magnifies the rounding of m_z.
                    worst = worst.max((back - z).length() / if alpha > 1.0 { 2.0 } else { 1.0 });
                }
            }
        }
    }
    println!("worst |T⁻¹(T(z)) − z|: {worst:e}");
    assert!(worst < ROUND_TRIP, "{worst:e}");
}

#[test]
fn smooth_at_the_origin() {
    // No seam and no pole: the map is linear there, with slope α/√2 for both densities.
    for ndf in both(0.3, 0.6) {
        for k in 0..64 {
            let (sin, cos) = (k as f32 * 0.1).sin_cos();
            for radius in [1e-8_f32, 1e-6, 1e-5, 1.1e-5, 1e-3] {
                let m = ndf.warp_gaussian(Vec2::new(cos, sin) * radius);
                let slope = Vec2::new(m.x / m.z / 0.3, m.y / m.z / 0.6) * std::f32::consts::SQRT_2 / radius;
                assert_abs_diff_eq!(slope, Vec2::new(cos, sin), epsilon = 2e-6, "{k} {radius}: {slope}");
            }
        }
    }
}
