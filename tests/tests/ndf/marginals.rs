//! Marginal and conditional distribution functions of maps: reference values, inversion, and edge
//! cases.

use asperity_ndf_sampling::{Ggx, Measure, Ndf, NdfMap, Reconstruction};
use asperity_tests::reference::{self, numbers, rows};
use glam::Vec2;
use proptest::prelude::*;
use rayon::prelude::*;

use super::exact_map::ExactMap;
use super::facet_reference::ndf;
use super::packed_map::check_sample;

/// Returns the projected normal at a position of the unit square.
fn normal(x: f64, y: f64) -> Vec2 {
    Vec2::new((2.0 * x - 1.0) as f32, (2.0 * y - 1.0) as f32)
}

#[test]
fn marginals_of_a_fine_map_match_the_reference() {
    // The error of a bilinear map is the curvature of the function times the square of a texel:
    // 1.8e-5 at 1536.
    const SIZE: usize = 2304;
    let reference = reference::read("ndf/marginals.json");
    let items = reference["items"].as_array().unwrap();
    let errors: Vec<[f64; 3]> = items
        .par_iter()
        .map(|item| {
            let map = NdfMap::from_ndf(SIZE, SIZE, Reconstruction::Bilinear, &*ndf(item)).unwrap();
            let (view, mut worst) = (map.view(), [0.0_f64; 3]);
            let forward = |x: f64, y: f64| view.forward(normal(x, y)).as_dvec2();
            let mut note = |k: usize, error: f64| worst[k] = worst[k].max(error.abs());
            for (x, cumulative) in numbers(&item["x"]).into_iter().zip(numbers(&item["M"])) {
                note(0, forward(x, 0.5).x - cumulative);
            }
            for row in rows(&item["C"]) {
                note(1, forward(row[0], row[1]).y - row[2]);
            }
            for row in rows(&item["M_inverse"]) {
                note(2, 0.5 + 0.5 * f64::from(view.inverse(Vec2::new(row[0] as f32, 0.5)).x) - row[1]);
            }
            println!("{} {} {}: {worst:?}", item["model"], item["alpha_x"], item["alpha_y"]);
            worst
        })
        .collect();
    for (item, worst) in items.iter().zip(errors) {
        for (error, what) in worst.into_iter().zip(["M", "C", "M⁻¹"]) {
            assert!(error < 1e-5, "{} {} {what}: {error:e}", item["model"], item["alpha_x"]);
        }
    }
}

#[test]
fn marginals_of_narrow_lobes_have_second_order_error() {
    // m over n_x of isotropic GGX, whose D is α²/(π (α² + (1 − α²) r²)²), in closed form; M by
    // Simpson's rule in asinh(n_x/α).
    let marginal = |alpha: f64, x: f64| {
        let (a, b) = (alpha * alpha + (1.0 - alpha * alpha) * x * x, 1.0 - alpha * alpha);
        let y = (1.0 - x * x).max(0.0).sqrt();
        let integral = y / (a * (a + b * y * y)) + (y * (b / a).sqrt()).atan() / (a * (a * b).sqrt());
        alpha * alpha * integral / core::f64::consts::PI
    };
    for (size, alpha) in [(2304, 0.05_f32), (2304, 0.1), (512, 0.05), (512, 0.025)] {
        let map =
            NdfMap::from_ndf(size, size, Reconstruction::Bilinear, &Ggx::isotropic(alpha).unwrap()).unwrap();
        let (alpha, steps) = (f64::from(alpha), 4000);
        let at =
            |k: u32| alpha * ((2.0 * f64::from(k) / f64::from(steps) - 1.0) * (1.0 / alpha).asinh()).sinh();
        let (mut sum, mut worst) = (0.0, 0.0_f64);
        let slope = |k: u32| marginal(alpha, at(k)) * (at(k).powi(2) + alpha * alpha).sqrt();
        let h = 2.0 * (1.0 / alpha).asinh() / f64::from(steps);
        for k in (0..steps).step_by(2) {
            sum += h / 3.0 * (slope(k) + 4.0 * slope(k + 1) + slope(k + 2));
            let x = 0.5 + 0.5 * at(k + 2);
            worst = worst.max((f64::from(map.view().forward(normal(x, 0.5)).x) - sum).abs());
        }
        let texels = 0.5 * alpha * size as f64;
        println!("{size}², roughness {alpha:.3}, {texels:.1} texels: M {worst:.2e}");
        assert!(worst < 0.05 / (texels * texels) + 3e-7, "{worst:e}");
    }
}

/// Uniform numbers for which inversion has failed in the past.
const EDGES: [f64; 9] =
    [0.0, 1e-300, 1e-17, 1e-9, 0.25, 0.5, 0.999_999, 1.0 - 5.960_464_477_539_063e-8, 1.0 - 1e-15];

const KINDS: [Reconstruction; 2] = [Reconstruction::Constant, Reconstruction::Bilinear];

#[test]
fn normals_keep_their_coordinates_to_f32_rounding() {
    let ggx = Ggx::new(0.3, 0.6).unwrap();
    let map = NdfMap::from_ndf(256, 256, Reconstruction::Constant, &ggx).unwrap();
    let mut worst = 0.0_f32;
    for (j, k) in (-40..=40).flat_map(|j| (-40..=40).map(move |k| (j, k))) {
        let z = Vec2::new(j as f32, k as f32) * 0.1;
        worst = worst.max((map.invert(map.warp_gaussian(z)) - z).abs().max_element());
    }
    println!("worst |T⁻¹(T(z)) − z| of a map: {worst:e}");
    // At |z| = 4 near the rim, where dz/dn grows to 10⁴.
    assert!(worst < 5e-3, "{worst:e}");
}

#[test]
fn distribution_functions_are_monotone() {
    let texels: Vec<f32> = (0..31 * 31)
        .map(|k| (k % 31, k / 31))
        .map(|(i, j)| if (i * j) % 7 < 2 { 0.0 } else { ((i * 3 + j) % 5) as f32 })
        .collect();
    let map =
        NdfMap::from_texels(31, 31, &texels, Measure::ProjectedSolidAngle, Reconstruction::Constant).unwrap();
    for x in [-0.998, -0.98, -0.4, 0.0, 0.54, 0.998] {
        let mut last = Vec2::ZERO;
        for k in 0..=10_000 {
            let t = k as f32 / 5000.0 - 1.0;
            let next =
                Vec2::new(map.view().forward(Vec2::new(t, x)).x, map.view().forward(Vec2::new(x, t)).y);
            // Root and quotient of a row may round in opposite directions.
            assert!(next.cmpge(last - 1.2e-7).all(), "{x} {t}: {next} after {last}");
            last = next;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: proptest::test_runner::RngSeed::Fixed(3), failure_persistence: None, ..ProptestConfig::with_cases(2000)
    })]

    #[test]
    fn samples_of_random_texels_match_exact_map(
        width in 1_usize..12, height in 1_usize..12, kind in prop::sample::select(&KINDS[..]),
        // Zeros, ordinary weights, and twelve decades of contrast.
        weights in prop::collection::vec(
            prop_oneof![Just(0.0_f32), 0.01_f32..10.0, (-40.0_f32..0.0).prop_map(f32::exp2)], 121,
        ),
        empty in prop::collection::vec(any::<bool>(), 11),
        u1 in probability(), u2 in probability(),
    ) {
        let mut weights = weights;
        for (k, weight) in weights.iter_mut().enumerate() {
            // Whole columns without weight.
            if empty[k % width] && empty[(k + 1) % width] {
                *weight = 0.0;
            }
        }
        let texels = &weights[..width * height];
        let Ok(map) = NdfMap::from_texels(width, height, texels, Measure::ProjectedSolidAngle, kind) else {
            // Only black maps are an error.
            prop_assert!(texels.iter().zip(0..).all(|(&t, k)| t == 0.0 || !in_disk(k, width, height)));
            return Ok(());
        };
        let exact = ExactMap::new(width, height, texels, kind);
        check_sample("random texels", &exact, map.view(), Vec2::new(u1 as f32, u2 as f32).min(Vec2::splat(1.0 - f32::EPSILON / 2.0)));
        let m = map.warp_gaussian(Vec2::new(4.0 * u1 as f32 - 2.0, 4.0 * u2 as f32 - 2.0));
        prop_assert!((m.length() - 1.0).abs() < 1e-6 && m.z > 0.0);
    }
}

/// Uniform numbers, and the ends of their range.
fn probability() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => 0.0_f64..1.0,
        1 => (0.0_f64..1.0).prop_map(|t| 1.0 - t * 1e-7),
        1 => (0.0_f64..1.0).prop_map(|t| t * 1e-7),
        1 => prop::sample::select(&EDGES[..]),
    ]
}

fn in_disk(texel: usize, width: usize, height: usize) -> bool {
    let nearest = |k: usize, n: usize| {
        0.0_f64.clamp(k as f64 / n as f64 * 2.0 - 1.0, (k + 1) as f64 / n as f64 * 2.0 - 1.0)
    };
    nearest(texel % width, width).hypot(nearest(texel / width, height)) < 1.0
}
