//! The folded surface: exact references, interpolation, functional equation, continuity, bounds,
//! anisotropy.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its reference has failed")]

use asperity_tests::assert_abs_diff_eq;
use std::f64::consts::PI;

use asperity_fif::{FifError, FoldedSurface, Interval};
use asperity_tests::fif_systems::{decimal, hexadecimal, ratio, ratios, read};
use asperity_tests::random::Random;
use proptest::prelude::*;
use serde_json::Value;

use crate::properties::config;
use crate::surface_rays::numbers;
use crate::surfaces::{bounds_hold, exact_at, extrema_hold_a_grid, grain, tolerances_hold};

/// Returns both reference surfaces with their exact values.
fn references() -> Vec<(FoldedSurface, Value)> {
    let json = read("fis_folded");
    let surfaces = json["surfaces"].as_array().unwrap();
    surfaces
        .iter()
        .map(|json| {
            let grid =
                |key: &str| -> Vec<f64> { json[key].as_array().unwrap().iter().flat_map(ratios).collect() };
            let d: Vec<[f64; 2]> = grid("zx").into_iter().zip(grid("zy")).map(|(x, y)| [x, y]).collect();
            let factor = ratio(json["s"].as_str().unwrap());
            let (x, y) = (ratios(&json["x"]), ratios(&json["y"]));
            (FoldedSurface::new(&x, &y, factor, &grid("z"), &d).unwrap(), json.clone())
        })
        .collect()
}

#[test]
fn folded_values_and_gradients_match_exact_rationals() {
    let mut worst = [[0.0_f64; 2]; 2];
    for ((surface, json), worst) in references().iter().zip(&mut worst) {
        for point in json["points"].as_array().unwrap() {
            let [x, y] = ["x_hex", "y_hex"].map(|key| hexadecimal(point[key].as_str().unwrap()));
            let errors = exact_at(
                point,
                |tolerance| surface.evaluate(x, y, tolerance),
                |tolerance| surface.evaluate_gradient(x, y, tolerance),
            );
            let steepest = surface.slope_range().map(Interval::magnitude);
            let sizes = [surface.range().magnitude(), steepest[0].max(steepest[1])];
            *worst = [0, 1].map(|k| worst[k].max(errors[k] / sizes[k]));
        }
        let mean = surface.mean();
        assert!((mean.value - decimal(&json["mean"])).abs() <= mean.bound && mean.bound < 1e-13, "{mean:?}");
    }
    // Measured 2e-15 and 2e-13 of the ranges, 4e-14 and 6e-9: the rough surface changes by this
    // much over the rounding of a point.
    let [smooth, rough] = worst;
    assert!(smooth[0] <= 1e-12 && smooth[1] <= 1e-12 && rough[0] <= 1e-12, "{worst:?}");
}

/// Knots of both axes, a fraction of the maximum factor, heights and gradients.
type Given = (Vec<f64>, Vec<f64>, f64, Vec<f64>, Vec<[f64; 2]>);

/// Grids of unequal cells with data.
fn surfaces() -> impl Strategy<Value = Given> {
    let knots = |count: usize| {
        (prop::collection::vec(0.3..1.0_f64, count), -3.0..3.0_f64)
            .prop_map(|(steps, start)| crate::properties::knots(start, &steps))
    };
    (2..6_usize, 2..6_usize).prop_flat_map(move |(m, n)| {
        let count = (m + 1) * (n + 1);
        let z = prop::collection::vec(-1.0..1.0_f64, count);
        let d = prop::collection::vec(prop::array::uniform2(-4.0..4.0_f64), count);
        (knots(m), knots(n), -0.95..0.95_f64, z, d)
    })
}

/// Returns the narrowest cell of both axes, relative to its domain.
fn narrowest(axes: [&[f64]; 2]) -> f64 {
    let least = |knots: &[f64]| {
        let width = knots[knots.len() - 1] - knots[0];
        knots.windows(2).map(|pair| (pair[1] - pair[0]) / width).fold(1.0, f64::min)
    };
    least(axes[0]).min(least(axes[1]))
}

proptest! {
    #![proptest_config(config(32))]

    #[test]
    fn knots_are_hit_and_lines_of_the_grid_are_crossed_smoothly(
        (x, y, share, z, d) in surfaces(),
        along in 0.0..1.0_f64,
    ) {
        let factor = share * narrowest([&x, &y]);
        let surface = FoldedSurface::new(&x, &y, factor, &z, &d).unwrap();
        for (i, &px) in x.iter().enumerate() {
            for (j, &py) in y.iter().enumerate() {
                prop_assert_eq!(surface.height(px, py), z[i * y.len() + j]);
                prop_assert_eq!(surface.gradient(px, py).to_array(), d[i * y.len() + j]);
            }
        }
        let [wide, deep] = surface.domain();
        let most = surface.gradient_modulus(4e-9);
        let rise = surface.slope_range().map(Interval::magnitude);
        for (lines, place) in [
            (&x, (|line, s| [line, s]) as fn(f64, f64) -> [f64; 2]),
            (&y, |line, s| [s, line]),
        ] {
            let side = if std::ptr::eq(lines, &raw const x) { deep } else { wide };
            let s = side.lo + along * side.width();
            for &line in &lines[1..lines.len() - 1] {
                let [a, b] = [line - 1e-9, line + 1e-9].map(|line| place(line, s));
                let change = (surface.height(a[0], a[1]) - surface.height(b[0], b[1])).abs();
                prop_assert!(change <= 2e-9 * (rise[0] + rise[1]) + 1e-11, "{a:?} {b:?}: {change}");
                let change = surface.gradient(a[0], a[1]) - surface.gradient(b[0], b[1]);
                prop_assert!(change.abs().max_element() <= most, "{a:?} {b:?}: {change} over {most}");
            }
        }
    }

    #[test]
    fn folded_tolerance_is_within_bound(
        (x, y, share, z, d) in surfaces(),
        at in prop::array::uniform2(-0.1..1.1_f64),
    ) {
        let surface = FoldedSurface::new(&x, &y, share * narrowest([&x, &y]), &z, &d).unwrap();
        let [wide, deep] = surface.domain();
        let (px, py) = (wide.lo + at[0] * wide.width(), deep.lo + at[1] * deep.width());
        tolerances_hold(&surface, px, py)?;
    }

    #[test]
    fn folded_functional_equation(
        (x, y, share, z, d) in surfaces(),
        at in prop::array::uniform2(0.0..1.0_f64),
    ) {
        // f − H with factor s is s w∘Φ, and w = f − G does not depend on the cell: compare two
        // points with the same image.
        let factor = share * narrowest([&x, &y]);
        let surface = FoldedSurface::new(&x, &y, factor, &z, &d).unwrap();
        let smooth = FoldedSurface::new(&x, &y, 0.0, &z, &d).unwrap();
        let mirrored = |i: usize| if i.is_multiple_of(2) { at[0] } else { 1.0 - at[0] };
        let py = y[0] + at[1] * (y[1] - y[0]);
        let rest = |i: usize| {
            let px = x[i] + mirrored(i) * (x[i + 1] - x[i]);
            surface.height(px, py) - smooth.height(px, py)
        };
        for i in 1..x.len() - 1 {
            prop_assert!((rest(i) - rest(0)).abs() < 1e-12, "cell {i}: {} and {}", rest(i), rest(0));
        }
    }

    #[test]
    fn folded_bounds_contain_samples(
        (x, y, share, z, d) in surfaces(),
        corner in prop::array::uniform2(-0.1..1.0_f64),
        size in prop::array::uniform2(-12.0..0.2_f64),
        samples in prop::collection::vec(prop::array::uniform2(0.0..=1.0_f64), 60),
    ) {
        let surface = FoldedSurface::new(&x, &y, share * narrowest([&x, &y]), &z, &d).unwrap();
        let [wide, deep] = surface.domain();
        let part = |side: Interval, k: usize| {
            let lo = side.lo + corner[k] * side.width();
            Interval::new(lo, lo + size[k].exp2() * side.width())
        };
        bounds_hold(&surface, [part(wide, 0), part(deep, 1)], &samples, Some(1e-9))?;
    }
}

#[test]
fn folded_extrema_contain_grid_samples() {
    for (surface, _) in references() {
        let grid = extrema_hold_a_grid(&surface, surface.domain(), 150, 0.05);
        // The midpoint rule on 150² points; measured 3e-5.
        assert_abs_diff_eq!(grid, surface.mean().value, epsilon = 3e-4, "{grid} {:?}", surface.mean());
    }
}

#[test]
fn folded_surface_outside_the_domain_and_nan() {
    for (surface, _) in references() {
        let [x, y] = surface.domain();
        assert!(surface.evaluate(f64::NAN, y.lo, 0.0).value.is_nan());
        assert!(surface.gradient(x.lo, f64::NAN).y.is_nan() && surface.normal(f64::NAN, 0.0).z.is_nan());
        for far in [1e9, 1e300, f64::INFINITY] {
            assert_eq!(surface.height(far, -far), surface.height(x.hi, y.lo));
            assert_eq!(surface.gradient(-far, 0.3), surface.gradient(x.lo, 0.3));
        }
        for tolerance in [f64::NAN, -1.0, f64::INFINITY, 1e9] {
            let got = surface.evaluate(1.3, 0.4, tolerance);
            assert!((got.value - surface.height(1.3, 0.4)).abs() <= got.bound, "{tolerance}: {got:?}");
        }
        let entire = surface.bounds(Interval::ENTIRE, y).height;
        assert!(entire.lo <= surface.range().lo + 1e-9 && surface.range().hi - 1e-9 <= entire.hi);
        assert_eq!(surface.bounds(Interval::EMPTY, y).height, surface.range());
        assert_eq!(surface.bounds(Interval::new(0.0, f64::NAN), y).height, surface.range());
        assert_eq!(surface.clone().height(1.1, 0.2), surface.height(1.1, 0.2));
    }
}

#[test]
fn folded_errors_name_the_parameter() {
    let (z, d) = ([0.5; 9], [[0.0; 2]; 9]);
    let (x, y) = ([0.0, 1.0, 4.0], [0.0, 1.0, 2.0]);
    let new = |x: &[f64], y: &[f64], factor, z: &[f64], d: &[[f64; 2]]| {
        FoldedSurface::new(x, y, factor, z, d).err()
    };
    assert_eq!(new(&x, &y, 0.249, &z, &d), None);
    for factor in [0.25, -0.3, f64::NAN, f64::INFINITY] {
        let error = new(&x, &y, factor, &z, &d).unwrap();
        let FifError::SurfaceScaling { max: ratio, .. } = error else { panic!("{error}") };
        assert_eq!(ratio, 0.25);
        assert_eq!(error.to_string(), format!("`scaling` must be under 0.25 in magnitude, got {factor}"));
    }
    assert!(matches!(new(&y, &x, 0.3, &z, &d), Some(FifError::SurfaceScaling { .. })));
    assert_eq!(new(&[], &y, 0.1, &[], &[]), Some(FifError::TooFew { parameter: "x", min: 3, got: 0 }));
    assert_eq!(
        new(&x, &y[1..], 0.1, &z[..6], &d[..6]),
        Some(FifError::TooFew { parameter: "y", min: 3, got: 2 })
    );
    for bad in [1.0, 0.5, f64::INFINITY, 1.0 + 1e-12] {
        let error = new(&[0.0, 1.0, bad, 4.0], &y, 0.1, &z, &d);
        assert!(
            matches!(error, Some(FifError::NotIncreasing { parameter: "x", index: 2, .. })),
            "{bad}: {error:?}"
        );
    }
    assert!(matches!(
        new(&x, &[0.0, f64::NAN, 2.0], 0.1, &z, &d),
        Some(FifError::NotIncreasing { parameter: "y", index: 1, .. })
    ));
    let error = new(&[f64::NEG_INFINITY, 0.0, 1.0], &y, 0.1, &z, &d);
    assert!(matches!(error, Some(FifError::NotIncreasing { parameter: "x", index: 0, .. })), "{error:?}");
    let length = FifError::Length { parameter: "z", expected: 9, got: 8 };
    assert_eq!(new(&x, &y, 0.1, &z[1..], &d), Some(length));
    let (mut dented, mut steep) = (z, d);
    dented[5] = f64::NAN;
    assert!(matches!(new(&x, &y, 0.1, &dented, &d), Some(FifError::NodeNotFinite { node: [1, 2], .. })));
    steep[6][1] = f64::INFINITY;
    assert!(matches!(new(&x, &y, 0.1, &z, &steep), Some(FifError::NodeNotFinite { node: [2, 0], .. })));
    assert!(matches!(new(&x, &y, 0.1, &[1e308; 9], &[[1e308; 2]; 9]), Some(FifError::TooLarge { .. })));
}

#[test]
fn folded_anisotropy_is_below_a_product() {
    // Eight unequal cells along each side: equal cells have their waves on the axes of the
    // spectrum's grid.
    let knots: Vec<f64> = (0..=8_u32)
        .map(|k| f64::from(k) / 8.0 + if k % 8 == 0 { 0.0 } else { 0.019 * (f64::from(k % 2) - 0.5) })
        .collect();
    let mut random = Random(5);
    let z = numbers(&mut random, 81, 2.0);
    let d = numbers(&mut random, 162, 12.0).as_chunks().0.to_vec();
    let surface = FoldedSurface::new(&knots, &knots, 0.9 * narrowest([&knots; 2]), &z, &d).unwrap();
    let slopes = |x: f64, y: f64| surface.evaluate_gradient(x, y, 1e-3).map(|slope| slope.value);
    let folded = grain(slopes, |t| (PI * t).sin().powi(2));
    // Measured 1.1, compared with 6.57 for a product and 0.19 for a torus. With equal cells 3.9.
    assert!(1.0 < folded && folded < 2.0, "{folded}");
}
