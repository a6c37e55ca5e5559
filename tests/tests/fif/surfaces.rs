//! Surfaces that are not products: exact references, interpolation, continuity, bounds, anisotropy.

use asperity_fif::glam::DVec2;
use asperity_fif::surface::Fold;
use asperity_fif::{Bounded, FifError, HeightField, Interval, PeriodicSurface, SelfAffine};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::fif_systems::{decimal, integers, ratio};
use asperity_tests::random::Random;
use asperity_tests::reference;
use proptest::prelude::*;
use serde_json::Value;

use crate::properties::{config, f_hat};

const ROTATING: [[i32; 2]; 2] = [[2, -1], [1, 2]];

/// Compares with exact values to `[value, slope]` tolerances, and returns the errors of height and
/// gradient.
pub(crate) fn exact_at(
    point: &Value,
    value: impl Fn(f64) -> Bounded,
    gradient: impl Fn(f64) -> [Bounded; 2],
) -> [f64; 2] {
    let mut errors = [0.0_f64; 2];
    for tolerance in [1e-1, 1e-3, 1e-6, 0.0] {
        let [x, y] = gradient(tolerance);
        for (k, got, key) in [(0, value(tolerance), "f_dec"), (1, x, "fx_dec"), (1, y, "fy_dec")] {
            let error = (got.value - decimal(&point[key])).abs();
            assert!(error <= got.bound, "{point} {key}: {got:?}");
            assert!(k == 1 || got.bound <= tolerance.max(1e-11), "{point} {key}: {got:?}");
            errors[k] = if tolerance == 0.0 { errors[k].max(error) } else { 0.0 };
        }
    }
    errors
}

/// Returns the reference surface and its file.
fn reference_torus() -> (PeriodicSurface, Value) {
    let json = reference::read("fif/fis_torus.json");
    let grid = |key: &str| -> Vec<f64> {
        let rows = json[key].as_array().expect("an array");
        rows.iter()
            .flat_map(|row| row.as_array().expect("an array"))
            .map(|v| ratio(v.as_str().expect("a ratio")))
            .collect()
    };
    let d: Vec<[f64; 2]> = grid("zx").into_iter().zip(grid("zy")).map(|(x, y)| [x, y]).collect();
    let surface =
        PeriodicSurface::new(4, ROTATING, ratio(json["s"].as_str().expect("a ratio")), &grid("z"), &d)
            .expect("contractive");
    (surface, json)
}

#[test]
fn torus_values_and_gradients_match_exact_rationals() {
    let (surface, json) = reference_torus();
    let points = json["points"].as_array().unwrap();
    assert!(points.len() >= 40, "only {} points", points.len());
    let mut worst = [0.0_f64; 2];
    for point in points {
        let [(p, q), (r, s)] = ["x", "y"].map(|key| integers(point[key].as_str().unwrap()));
        let (at, denominator) = ([p * s, r * q], u32::try_from(q * s).unwrap());
        let [_, slope] = exact_at(
            point,
            |tolerance| surface.evaluate_ratio(at, denominator, tolerance),
            |tolerance| surface.evaluate_gradient_ratio(at, denominator, tolerance),
        );
        assert!(surface.evaluate_ratio(at, denominator, 0.0).bound <= 1e-12, "{point}");
        for slope in surface.evaluate_gradient_ratio(at, denominator, 0.0) {
            assert!(slope.bound <= 1e-11, "{point}: {slope:?}");
        }
        let height = surface.height(p as f64 / q as f64, r as f64 / s as f64);
        worst = [worst[0].max((height - decimal(&point["f_dec"])).abs()), worst[1].max(slope)];
    }
    // Measured: 1.4e-15 and 1.8e-14.
    assert!(worst[0] <= 1e-14 && worst[1] <= 1e-13, "{worst:?}");
    let mean = surface.mean();
    assert!((mean.value - ratio(json["mean"].as_str().unwrap())).abs() <= mean.bound && mean.bound < 1e-14);
}

#[test]
fn torus_data_is_interpolated_exactly() {
    let (surface, json) = reference_torus();
    let entry = |key: &str, i: usize, j: usize| ratio(json[key][i][j].as_str().unwrap());
    for i in 0..4 {
        for j in 0..4 {
            for (turns_x, turns_y) in [(0.0, 0.0), (3.0, -7.0)] {
                let (x, y) = (0.25 * i as f64 + turns_x, 0.25 * j as f64 + turns_y);
                assert_eq!(surface.height(x, y), entry("z", i, j), "node ({i}, {j})");
                let gradient = surface.gradient(x, y);
                assert_eq!(
                    [gradient.x, gradient.y],
                    [entry("zx", i, j), entry("zy", i, j)],
                    "node ({i}, {j})"
                );
            }
        }
    }
}

#[test]
fn torus_is_smooth_across_patches_and_seam() {
    let (surface, _) = reference_torus();
    // Far below the modulus of a visible jump, far above the rounding of coordinates near 1.
    let step = 2f64.powi(-40);
    let steepest = surface.slope_range().map(Interval::magnitude);
    for line in [0.0, 0.25, 0.5, 0.75, 1.0] {
        for k in 0..50 {
            let along = f64::from(k) * 0.019_7 + 0.003;
            for [a, b] in [[[line - step, along], [line, along]], [[along, line - step], [along, line]]] {
                let change = (surface.height(a[0], a[1]) - surface.height(b[0], b[1])).abs();
                assert!(change <= 2.0 * step * (steepest[0] + steepest[1]) + 1e-14, "{a:?} {b:?}: {change}");
                let change = (surface.gradient(a[0], a[1]) - surface.gradient(b[0], b[1])).length();
                let most = surface.gradient_modulus(step);
                // Measured at most 0.11, where |∇f| is up to 20.
                assert!(change <= most.min(0.2), "{a:?} {b:?}: {change} over {most}");
            }
            let (on, over) = (surface.height(line, along), surface.height(line + 2.0, along - 5.0));
            // along − 5 is rounded to half a unit in the last place.
            assert_abs_diff_eq!(on, over, epsilon = 1e-14, "({line}, {along}): {on} and {over}");
        }
    }
}

#[test]
fn gradient_is_the_slope_of_heights() {
    // With a contraction of 0.22 the gradient is Hölder with exponent 1: f is nearly as smooth as
    // p.
    let (rough, json) = reference_torus();
    let z: Vec<f64> = (0..16).map(|k| ratio(json["z"][k / 4][k % 4].as_str().unwrap())).collect();
    let smooth = PeriodicSurface::new(4, ROTATING, -0.1, &z, &[[1.0, -2.0]; 16]).unwrap();
    for (surface, step) in [(&rough, 1e-5), (&smooth, 1e-6)] {
        for k in 0..40 {
            let (x, y) = (0.618 * f64::from(k) % 1.0, 0.414 * f64::from(k) % 1.0);
            let gradient = surface.gradient(x, y);
            let slope = |dx: f64, dy: f64| {
                (surface.height(x + dx, y + dy) - surface.height(x - dx, y - dy)) / (2.0 * step)
            };
            let most = surface.gradient_modulus(step) + 1e-9;
            assert!((slope(step, 0.0) - gradient.x).abs() <= most, "({x}, {y}): x, over {most}");
            assert!((slope(0.0, step) - gradient.y).abs() <= most, "({x}, {y}): y, over {most}");
        }
    }
    assert!(smooth.gradient_modulus(1e-6) < 1e-2, "{}", smooth.gradient_modulus(1e-6));
}

#[test]
fn torus_at_nan_and_tiny_coordinates() {
    let (surface, _) = reference_torus();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(surface.evaluate(bad, 0.5, 0.0).value.is_nan());
        assert!(surface.gradient(0.5, bad).x.is_nan() && surface.normal(bad, bad).z.is_nan());
        let whole = surface.bounds(Interval::new(0.0, bad), Interval::new(0.0, 0.1));
        assert_eq!(whole.height, surface.range());
    }
    for tiny in [2f64.powi(-60), -2f64.powi(-70), 1e-30, -1e-60, f64::MIN_POSITIVE, -f64::from_bits(1)] {
        let height = surface.evaluate(tiny, 0.5 + tiny, 0.0);
        assert!(
            (height.value - surface.height(0.0, 0.5)).abs() <= 30.0 * tiny.abs() + height.bound,
            "{tiny}"
        );
        let [x, y] = surface.evaluate_gradient(tiny, 0.5, 0.0);
        let most = surface.gradient_modulus(tiny) + x.bound.max(y.bound);
        assert!((x.value - surface.gradient(0.0, 0.5).x).abs() <= most, "{tiny}: {x:?}");
    }
    assert_eq!(surface.height(1e300, -1e18), surface.height(0.0, 0.0));
    for tolerance in [f64::NAN, -1.0, f64::INFINITY, 1e9] {
        let got = surface.evaluate(0.3, 0.4, tolerance);
        assert!((got.value - surface.height(0.3, 0.4)).abs() <= got.bound, "{tolerance}: {got:?}");
    }
}

#[test]
fn torus_errors_name_the_parameter() {
    let new = |side, matrix, factor, z: &[f64], d: &[[f64; 2]]| {
        PeriodicSurface::new(side, matrix, factor, z, d).err()
    };
    let (z, d) = ([0.5; 16], [[0.0; 2]; 16]);
    assert_eq!(new(4, ROTATING, 0.447, &z, &d), None);
    for factor in [0.448, -0.448, f64::NAN, f64::INFINITY] {
        let error = new(4, ROTATING, factor, &z, &d).unwrap();
        let FifError::SurfaceScaling { max: most, .. } = error else { panic!("{factor}: {error}") };
        assert_abs_diff_eq!(most, 0.2_f64.sqrt(), epsilon = 1e-15);
        assert!(error.to_string().starts_with("`scaling` must be under"));
    }
    assert_eq!(new(3, ROTATING, 0.3, &z[..9], &d[..9]), Some(FifError::Side { value: 3 }));
    assert_eq!(new(1, ROTATING, 0.3, &z[..1], &d[..1]), Some(FifError::Side { value: 1 }));
    assert_eq!(new(usize::MAX, ROTATING, 0.3, &z, &d), Some(FifError::Side { value: usize::MAX }));
    let length = FifError::Length { parameter: "z", expected: 16, got: 15 };
    assert_eq!(new(4, ROTATING, 0.3, &z[1..], &d), Some(length));
    assert_eq!(new(4, [[1, 1], [1, 2]], 0.1, &z, &d), Some(FifError::Determinant { value: 1 }));
    assert_eq!(new(4, [[2, 1], [4, 2]], 0.1, &z, &d), Some(FifError::Determinant { value: 0 }));
    let (mut dented, mut steep) = (z, d);
    dented[6] = f64::NAN;
    assert!(matches!(new(4, ROTATING, 0.3, &dented, &d), Some(FifError::NodeNotFinite { node: [1, 2], .. })));
    steep[15][1] = f64::INFINITY;
    assert!(matches!(new(4, ROTATING, 0.3, &z, &steep), Some(FifError::NodeNotFinite { node: [3, 3], .. })));
    assert!(matches!(new(4, ROTATING, 0.3, &[1e308; 16], &d), Some(FifError::TooLarge { .. })));
}

#[test]
fn torus_extrema_and_means_contain_grid_samples() {
    let (surface, _) = reference_torus();
    for [x, y] in [
        [Interval::new(0.0, 1.0), Interval::new(0.0, 1.0)],
        [Interval::new(0.2, 0.55), Interval::new(-0.1, 0.3)],
    ] {
        // A grid of this step misses the extrema by at most slope times step, in practice by far
        // less.
        let grid = extrema_hold_a_grid(&surface, [x, y], 120, 0.1);
        let mean = surface.mean_over(x, y, 64);
        assert!((mean.value - grid).abs() <= mean.bound + 1e-3 && mean.bound < 0.2, "{mean:?} {grid}");
        if x.width() == 1.0 {
            assert!((mean.value - surface.mean().value).abs() <= mean.bound, "{mean:?}");
        }
    }
}

/// Asserts that brackets of the extrema over a rectangle contain grid samples within `most`, and
/// returns the grid's mean.
pub(crate) fn extrema_hold_a_grid<F: Fold>(
    surface: &SelfAffine<F>,
    [x, y]: [Interval; 2],
    count: u32,
    most: f64,
) -> f64 {
    let extrema = surface.extrema_over(x, y, 1e-6);
    let (mut low, mut high, mut sum) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
    let at = |side: Interval, k: u32| side.lo + side.width() * (f64::from(k) + 0.5) / f64::from(count);
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        let height = surface.evaluate(at(x, i), at(y, j), 1e-9).value;
        (low, high, sum) = (low.min(height), high.max(height), sum + height);
    }
    assert!(extrema.minimum.width() <= 1e-6 && extrema.maximum.width() <= 1e-6, "{extrema:?}");
    assert!(extrema.minimum.lo <= low + 1e-9 && high - 1e-9 <= extrema.maximum.hi, "{extrema:?}");
    let gaps = [low - extrema.minimum.hi, extrema.maximum.lo - high];
    assert!(gaps.iter().all(|&gap| gap < most), "{extrema:?} {low} {high}");
    let attained = |at: DVec2| surface.height(at.x, at.y);
    assert!(extrema.minimum.contains(attained(extrema.lowest)), "{extrema:?}");
    assert!(extrema.maximum.contains(attained(extrema.highest)), "{extrema:?}");
    sum / f64::from(count * count)
}

/// Asserts that values and gradients for any tolerance are within their bounds.
pub(crate) fn tolerances_hold<F: Fold>(surface: &SelfAffine<F>, x: f64, y: f64) -> Result<(), TestCaseError> {
    let all = |tolerance: f64| {
        let [along, across] = surface.evaluate_gradient(x, y, tolerance);
        [surface.evaluate(x, y, tolerance), along, across]
    };
    for tolerance in [1e-1, 1e-4, 1e-9] {
        for (coarse, fine) in all(tolerance).into_iter().zip(all(0.0)) {
            prop_assert!(coarse.bound <= tolerance.max(fine.bound), "{coarse:?} {fine:?}");
            prop_assert!(
                (coarse.value - fine.value).abs() <= coarse.bound + fine.bound,
                "{coarse:?} {fine:?}"
            );
        }
    }
    Ok(())
}

/// Asserts that bounds and extrema over a rectangle contain samples of heights, and bounds of
/// slopes within `slack` or their own bound.
pub(crate) fn bounds_hold<F: Fold>(
    surface: &SelfAffine<F>,
    [x, y]: [Interval; 2],
    samples: &[[f64; 2]],
    slack: Option<f64>,
) -> Result<(), TestCaseError> {
    let bounds = surface.bounds(x, y);
    let extrema = surface.extrema_over(x, y, 0.3 * surface.range().width());
    for &[u, v] in samples {
        let at = |range: Interval, t: f64| (range.lo + t * (range.hi - range.lo)).min(range.hi);
        let (px, py) = (at(x, u), at(y, v));
        let height = surface.evaluate(px, py, 0.0);
        prop_assert!(bounds.height.inflated(height.bound).contains(height.value), "{height:?} {bounds:?}");
        prop_assert!(extrema.maximum.hi + height.bound >= height.value, "{height:?} {extrema:?}");
        prop_assert!(extrema.minimum.lo - height.bound <= height.value, "{height:?} {extrema:?}");
        for (slope, range) in surface.evaluate_gradient(px, py, 0.0).iter().zip(bounds.slopes) {
            let slack = slack.unwrap_or(slope.bound);
            prop_assert!(range.inflated(slack).contains(slope.value), "{slope:?} {range:?}");
        }
    }
    // The reported bound does not excuse wide rectangles: a point has the modulus of the slope.
    let point = surface.bounds(Interval::new(x.lo, x.lo), Interval::new(y.lo, y.lo));
    prop_assert!(point.height.width() < 1e-8 * (1.0 + surface.range().magnitude()), "{point:?}");
    Ok(())
}

/// A matrix, a factor that contracts with it, and data on a grid of 2, 4 or 8 nodes per side.
fn tori() -> impl Strategy<Value = PeriodicSurface> {
    let matrix = prop::array::uniform2(prop::array::uniform2(-4..=4_i32));
    let matrix = matrix.prop_filter("two replicas", |[[a, b], [c, d]]| (a * d - b * c).abs() >= 2);
    (1..=3_u32, matrix, -0.95..0.95_f64).prop_flat_map(|(bits, matrix, part)| {
        let count = 1 << (2 * bits);
        let z = prop::collection::vec(-1.0..1.0_f64, count);
        let d = prop::collection::vec(prop::array::uniform2(-8.0..8.0_f64), count);
        (z, d).prop_map(move |(z, d)| {
            let FifError::SurfaceScaling { max: most, .. } =
                PeriodicSurface::new(1 << bits, matrix, 1.0, &z, &d).expect_err("a factor of 1")
            else {
                panic!("{matrix:?} with factor 1")
            };
            PeriodicSurface::new(1 << bits, matrix, part * most, &z, &d).expect("contractive")
        })
    })
}

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn torus_tolerance_is_within_bound(
        surface in tori(),
        x in 0..1_u32 << 20,
        y in 0..1_u32 << 20,
    ) {
        let unit = 1.0 / f64::from(1 << 20);
        tolerances_hold(&surface, f64::from(x) * unit, f64::from(y) * unit)?;
    }

    #[test]
    fn bounds_contain_samples(
        surface in tori(),
        corner in prop::array::uniform2(-1.0..1.0_f64),
        size in prop::array::uniform2(-12.0..-0.5_f64),
        samples in prop::collection::vec(prop::array::uniform2(0.0..=1.0_f64), 60),
    ) {
        let [x, y] = [0, 1].map(|k| Interval::new(corner[k], corner[k] + size[k].exp2()));
        bounds_hold(&surface, [x, y], &samples, None)?;
    }
}

/// Points along a side for the spectrum of slopes.
const SIDE: usize = 128;

/// Returns the energy of slopes in waves within 5° of the axes, relative to an isotropic surface.
///
/// Waves of 8 to 64 periods per side count, beyond the data. `window` fades the ends of nonperiodic
/// surfaces.
pub(crate) fn grain(gradient: impl Fn(f64, f64) -> [f64; 2], window: impl Fn(f64) -> f64) -> f64 {
    let place = |k: usize| (k as f64 + 0.37) / SIDE as f64;
    let turns: Vec<[f64; 2]> = (0..SIDE)
        .map(|k| (std::f64::consts::TAU * k as f64 / SIDE as f64).sin_cos())
        .map(|(sin, cos)| [cos, -sin])
        .collect();
    // The transform along rows, followed by a transposition.
    let transform = |z: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let mut out = vec![[0.0; 2]; SIDE * SIDE];
        for (j, row) in z.chunks_exact(SIDE).enumerate() {
            for k in 0..SIDE {
                let sum = row.iter().enumerate().fold([0.0; 2], |[re, im], (i, [a, b])| {
                    let [c, s] = turns[i * k % SIDE];
                    [re + a * c - b * s, im + a * s + b * c]
                });
                out[k * SIDE + j] = sum;
            }
        }
        out
    };
    let (mut near, mut all, mut counts) = (0.0, 0.0, [0.0_f64; 2]);
    for component in [0, 1] {
        let mut slopes: Vec<[f64; 2]> =
            (0..SIDE * SIDE).map(|k| [gradient(place(k / SIDE), place(k % SIDE))[component], 0.0]).collect();
        let mean = slopes.iter().map(|z| z[0]).sum::<f64>() / slopes.len() as f64;
        for (k, z) in slopes.iter_mut().enumerate() {
            z[0] = (z[0] - mean) * window(place(k / SIDE)) * window(place(k % SIDE));
        }
        for (k, [re, im]) in transform(&transform(&slopes)).into_iter().enumerate() {
            let frequency = |k: usize| if k < SIDE / 2 { k as f64 } else { k as f64 - SIDE as f64 };
            let (x, y) = (frequency(k / SIDE).abs(), frequency(k % SIDE).abs());
            if !(8.0..SIDE as f64 / 2.0).contains(&x.hypot(y)) {
                continue;
            }
            let power = re * re + im * im;
            (all, counts[1]) = (all + power, counts[1] + 1.0);
            if x.min(y) < 5_f64.to_radians().tan() * x.max(y) {
                (near, counts[0]) = (near + power, counts[0] + 1.0);
            }
        }
    }
    near / all * counts[1] / counts[0]
}

#[test]
fn torus_is_isotropic_and_product_is_not() {
    let (torus, _) = reference_torus();
    let slopes = |x: f64, y: f64| torus.evaluate_gradient(x, y, 1e-3).map(|slope| slope.value);
    let torus = grain(slopes, |_| 1.0);
    let product = HeightField::new(f_hat(), f_hat());
    let slopes = |x: f64, y: f64| product.gradient(2.0 * x, 2.0 * y).unwrap().to_array();
    let product = grain(slopes, |t| (std::f64::consts::PI * t).sin().powi(2));
    // A random number per point: white noise.
    let mix = |x: u64| Random(x).bits();
    let isotropic = grain(
        |x, y| {
            let bits = mix(mix(x.to_bits()) ^ y.to_bits());
            [(bits >> 40) as f64, (mix(bits) >> 40) as f64]
        },
        |_| 1.0,
    );
    // Measured: 0.19, 6.57 and 0.97. Five replicas rotated by an irrational angle leave most of the
    // axes out.
    assert_abs_diff_eq!(isotropic, 1.0, epsilon = 0.1, "{isotropic}");
    assert!(torus < 1.0 && product > 2.0, "torus {torus}, product {product}");
}
