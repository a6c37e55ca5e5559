//! Marginal and conditional distribution functions of maps: reference values, inversion, and every edge.

use asperity_ndf_sampling::{Cdf, Ggx, Measure, Ndf, NdfMap, Reconstruction};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use asperity_tests::reference::{self, numbers, rows};
use glam::{Vec2, Vec3};
use proptest::prelude::*;
use rayon::prelude::*;

use super::facet_reference::ndf;

#[test]
fn marginals_of_a_fine_map_equal_the_reference() {
    // The bilinear map of a function errs by its curvature times the square of a texel: 1.8e-5 at 1536.
    const SIZE: usize = 2304;
    let reference = reference::read("ndf/marginals.json");
    let items = reference["items"].as_array().unwrap();
    let errors: Vec<[f64; 4]> = items
        .par_iter()
        .map(|item| {
            let map = NdfMap::from_ndf(SIZE, SIZE, Reconstruction::Bilinear, &*ndf(item)).unwrap();
            let (cdf, mut worst) = (map.cdf(), [0.0_f64; 4]);
            let mut note = |k: usize, error: f64| worst[k] = worst[k].max(error.abs());
            let rows3 = numbers(&item["x"]).into_iter().zip(numbers(&item["m"])).zip(numbers(&item["M"]));
            for ((x, m), cumulative) in rows3 {
                note(0, (cdf.marginal(x) - m) / m.max(1.0));
                note(1, cdf.marginal_cdf(x) - cumulative);
            }
            for row in rows(&item["C"]) {
                note(2, cdf.conditional_cdf(row[0], row[1]) - row[2]);
            }
            for row in rows(&item["M_inverse"]) {
                note(3, cdf.marginal_inverse(row[0]) - row[1]);
            }
            println!("{} {} {}: {worst:?}", item["model"], item["alpha_x"], item["alpha_y"]);
            worst
        })
        .collect();
    for (item, worst) in items.iter().zip(errors) {
        for (error, what) in worst.into_iter().zip(["m", "M", "C", "M⁻¹"]) {
            assert!(error < 1e-5, "{} {} {what}: {error:e}", item["model"], item["alpha_x"]);
        }
    }
}

#[test]
fn marginals_of_narrow_lobes_err_by_the_square_of_a_texel() {
    // m over n_x of isotropic GGX, whose D is α²/(π (α² + (1 − α²) r²)²), in closed form; M by Simpson's rule in asinh(n_x/α).
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
        let (mut sum, mut worst) = (0.0, [0.0_f64; 2]);
        let slope = |k: u32| marginal(alpha, at(k)) * (at(k).powi(2) + alpha * alpha).sqrt();
        let h = 2.0 * (1.0 / alpha).asinh() / f64::from(steps);
        for k in (0..steps).step_by(2) {
            sum += h / 3.0 * (slope(k) + 4.0 * slope(k + 1) + slope(k + 2));
            let x = 0.5 + 0.5 * at(k + 2);
            let m = 2.0 * marginal(alpha, at(k + 2));
            worst[0] = worst[0].max((map.cdf().marginal(x) - m).abs() / m.max(1.0));
            worst[1] = worst[1].max((map.cdf().marginal_cdf(x) - sum).abs());
        }
        let texels = 0.5 * alpha * size as f64;
        println!("{size}², roughness {alpha:.3}, {texels:.1} texels: m {:.2e}, M {:.2e}", worst[0], worst[1]);
        // Half a texel's square times the second derivative at the peak, of which a twelfth to an eighth is lost.
        assert!(worst[0] < 0.5 / (texels * texels) && worst[1] < 0.1 / (texels * texels), "{worst:?}");
        assert!(worst[0] > 0.01 / (texels * texels), "the law is tighter than that: {worst:?}");
    }
}

/// Uniform numbers at which inversion has gone wrong before, somewhere.
const EDGES: [f64; 9] =
    [0.0, 1e-300, 1e-17, 1e-9, 0.25, 0.5, 0.999_999, 1.0 - 5.960_464_477_539_063e-8, 1.0 - 1e-15];

/// Checks `forward(inverse(u)) = u` and that every point is in the disk, where there is weight.
fn check_round_trip(cdf: &Cdf, u: [f64; 2]) -> f64 {
    let [x, y] = cdf.inverse(u);
    assert!((0.0..=1.0).contains(&x), "{u:?}: x = {x}");
    assert!((2.0 * x - 1.0).hypot(2.0 * y - 1.0) <= 1.0 + 1e-15, "{u:?}: ({x}, {y}) left the disk");
    let back = cdf.forward([x, y]);
    (back[0] - u[0]).abs().max((back[1] - u[1]).abs())
}

const KINDS: [Reconstruction; 2] = [Reconstruction::Constant, Reconstruction::Bilinear];

fn image(size: usize, kind: Reconstruction, value: impl Fn(usize, usize) -> f32) -> NdfMap {
    let texels: Vec<f32> = (0..size * size).map(|k| value(k % size, k / size)).collect();
    NdfMap::from_texels(size, size, &texels, Measure::Normals, kind).expect("valid")
}

#[test]
fn forward_undoes_inverse_on_every_kind_of_map() {
    let maps = KINDS.map(|kind| {
        [
            ("1×1", image(1, kind, |_, _| 3.0)),
            ("2×2, one texel", image(2, kind, |i, j| f32::from(i == 1 && j == 0))),
            ("one hot texel", image(64, kind, |i, j| f32::from(i == 40 && j == 20))),
            ("hot texel at the rim", image(8, kind, |i, j| f32::from(i == 0 && j == 2))),
            ("binary mask", image(33, kind, |i, j| f32::from((i * 7 + j * 5) % 11 < 3))),
            ("two far islands", image(64, kind, |i, j| f32::from((i == 1 || i == 62) && j / 2 == 16))),
            ("ring", image(64, kind, |i, j| f32::from((i as f32 - 31.5).hypot(j as f32 - 31.5) > 24.0))),
            ("steep", image(64, kind, |i, j| (-(i as f32) - 0.5 * j as f32).exp2())),
            ("GGX 0.05", NdfMap::from_ndf(256, 256, kind, &Ggx::isotropic(0.05).unwrap()).unwrap()),
            ("GGX 1", NdfMap::from_ndf(100, 37, kind, &Ggx::isotropic(1.0).unwrap()).unwrap()),
            ("bright rim", NdfMap::from_fn(50, 50, Measure::SolidAngle, kind, |n| n.x.abs()).unwrap()),
        ]
    });
    for (name, map) in maps.into_iter().flatten() {
        let mut random = Random(11);
        let largest = |worst: f64, u| check_round_trip(map.cdf(), u).max(worst);
        let inner = (0..20_000).map(|_| [random.uniform(), random.uniform()]).fold(0.0, largest);
        let edges = EDGES.into_iter().flat_map(|u1| EDGES.map(|u2| [u1, u2])).fold(0.0, largest);
        println!("{name}: {inner:e}, at the edges {edges:e}");
        // A last bit of x, 1e-16, times m(x), at most the number of texels.
        assert!(inner < 1e-13, "{name}: {inner:e}");
        // Where the chord shrinks to a point, samples keep a weight of 9e-11 away.
        assert!(edges < 1e-10, "{name}: {edges:e}");
    }
}

#[test]
fn normals_keep_their_coordinates_to_the_rounding_of_f32() {
    let ggx = Ggx::new(0.3, 0.6).unwrap();
    let map = NdfMap::from_ndf(256, 256, Reconstruction::Constant, &ggx).unwrap();
    let mut worst = 0.0_f32;
    for (j, k) in (-40..=40).flat_map(|j| (-40..=40).map(move |k| (j, k))) {
        let z = Vec2::new(j as f32, k as f32) * 0.1;
        worst = worst.max((map.to_gaussian(map.from_gaussian(z)) - z).abs().max_element());
    }
    println!("worst |T⁻¹(T(z)) − z| of a map: {worst:e}");
    // At |z| = 4 near the rim, where dz/dn grows to 10⁴.
    assert!(worst < 5e-3, "{worst:e}");
}

#[test]
fn distribution_functions_never_decrease() {
    let map =
        image(
            31,
            Reconstruction::Constant,
            |i, j| if (i * j) % 7 < 2 { 0.0 } else { ((i * 3 + j) % 5) as f32 },
        );
    let steps = (0..=10_000).map(|k| f64::from(k) / 10_000.0);
    let (mut m, mut inverse) = (0.0, 0.0);
    for t in steps.clone() {
        assert!(map.cdf().marginal_cdf(t) >= m && map.cdf().marginal_inverse(t) >= inverse, "{t}");
        (m, inverse) = (map.cdf().marginal_cdf(t), map.cdf().marginal_inverse(t));
    }
    for x in [0.001, 0.01, 0.3, 0.5, 0.77, 0.999] {
        let (mut c, mut inverse) = (0.0, 0.0);
        for t in steps.clone() {
            let next = (map.cdf().conditional_cdf(x, t), map.cdf().conditional_inverse(x, t));
            assert!(next.0 >= c && next.1 >= inverse, "{x} {t}");
            (c, inverse) = next;
        }
    }
    assert_eq!((map.cdf().marginal_cdf(0.0), map.cdf().marginal_cdf(1.0)), (0.0, 1.0));
}

#[test]
fn small_weights_beside_large_ones_are_kept() {
    // A row of weight 1e-12 beside one of 1: single precision would lose it.
    let map = image(8, Reconstruction::Constant, |i, j| {
        if j != 3 {
            0.0
        } else if i == 2 {
            1.0
        } else if i == 6 {
            1e-12
        } else {
            0.0
        }
    });
    let [x, _] = map.cdf().inverse([1.0 - 5e-13, 0.5]);
    assert!((0.75..0.875).contains(&x), "{x}");
    let n = Vec3::new(0.6, -0.2, (1.0_f32 - 0.36 - 0.04).sqrt());
    let expected = 1e-12 * 64.0 / 4.0;
    assert_abs_diff_eq!(map.density(n) / expected, 1.0, epsilon = 1e-5, "{:e}", map.density(n));
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: proptest::test_runner::RngSeed::Fixed(3), failure_persistence: None, ..ProptestConfig::with_cases(2000)
    })]

    #[test]
    fn forward_undoes_inverse(
        width in 1_usize..12, height in 1_usize..12, kind in prop::sample::select(&KINDS[..]),
        // Zeros, common weights, and twelve decades of contrast.
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
        let Ok(map) = NdfMap::from_texels(width, height, texels, Measure::Normals, kind) else {
            // Only black maps are refused.
            prop_assert!(texels.iter().zip(0..).all(|(&t, k)| t == 0.0 || !in_disk(k, width, height)));
            return Ok(());
        };
        let error = check_round_trip(map.cdf(), [u1, u2]);
        prop_assert!(error < 1e-10, "{error:e}");
        let m = map.from_gaussian(Vec2::new(4.0 * u1 as f32 - 2.0, 4.0 * u2 as f32 - 2.0));
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
