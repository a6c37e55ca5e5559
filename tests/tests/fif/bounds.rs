//! Extrema and their positions, enclosures, moduli, conditioning and dimension, up to nearly
//! non-contracting systems.

use asperity_fif::{Fif, Interval, Modulus, System, cochran_2000, system::Piece};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::fif_systems::{Reference, decimal, ratio, ratios, read};
use asperity_tests::systems;
use proptest::prelude::*;

use crate::properties::{affine_over, seeded};

/// Random affine systems: 2 to `maps` maps, cells of relative size at least `smallest`, factors of
/// magnitude up to `steepest`.
fn affine(maps: usize, smallest: f64, steepest: f64) -> impl Strategy<Value = Fif<2>> {
    let gap = (smallest.ln()..=0.0_f64).prop_map(f64::exp);
    affine_over(2..=maps, -5.0..5.0, gap, -steepest..=steepest)
}

/// Nearly non-contracting: up to 64 maps, cells down to a billionth, every factor of magnitude 0.9
/// to 0.999.
fn near_critical() -> impl Strategy<Value = Fif<2>> {
    let gap = (1e-9_f64.ln()..=0.0).prop_map(f64::exp);
    let factor = (0.9..=0.999_f64, prop::bool::ANY).prop_map(|(size, up)| if up { size } else { -size });
    affine_over(2..=64, 0.0..1e-9, gap, factor)
}

/// Returns `(x, f(x))` for at least `count` knots of deep levels, by the functional equation alone.
fn samples<S: AsRef<[Piece<C>]>, const C: usize>(f: &System<S, C>, count: usize) -> Vec<(f64, f64)> {
    let mut points = vec![(f.domain().lo, f.end_values()[0]), (f.domain().hi, f.end_values()[1])];
    while points.len() < count {
        points = f.pieces().iter().flat_map(|p| points.iter().map(|&(x, y)| p.map().apply(x, y))).collect();
    }
    points
}

/// Returns the error of a sample: 16 roundings of the polynomial per level, and the rounding of `x`
/// times its maximum slope.
fn rounding<S: AsRef<[Piece<2>]>>(f: &System<S, 2>) -> f64 {
    let (mut scale, mut steepest) = (f.range().magnitude(), 0.0_f64);
    for piece in f.pieces() {
        let [c0, c1] = piece.map().q;
        scale = scale.max(c0.abs() + c1.abs() * f.domain().magnitude());
        steepest = steepest.max(piece.map().alpha.abs());
    }
    16.0 * f64::EPSILON * scale / (1.0 - steepest)
}

#[test]
fn extrema_contain_the_reference_within_a_millionth() {
    fn check<const C: usize>(name: &str) {
        let r = Reference::<C>::load(name);
        let json = &r.json["extrema"];
        for width in [1e-3, 1e-9] {
            let e = r.system.extrema(width);
            for (key, got) in [("min", e.minimum), ("max", e.maximum)] {
                let end = |end: &str| json[format!("{key}_{end}")].as_f64().expect("a number");
                let range = r.system.range();
                assert!(got.width() <= width && range.hull(got) == range, "{name} {key}: {got:?} {range:?}");
                assert!(got.lo <= end("hi") && end("lo") <= got.hi, "{name} {key}: {got:?}");
            }
        }
        let e = r.system.extrema(1e-6);
        for (key, got, at, within) in [
            ("min", e.minimum, e.at_minimum, e.minimum_within),
            ("max", e.maximum, e.at_maximum, e.maximum_within),
        ] {
            let end = |end: &str| json[format!("{key}_{end}")].as_f64().expect("a number");
            // The exact extremum lies in the reference's bracket and in the crate's.
            assert!(
                got.lo <= end("hi") && end("lo") <= got.hi && got.width() <= 1e-6,
                "{name} {key}: {got:?}"
            );
            let candidate = &json[format!("{key}_candidate")];
            if candidate["inside_bounds"] == true {
                let value = decimal(&candidate["y_dec"]);
                assert!(got.inflated(1e-15).contains(value), "{name} {key}: {value} not in {got:?}");
                let place = ratio(candidate["x"].as_str().expect("a ratio"));
                assert!(within.inflated(1e-15).contains(place), "{name} {key}: {place} not in {within:?}");
            }
            // The certificate is consistent.
            let taken = r.system.enclosure(at.lo, at.hi, 1e-12).expect("a place in the domain");
            let good = if key == "max" { taken.hi >= got.lo } else { taken.lo <= got.hi };
            assert!(good && at.lo <= at.hi && at.width() < 1e-13, "{name} {key}: {at:?} {taken:?} {got:?}");
            assert!(within.hull(at) == within, "{name} {key}: {at:?} {within:?}");
        }
    }
    systems!(check);
}

#[test]
fn dimension_of_reference_systems_matches_closed_form() {
    fn dimension<const C: usize>(name: &str) -> Interval {
        Reference::<C>::load(name).system.dimension()
    }
    // Σ|α| ≤ 1.
    assert_eq!(dimension::<1>("cantor").hi, 1.0);
    assert_eq!(dimension::<2>("takagi").hi, 1.0);
    assert_eq!(dimension::<3>("paper_g_int").hi, 1.0);
    assert_eq!(dimension::<2>("parabola").hi, 1.0);
    let g = dimension::<2>("paper_g");
    assert!(g.contains(1.0 + 1.7_f64.log2()) && g.width() < 1e-13, "{g:?}");
    // Σ |α_j| a_j^{D−1} = 1 changes sign across the bracket.
    for (name, d) in [("nonuni3", dimension::<2>("nonuni3")), ("cubic5", dimension::<4>("cubic5"))] {
        let json = read(name);
        let list = |key: &str| ratios(&json[key]);
        let sum = |d: f64| -> f64 {
            list("a").iter().zip(list("alpha")).map(|(a, alpha)| alpha.abs() * a.powf(d - 1.0)).sum()
        };
        assert!(d.lo > 1.0 && d.hi < 2.0 && d.width() < 1e-13, "{name}: {d:?}");
        assert!(sum(d.lo - 1e-13) > 1.0 && sum(d.hi + 1e-13) < 1.0, "{name}: {d:?}");
    }
}

#[test]
fn dimension_matches_box_counting() {
    // Oscillation over 4^k cells grows like 4^{k (2 − D)}: the slope of its logarithm, over 4⁴ to
    // 4⁸ cells.
    let x = [0.0, 1.0, 2.0, 3.0, 4.0];
    let f = Fif::affine(&x, &[0.0, 1.0, -0.5, 0.7, 0.2], &[0.6, -0.7, 0.8, -0.5]).expect("data in order");
    let deep = samples(&f, 1 << 20);
    let variation = |level: u32| -> f64 {
        let cell = deep.len() >> (2 * level);
        deep.chunks(cell)
            .map(|c| {
                let range = c.iter().fold(Interval::EMPTY, |r, p| r.hull(Interval::new(p.1, p.1)));
                range.width()
            })
            .sum()
    };
    let slope = (variation(8) / variation(4)).ln() / (4.0 * 4.0_f64.ln());
    let d = f.dimension();
    // Measured: 0.021 apart.
    assert_abs_diff_eq!(1.0 + slope, d.middle(), epsilon = 0.03, "{} {d:?}", 1.0 + slope);
}

#[test]
fn conditioning_is_the_change_for_one_ulp() {
    let g = cochran_2000::g().expect("a valid system");
    let mut worst = 0.0_f64;
    for k in 1..200 {
        let x = f64::from(k) * 0.01 + 0.003;
        let moved = (g.evaluate(x.next_up(), 0.0).value - g.evaluate(x, 0.0).value).abs();
        let conditioning = g.conditioning(x);
        assert!(moved <= conditioning && conditioning < 0.01, "{x}: {moved} {conditioning}");
        assert!(conditioning <= 2.0 * g.modulus().at(16.0 * f64::EPSILON * 2.0), "{x}: {conditioning}");
        worst = worst.max(moved);
    }
    assert!((1e-4..2e-3).contains(&worst), "{worst}");
    let smooth = cochran_2000::g_hat().expect("a valid system");
    let worst = (1..200).map(|k| smooth.conditioning(f64::from(k) * 0.01)).fold(0.0, f64::max);
    assert!(worst < 1e-12, "{worst}");
}

#[test]
fn extrema_of_200000_maps_in_bounded_time() {
    // More maps than the cell budget: each is still visited once.
    let n = 200_000;
    let x: Vec<f64> = (0..=n).map(f64::from).collect();
    let y: Vec<f64> = (0..=n).map(|k| f64::from(k % 7)).collect();
    let f = Fif::affine(&x, &y, &vec![0.999; n as usize]).expect("the data are in order");
    let e = f.extrema(1e-6);
    assert!(e.maximum.lo >= 6.0 && e.minimum.hi <= 0.0 && e.maximum.hi <= f.range().hi, "{e:?}");
}

proptest! {
    #![proptest_config(seeded(0x000B_07D5, 24))]

    #[test]
    fn enclosures_contain_a_hundred_thousand_samples(
        f in affine(12, 1e-3, 0.95), s in prop::collection::vec(0.0..1.0_f64, 2),
    ) {
        let at = |s: f64| f.domain().lo + s * f.domain().width();
        let (l, r) = (at(s[0].min(s[1])), at(s[0].max(s[1])));
        let slack = rounding(&f);
        let part = f.extrema_over(l, r, 1e-3).expect("an interval within the domain");
        let short = f.enclosure(l, r, 1e-3).expect("an interval within the domain");
        prop_assert_eq!(short, part.enclosure());
        let whole = f.extrema(1e-4);
        let (mut top, mut bottom) = (f64::NEG_INFINITY, f64::INFINITY);
        for (x, y) in samples(&f, 100_000) {
            prop_assert!(f.range().inflated(slack).contains(y), "{x} {y} {:?}", f.range());
            prop_assert!(whole.enclosure().inflated(slack).contains(y), "{x} {y} {whole:?}");
            if l <= x && x <= r {
                prop_assert!(short.inflated(slack).contains(y), "{x} {y} {short:?}");
                (top, bottom) = (top.max(y), bottom.min(y));
            }
            // Points above the attained value lie in the position of the maximum.
            let near = 1e-13 * f.domain().magnitude();
            if y > whole.maximum.lo + slack {
                prop_assert!(whole.maximum_within.inflated(near).contains(x), "{x} {y} {whole:?}");
            }
            if y < whole.minimum.hi - slack {
                prop_assert!(whole.minimum_within.inflated(near).contains(x), "{x} {y} {whole:?}");
            }
        }
        // Measured: 0.075 of the range where the cell budget is exhausted, 1e-7 in most cases.
        let most = f64::max(1e-4, 0.1 * f.range().width());
        prop_assert!(whole.maximum.width() <= most && whole.minimum.width() <= most, "{whole:?}");
        prop_assert!(part.maximum.hi >= top - slack && part.minimum.lo <= bottom + slack);
    }

    #[test]
    fn modulus_bounds_every_difference(
        gentle in 0.1..1.4_f64, f in affine(8, 1e-2, 0.9), pairs in prop::collection::vec((0.0..1.0_f64, -40.0..0.0_f64), 200),
    ) {
        // The same knots with factors proportional to the cells: Lipschitz up to 1, Hölder beyond.
        let knots: Vec<f64> = f.pieces().iter().map(|p| p.x()[0]).chain([f.domain().hi]).collect();
        let y: Vec<f64> = f.pieces().iter().map(|p| p.y()[0]).chain([f.end_values()[1]]).collect();
        let share = |gentle: f64| -> Fif<2> {
            let alpha: Vec<f64> = f.pieces().iter().map(|p| (gentle * p.map().a).min(0.99).copysign(p.map().alpha)).collect();
            Fif::affine(&knots, &y, &alpha).expect("the data are in order")
        };
        for f in [f.clone(), share(gentle), share(1.0)] {
            let modulus = f.modulus();
            for &(s, log) in &pairs {
                let x = f.domain().lo + s * f.domain().width();
                let z = (x + log.exp() * f.domain().width()).min(f.domain().hi);
                let [a, b] = [x, z].map(|x| f.evaluate(x, 1e-13));
                let slack = a.bound + b.bound + if log < -20.0 { f.conditioning(x) + f.conditioning(z) } else { 1e-6 };
                prop_assert!((a.value - b.value).abs() <= modulus.at(z - x) + slack, "{x} {z} {modulus:?}");
            }
        }
        let expected = matches!(share(1.0).modulus(), Modulus::LogLipschitz { .. });
        prop_assert!(expected, "{:?}", share(1.0).modulus());
        let lipschitz = matches!(share(gentle).modulus(), Modulus::Lipschitz { .. });
        prop_assert!(lipschitz == (gentle < 1.0), "{:?}", share(gentle).modulus());
    }
}

proptest! {
    #![proptest_config(seeded(0x000B_07D5, 24))]

    #[test]
    fn near_critical_functional_equation_within_bound(
        f in near_critical(), j in 0_usize..64, s in 0.0..1.0_f64,
    ) {
        let map = *f.pieces()[j % f.pieces().len()].map();
        let x = f.domain().lo + s * f.domain().width();
        let (outer, _) = map.apply(x, 0.0);
        let [inner, image] = [x, outer].map(|x| f.evaluate(x, 1e-9));
        let want = map.apply(x, inner.value).1;
        // The bound excludes the conditioning, which is reported, and the rounding of the
        // right-hand side.
        let terms = inner.value.abs() + map.q[0].abs() + (map.q[1] * x).abs();
        let bound = image.bound + f.conditioning(outer)
            + map.alpha.abs() * (inner.bound + f.conditioning(x)) + 8.0 * f64::EPSILON * terms;
        prop_assert!((image.value - want).abs() <= bound, "{image:?} != {want} ± {bound:e}");
        prop_assert!(f.range().inflated(image.bound).contains(image.value), "{image:?}");
    }

    #[test]
    fn near_critical_knots_and_brackets(f in near_critical(), width in 1e-9..1.0_f64) {
        for piece in f.pieces() {
            for (x, y) in piece.x().into_iter().zip(piece.y()) {
                let got = f.evaluate(x, 1e-12);
                prop_assert_eq!((got.value, got.bound), (y, 0.0));
            }
        }
        let slack = rounding(&f);
        let e = f.extrema(width);
        let middle = f.domain().middle();
        let part = f.extrema_over(f.domain().lo, middle, width).expect("half of the domain");
        for (x, y) in samples(&f, 20_000) {
            prop_assert!(e.enclosure().inflated(slack).contains(y), "{x} {y} {e:?}");
            prop_assert!(x > middle || part.enclosure().inflated(slack).contains(y), "{x} {y} {part:?}");
        }
        for (bracket, at) in [(e.maximum, e.at_maximum), (e.minimum, e.at_minimum)] {
            prop_assert!(bracket.lo <= bracket.hi && f.range().contains(bracket.middle()), "{e:?}");
            prop_assert!(f.domain().contains(at.lo) && f.domain().contains(at.hi) && at.lo <= at.hi, "{e:?}");
        }
        let d = f.dimension();
        prop_assert!(d.lo >= 1.0 && d.hi <= 2.0 && d.lo <= d.hi && d.width() < 1e-9, "{d:?}");
    }
}

#[test]
fn interval_ending_next_to_a_knot_is_bracketed_to_the_width() {
    let f = cochran_2000::f_hat().unwrap();
    for k in 1..512 {
        let knot = f64::from(k) / 256.0;
        let cell = 2.0_f64.powi(-29);
        for (before, after) in [(2e-9, 1e-14), (cell + 1e-14, 1e-14), (1e-14, cell + 1e-14)] {
            let (l, r) = (knot - before, knot + after);
            let got = f.extrema_over(l, r, 0.5 * (r - l)).unwrap();
            // No knot of few maps is certain to lie inside; the slope is at most 2.
            assert!(got.enclosure().width() < 4.0 * (r - l), "[{l}, {r}]: {got:?}");
        }
    }
}
