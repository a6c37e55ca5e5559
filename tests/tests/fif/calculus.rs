//! Integrals, moments, powers and inner products against exact rationals, and their properties.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its reference has failed")]

use asperity_fif::{Estimate, Fif};
use asperity_tests::fif_systems::{Reference, decimal, ratio, read};
use asperity_tests::{assert_abs_diff_eq, systems};
use proptest::prelude::*;

use super::properties::{affine, config, hermite};

/// Maximum allowed relative error, times the reported conditioning. The maximum measured is noted
/// next to each test.
const EXACT: f64 = 1e-12;

/// Compares with the exact value, and returns the error relative to `|want|` and the conditioning.
/// `ends` is the effect of rounding rational ends of the interval to doubles, included in the
/// bound, in these units.
fn close(name: &str, got: Estimate, want: f64, ends: f64) -> f64 {
    let full = (got.value - want).abs();
    let error = (full - ends).max(0.0);
    assert!(error <= got.bound + f64::EPSILON * want.abs(), "{name}: {got:?} != {want}, error {error:e}");
    if want == 0.0 { full } else { full / (want.abs() * got.condition + ends / f64::EPSILON) }
}

fn moments<const C: usize>(name: &str) -> f64 {
    let r = Reference::<C>::load(name);
    let mut worst = 0.0_f64;
    for k in 0..=6 {
        let got = r.system.moment(k, 1).unwrap();
        worst = worst.max(close(&format!("{name} moment {k}"), got, r.moment(k), 0.0));
    }
    for (p, k) in (2..=4).flat_map(|p| (0..=2).map(move |k| (p, k))) {
        let want = decimal(&r.json["power_dec"][format!("int_x^{k}_f^{p}")]);
        let got = r.system.moment(k, p).unwrap();
        worst = worst.max(close(&format!("{name} ∫ x^{k} f^{p}"), got, want, 0.0));
    }
    worst
}

#[test]
fn moments_and_powers_match_exact_rationals() {
    let worst = systems!(moments);
    println!("{worst:?}");
    assert!(worst.iter().all(|&worst| worst <= EXACT), "{worst:?}");
}

fn cumulative<const C: usize>(name: &str) -> f64 {
    let r = Reference::<C>::load(name);
    let f = &r.system;
    let x0 = f.domain().lo;
    let far = f.domain().magnitude();
    let ulp = far * f64::EPSILON;
    let mut worst = 0.0_f64;
    for point in r.json["points"].as_array().unwrap() {
        let field = |key: &str| point[key].as_str().unwrap();
        let x = ratio(field("x"));
        for (key, got, slope) in [
            ("int1", f.integral_over(x0, x), r.scale()),
            ("int1", f.nth_integral(1, x).unwrap(), r.scale()),
            ("int2", f.nth_integral(2, x).unwrap(), r.scale() * f.domain().width()),
            ("mom1", f.moment_over(1, 1, x0, x).unwrap(), far * r.scale()),
            ("mom2", f.moment_over(2, 1, x0, x).unwrap(), far * far * r.scale()),
            ("intsq", f.moment_over(0, 2, x0, x).unwrap(), r.scale() * r.scale()),
        ] {
            let got = close(&format!("{name} {key} to {x}"), got, ratio(field(key)), ulp * slope);
            worst = worst.max(got);
        }
    }
    for (l, right, want) in r.integrals() {
        let got = f.integral_over(l, right);
        worst = worst.max(close(&format!("{name} ∫ from {l} to {right}"), got, want, 2.0 * ulp * r.scale()));
    }
    worst
}

#[test]
fn cumulative_moments_match_exact_rationals() {
    let worst = systems!(cumulative);
    println!("{worst:?}");
    assert!(worst.iter().all(|&worst| worst <= EXACT), "{worst:?}");
}

/// Runs `$with` on the system of this name, for any number of coefficients.
macro_rules! with_system {
    ($name:expr, $system:ident => $with:expr) => {
        match $name {
            "cantor" => with_system!(1, $name, $system, $with),
            "paper_f_int" | "paper_g_int" => with_system!(3, $name, $system, $with),
            "paper_f_int2" | "cubic5" => with_system!(4, $name, $system, $with),
            _ => with_system!(2, $name, $system, $with),
        }
    };
    ($c:literal, $name:expr, $system:ident, $with:expr) => {{
        let $system = &Reference::<$c>::load($name).system;
        $with
    }};
}

#[test]
fn inner_products_match_exact_rationals() {
    let pairs = read("inner_products");
    let mut worst = 0.0_f64;
    for pair in pairs.as_array().unwrap() {
        let (left, right) = (pair["f"].as_str().unwrap(), pair["g"].as_str().unwrap());
        let want = decimal(&pair["dec"]);
        let (one, other) = with_system!(left, f => with_system!(right, g => {
            (f.inner_product(g).unwrap(), g.inner_product(f).unwrap())
        }));
        for got in [one, other] {
            worst = worst.max(close(&format!("∫ {left} {right}"), got, want, 0.0));
        }
    }
    println!("{worst:e}");
    assert!(worst <= EXACT, "{worst:e}");
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn integrals_are_additive(
        f in affine(0.999), s in prop::array::uniform3(0.0..1.0_f64), k in 0_usize..4, p in 1_usize..4, short in 0_i32..40,
    ) {
        let [l, r, m] = s.map(|s| f.domain().lo + s * f.domain().width());
        // Intervals of any length.
        let r = l + (r - l) * 0.5_f64.powi(short);
        let m = l + (r - l) * ((m - f.domain().lo) / f.domain().width());
        let whole = f.moment_over(k, p, l, r).unwrap();
        let parts = [f.moment_over(k, p, l, m).unwrap(), f.moment_over(k, p, m, r).unwrap()];
        let bound = whole.bound + parts[0].bound + parts[1].bound;
        let sum = parts[0].value + parts[1].value;
        prop_assert!((whole.value - sum).abs() <= bound, "{whole:?} {parts:?}");
        let back = f.moment_over(k, p, r, l).unwrap();
        prop_assert_eq!(back.value, -whole.value);
        // f¹ x⁰ is the plain integral.
        let (plain, general) = (f.integral_over(l, r), f.moment_over(0, 1, l, r).unwrap());
        prop_assert!((plain.value - general.value).abs() <= plain.bound + general.bound, "{plain:?} {general:?}");
    }

    #[test]
    fn integrals_and_values_are_linear(
        f in affine(0.95), y in prop::collection::vec(-2.0..2.0_f64, 65), c in -3.0..3.0_f64,
        s in prop::array::uniform2(0.0..1.0_f64),
    ) {
        let x: Vec<f64> = f.pieces().iter().map(|p| p.x()[0]).chain([f.domain().hi]).collect();
        let alpha: Vec<f64> = f.pieces().iter().map(|p| p.map().alpha).collect();
        let g: Fif<2> = Fif::affine(&x, &y[..x.len()], &alpha).unwrap();
        let sum = f.scaled(c).unwrap().sum(&g).unwrap();
        let [l, r] = s.map(|s| f.domain().lo + s * f.domain().width());
        let [of_f, of_g, of_sum] = [&f, &g, &sum].map(|f| f.integral_over(l, r));
        let bound = c.abs() * of_f.bound + of_g.bound + of_sum.bound;
        prop_assert!((c * of_f.value + of_g.value - of_sum.value).abs() <= bound, "{of_f:?} {of_g:?} {of_sum:?}");
        let [at_f, at_g, at_sum] = [&f, &g, &sum].map(|f| f.evaluate(l, 1e-13));
        let bound = c.abs() * at_f.bound + at_g.bound + at_sum.bound;
        prop_assert!((c * at_f.value + at_g.value - at_sum.value).abs() <= bound, "{at_f:?} {at_g:?} {at_sum:?}");
        // ⟨f, c f + g⟩ = c ⟨f, f⟩ + ⟨f, g⟩, and ⟨f, f⟩ is the square of the norm.
        let [ff, fg, fs] = [&f, &g, &sum].map(|g| f.inner_product(g).unwrap());
        let bound = c.abs() * ff.bound + fg.bound + fs.bound;
        prop_assert!((c * ff.value + fg.value - fs.value).abs() <= bound, "{ff:?} {fg:?} {fs:?}");
        let norm = f.norm_squared().unwrap();
        prop_assert!((norm.value - ff.value).abs() <= norm.bound + ff.bound, "{norm:?} {ff:?}");
        prop_assert!(fg.value * fg.value <= ff.value * g.norm_squared().unwrap().value * (1.0 + 1e-9), "{fg:?}");
    }

    #[test]
    fn integral_of_the_derivative_is_the_function(f in hermite(), s in prop::array::uniform2(0.0..1.0_f64)) {
        let (domain, slope): (_, Fif<3>) = (f.domain(), f.derivative().unwrap());
        let [l, r] = s.map(|s| domain.lo + s * domain.width());
        let integral = slope.integral_over(l, r);
        let [low, high] = [l, r].map(|x| f.evaluate(x, 0.0));
        // The points of the values are also rounded.
        let points = 32.0 * f64::EPSILON * domain.magnitude() * slope.range().magnitude();
        let bound = integral.bound + low.bound + high.bound + points;
        prop_assert!((integral.value - (high.value - low.value)).abs() <= bound, "{integral:?} {low:?} {high:?}");
    }

    #[test]
    fn jets_equal_differences_of_integrals(f in affine(0.95), s in 0.0..1.0_f64, size in 1_i32..16) {
        let integral: Fif<3> = f.integral(0.0).unwrap();
        let l = f.domain().lo + 0.9 * s * f.domain().width();
        let r = l + 0.1 * f.domain().width() * 0.1_f64.powi(size);
        let mean = f.mean(l, r);
        let values = f.extrema_over(l, r, 1e-3).unwrap().enclosure();
        prop_assert!(values.inflated(mean.bound).contains(mean.value), "{mean:?} not in {values:?}");
        let [low, high] = [l, r].map(|x| integral.evaluate(x, 0.0));
        let points = 32.0 * f64::EPSILON * f.domain().magnitude() * f.range().magnitude();
        let bound = (low.bound + high.bound + points) / (r - l) + mean.bound;
        let quotient = (high.value - low.value) / (r - l);
        prop_assert!((quotient - mean.value).abs() <= bound, "{quotient} {mean:?}");
        // The n-th integral at a point, by moments and by its own system.
        let twice: Fif<4> = integral.integral(0.0).unwrap();
        let (by_moment, by_system) = (f.nth_integral(2, r).unwrap(), twice.evaluate(r, 0.0));
        let points = points * f.domain().width() * 4.0;
        let bound = by_moment.bound + by_system.bound + points;
        prop_assert!((by_moment.value - by_system.value).abs() <= bound, "{by_moment:?} {by_system:?}");
    }
}

#[test]
fn mean_of_short_interval_keeps_precision() {
    // f = x on uneven maps, as a fractal function with steep factors: the mean of an interval is
    // its center.
    let x = [0.0, 0.25, 1.0];
    let q = [[0.0, -0.25], [0.25, 0.0]];
    let straight: Fif<2> = Fif::new(&x, &[0.5, 0.75], &q).unwrap();
    for exponent in [-4, -20, -40] {
        let (l, r) = (0.375, 0.375 + 2f64.powi(exponent));
        let mean = straight.mean(l, r);
        let want = 0.5 * (l + r);
        assert_abs_diff_eq!(mean.value, want, epsilon = 4.0 * f64::EPSILON, "2^{exponent}");
        assert!((mean.value - want).abs() <= mean.bound, "2^{exponent}: {mean:?} != {want}");
    }
}

#[test]
fn integral_of_empty_and_undefined_intervals() {
    let f = Reference::<4>::load("cubic5").system;
    assert_eq!(f.integral_over(0.3, 0.3).value, 0.0);
    assert_eq!(f.integral_over(-9.0, -3.0).value, 0.0);
    assert_eq!(f.mean(0.3, 0.3).value, f.evaluate(0.3, 0.0).value);
    assert_eq!(f.integral_over(f64::NEG_INFINITY, f64::INFINITY), f.integral_over(-3.0, 2.0));
    for (l, r) in [(f64::NAN, 0.0), (0.0, f64::NAN)] {
        assert!(f.integral_over(l, r).value.is_nan() && f.mean(l, r).value.is_nan());
        assert!(f.moment_over(1, 2, l, r).unwrap().value.is_nan());
    }
    assert!(f.nth_integral(2, f64::NAN).unwrap().value.is_nan());
    assert_eq!(f.moment(30, 1).unwrap_err().to_string(), "degree of `x^k f^p` must be at most 32, got 33");
    assert_eq!(f.moment(0, 9).unwrap_err().to_string(), "`p` must be between 0 and 8, got 9");
    assert!(f.moment(usize::MAX, 8).is_err() && f.nth_integral(99, 1.0).is_err());
}

/// 64 maps, factors 0.999, cells from 10⁻⁹ of the domain: every bound holds, and everything
/// terminates.
#[test]
fn integral_bounds_of_near_critical_systems_hold() {
    let mut x = vec![0.0];
    for j in 0..63 {
        x.push(x[j] + if j % 2 == 0 { 1e-9 } else { 1.0 });
    }
    x.push(x[63] + 1.0);
    let y: Vec<f64> = (0..65).map(|j| f64::from(j % 3) - 0.7).collect();
    let alpha: Vec<f64> = (0..64).map(|j| if j % 5 < 2 { -0.999 } else { 0.999 }).collect();
    let f: Fif<2> = Fif::affine(&x, &y, &alpha).unwrap();
    let wide: Fif<2> = Fif::affine(&[0.0, 1.0, 1.0 + 1e-9], &[0.0, 1.0, 0.3], &[0.999, -0.999]).unwrap();
    for f in [&f, &wide] {
        let [l, m, r] = [0.1, 0.4, 0.9].map(|s| s * f.domain().hi);
        for (k, p) in [(0, 1), (2, 1), (0, 2), (1, 3)] {
            let [left, right, whole] =
                [(l, m), (m, r), (l, r)].map(|(l, r)| f.moment_over(k, p, l, r).unwrap());
            let bound = left.bound + right.bound + whole.bound;
            assert!((left.value + right.value - whole.value).abs() <= bound, "{left:?} {right:?} {whole:?}");
            assert!(whole.bound.is_finite(), "{whole:?}");
            println!("{k} {p} {whole:?}");
        }
    }
}
