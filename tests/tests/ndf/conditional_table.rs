//! The lookup table of the unresolved part of a pixel: its distance from the exact density, and its
//! mean over the surface.

use asperity_ndf_sampling::{
    Beckmann, ConditionalNdf, ConditionalTable, GaussianSplit, Ggx, Measure, Ndf, NdfMap, Reconstruction,
    StudentT, inverse_gaussian_cdf,
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::low_discrepancy::r2;
use glam::{Vec2, Vec3};
use rayon::prelude::*;

fn gaussian(index: u32) -> Vec2 {
    Vec2::from(r2(index).map(|u| inverse_gaussian_cdf(u) as f32))
}

fn ndfs() -> Vec<(&'static str, Box<dyn Ndf + Sync>, f64)> {
    let lobe = |n: Vec3, x: f32, y: f32, width: f32| (-((n.x - x).powi(2) + (n.y - y).powi(2)) / width).exp();
    let painted = |n: Vec3| lobe(n, -0.38, 0.22, 0.02) + 0.6 * lobe(n, 0.35, -0.3, 0.045) + 0.02;
    let mask =
        |n: Vec3| f32::from(u8::from(((5.0 * n.x).floor() + (5.0 * n.y).floor()).rem_euclid(2.0) == 0.0));
    // The last number is the maximum accepted total variation.
    vec![
        ("GGX 0.2, 0.4", Box::new(Ggx::new(0.2, 0.4).expect("valid")), 0.005),
        ("GGX 0.001", Box::new(Ggx::isotropic(1e-3).expect("valid")), 0.005),
        ("GGX 1", Box::new(Ggx::isotropic(1.0).expect("valid")), 0.005),
        ("Beckmann 0.3", Box::new(Beckmann::isotropic(0.3).expect("valid")), 0.005),
        ("Student-t 0.3, 1.6", Box::new(StudentT::new(0.3, 0.3, 1.6).expect("valid")), 0.005),
        (
            "painted",
            Box::new(
                NdfMap::from_fn(256, 256, Measure::ProjectedSolidAngle, Reconstruction::Constant, painted)
                    .expect("valid"),
            ),
            0.02,
        ),
        (
            "mask",
            Box::new(
                NdfMap::from_fn(64, 64, Measure::ProjectedSolidAngle, Reconstruction::Constant, mask)
                    .expect("valid"),
            ),
            0.05,
        ),
    ]
}

#[test]
fn lookup_is_close_to_the_exact_density() {
    const POINTS: u32 = 4096;
    const PLACES: u32 = 12;
    for (name, ndf, most) in ndfs() {
        let table = ConditionalTable::new(&*ndf, 256).unwrap();
        let mut row = format!("| {name} |");
        for s in [0.0, 0.5, 0.9_f32] {
            // ½ ∫ |p′ − p| cos θ dω, as the mean of |p′/p − 1| over samples of p.
            let variation = (0..PLACES)
                .into_par_iter()
                .map(|place| {
                    let seen = ConditionalNdf::new(&*ndf, gaussian(7 * place + 3), s);
                    let ratio = |k| {
                        let h = seen.warp_gaussian(gaussian(k));
                        f64::from(table.view().residual_ndf(h, seen.split())) / f64::from(seen.d(h)) - 1.0
                    };
                    (0..POINTS).map(|k| 0.5 * ratio(k).abs()).sum::<f64>() / f64::from(POINTS)
                })
                .sum::<f64>()
                / f64::from(PLACES);
            row += &format!(" {variation:.4} |");
            assert!(variation < most, "{name}, s = {s}: {variation}");
        }
        println!("{row}");
    }
}

#[test]
fn mean_of_lookup_over_the_surface_is_the_far_field() {
    // A trapezoidal rule with step 1/8: see the test of the exact density.
    for (name, ndf, _) in ndfs() {
        let table = ConditionalTable::new(&*ndf, 64).unwrap();
        for k in 0..3 {
            let h = ndf.warp_gaussian(gaussian(11 * k + 5));
            let far = f64::from(table.view().residual_ndf(h, GaussianSplit::new(Vec2::ZERO, 0.0)));
            for s in [0.1, 0.5, 0.9] {
                let mean: f64 = (-64..=64)
                    .into_par_iter()
                    .map(|j| {
                        let row = (-64..=64).map(|k| {
                            let z_b = Vec2::new(j as f32, k as f32) * 0.125;
                            let weight =
                                f64::from(-0.5 * z_b.length_squared()).exp() / std::f64::consts::TAU / 64.0;
                            weight * f64::from(table.view().residual_ndf(h, GaussianSplit::new(z_b, s)))
                        });
                        row.sum::<f64>()
                    })
                    .sum();
                assert_abs_diff_eq!(mean / far, 1.0, epsilon = 1e-6, "{name} at {h}, s = {s}: {mean} {far}");
            }
        }
    }
}
