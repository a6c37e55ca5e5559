//! Value, slope and integral of one address, against exact rationals and against the systems of
//! derivative and integral.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its reference has failed")]

use asperity_fif::{Fif, FixedFif, Jet, Table, cochran_2000};
use asperity_tests::fif_systems::Reference;
use proptest::prelude::*;

use crate::properties::seeded;

/// Returns the maximum errors of value, slope and integral.
fn check_doubles<const C: usize>(name: &str) -> [f64; 3] {
    let r = Reference::<C>::load(name);
    let mut worst = [0.0_f64; 3];
    for tolerance in [1e-6, 1e-12, 0.0] {
        let jets = r.system.table(tolerance).unwrap();
        for p in r.doubles() {
            let got = jets.evaluate_jet(p.x);
            let parts = [(got.value, p.y), (got.slope, p.dy.unwrap()), (got.integral, p.int1)];
            for ((got, want), worst) in parts.into_iter().zip(&mut worst) {
                let error = (got.value - want).abs();
                // The reference is rounded.
                let slack = f64::EPSILON * want.abs();
                assert!(error <= got.bound + slack, "{name} x = {}: {got:?} != {want}", p.x);
                if tolerance < 1e-6 {
                    *worst = worst.max(error);
                }
            }
        }
    }
    worst
}

#[test]
fn jets_match_exact_rationals() {
    let worst = [
        check_doubles::<3>("paper_f_int"),
        check_doubles::<4>("paper_f_int2"),
        check_doubles::<3>("paper_g_int"),
    ];
    // Measured: at most 1.2e-13, 6.1e-13 and 8.6e-14.
    for errors in worst {
        for error in errors {
            assert!(error <= 1e-12, "{worst:?}");
        }
    }
}

/// Cubic systems through 3 to 17 equally spaced knots of `[0, 2]`, integrated twice: six
/// coefficients, three derivatives.
pub(super) fn smooth() -> impl Strategy<Value = Vec<Fif<6>>> {
    (2_usize..=16)
        .prop_flat_map(|maps| {
            let list = |len| prop::collection::vec(-1.0..1.0_f64, len);
            (list(maps + 1), list(maps + 1), list(maps))
        })
        .prop_filter_map("a derivative", |(y, slopes, share)| {
            let maps = share.len();
            let x: Vec<f64> = (0..=maps).map(|j| 2.0 * (j as f64 / maps as f64)).collect();
            let alpha: Vec<f64> = share.iter().map(|share| share * 0.95 / maps as f64).collect();
            let f = Fif::hermite(&x, &y, &slopes, &alpha).expect("the data are in order");
            let first: Fif<5> = f.integral(0.5).expect("the integral of a system is one");
            let second: Fif<6> = first.integral(-0.25).expect("the integral of a system is one");
            // Zero data may round to discontinuous derivatives.
            let mut all = vec![second];
            while let Some(Ok(next)) = all.last().filter(|_| all.len() < 4).map(Fif::derivative) {
                all.push(next);
            }
            (all.len() > 1).then_some(all)
        })
}

proptest! {
    #![proptest_config(seeded(0x001E_75AD, 48))]

    #[test]
    fn jets_equal_the_systems_of_derivative_and_integral(
        all in smooth(), s in prop::collection::vec(0.0..2.0_f64, 12), tolerance in -15.0..-2.0_f64,
    ) {
        let (f, d1) = (&all[0], &all[1]);
        let whole: Fif<7> = f.integral(0.0).unwrap();
        let tolerance = 10_f64.powf(tolerance);
        let jets = f.table(tolerance).unwrap();
        let bounds = jets.evaluate_jet(0.7).map(|part| part.bound);
        // Rounding leaves a few units of 1e-16 for each power of the radix.
        prop_assert!(bounds.value <= tolerance.max(1e-13) && bounds.slope <= tolerance.max(1e-11), "{bounds:?}");
        prop_assert!(bounds.integral <= tolerance.max(1e-12), "{bounds:?}");
        let knots = f.pieces().iter().map(|piece| piece.x()[1]);
        let beside = f.pieces().iter().flat_map(|piece| [piece.x()[0].next_up(), piece.x()[1].next_down()]);
        let tiny = [0.0, 1e-300, 1e-9, 9e-4, -1.0, f64::NEG_INFINITY, 3.0, f64::INFINITY];
        for x in s.into_iter().chain(knots).chain(beside).chain(tiny) {
            let (got, plain) = (jets.evaluate_jet(x), [f.evaluate(x, 0.0), d1.evaluate(x, 0.0), whole.evaluate(x, 0.0)]);
            for (got, want) in [(got.value, plain[0]), (got.slope, plain[1]), (got.integral, plain[2])] {
                prop_assert!((got.value - want.value).abs() <= got.bound + want.bound, "{x}: {got:?} {want:?}");
            }
            prop_assert_eq!(jets.jet(x), Jet {
                value: got.value.value, slope: got.slope.value, integral: got.integral.value,
            });
            for (got, f) in jets.derivatives::<4>(x).into_iter().zip(&all) {
                let want = f.evaluate(x, 0.0);
                prop_assert!((got.value - want.value).abs() <= got.bound + want.bound, "{x}: {got:?} {want:?}");
            }
        }
    }

    #[test]
    fn points_on_any_domain_are_a_few_units_off(
        y in prop::collection::vec(-1.0..1.0_f64, 6),
        slopes in prop::collection::vec(-1.0..1.0_f64, 6),
        share in prop::collection::vec(-0.7..0.7_f64, 5),
        x0 in -20.0..20.0_f64, width in 0.1..10.0_f64, s in prop::collection::vec(0.0..1.0_f64, 8),
    ) {
        let x: Vec<f64> = (0..=5).map(|j| x0 + width * (f64::from(j) / 5.0)).collect();
        let alpha: Vec<f64> = share.iter().map(|share| share / 5.0).collect();
        let f = Fif::hermite(&x, &y, &slopes, &alpha).unwrap();
        let d: Fif<4> = f.derivative().unwrap();
        let jets = f.table(1e-10).unwrap();
        for (&x, &y) in x.iter().zip(&y) {
            prop_assert_eq!(jets.jet(x).value, y);
        }
        for s in s {
            let (x, near) = (x0 + s * width, 8.0 * f64::EPSILON * f.domain().magnitude());
            let got = jets.evaluate_jet(x);
            for (f, got) in [(f.view(), got.value), (d.view(), got.slope)] {
                let taken = f.extrema_over(x - near, x + near, 1e-11).unwrap().enclosure();
                prop_assert!(taken.inflated(got.bound).contains(got.value), "{x}: {got:?} {taken:?}");
            }
            let want = f.integral_over(x0, x);
            let most = got.integral.bound + want.bound + near * f.range().magnitude();
            prop_assert!((got.integral.value - want.value).abs() <= most, "{x}: {got:?} {want:?}");
        }
    }

    #[test]
    fn lanes_have_the_bits_of_single_jets(all in smooth(), s in prop::collection::vec(-0.1..2.1_f64, 41)) {
        let jets = all[0].table(1e-12).unwrap();
        same_bits(&jets, &s);
    }

    #[test]
    fn bounds_fall_with_the_tolerance(all in smooth()) {
        let mut before = Jet { value: f64::INFINITY, slope: f64::INFINITY, integral: f64::INFINITY };
        for tolerance in [1.0, 1e-2, 1e-4, 1e-8, 1e-12, 1e-14, 0.0, f64::NAN] {
            let bounds = all[0].table(tolerance).unwrap().evaluate_jet(0.7).map(|part| part.bound);
            prop_assert!(bounds.value <= before.value && bounds.slope <= before.slope, "{bounds:?} {before:?}");
            prop_assert!(bounds.integral <= before.integral, "{bounds:?} {before:?}");
            before = bounds;
        }
    }
}

fn same_bits<const C: usize>(jets: &Table<C>, x: &[f64]) {
    let [mut value, mut slope, mut integral] = [0; 3].map(|_| vec![0.0; x.len()]);
    jets.jets(x, Jet { value: &mut value, slope: &mut slope, integral: &mut integral }).unwrap();
    for (i, &x) in x.iter().enumerate() {
        let one = jets.jet(x);
        let bits = |parts: [f64; 3]| parts.map(f64::to_bits);
        assert_eq!(
            bits([value[i], slope[i], integral[i]]),
            bits([one.value, one.slope, one.integral]),
            "{x}: {one:?}"
        );
    }
}

#[test]
fn jets_of_paper_functions_are_equal_in_simd() {
    let edges = [0.0, 1.0, 2.0, 0.5, 1.0_f64.next_down(), 1.0_f64.next_up(), 1e-5, 9e-4, 1.953e-3, -1.0, 3.0];
    let spread = (1..4000).map(|k| 2.0 * (f64::from(k) * 0.618_033_988_749_895).fract());
    let dyadic = (0..400).map(|k| f64::from(k * 41) / 8192.0);
    // Many bits to the left of the first digit.
    let low = (1..9000).map(|k| (f64::from(k) * 0.754_877_666_246_692_7).fract() / 200.0);
    let x: Vec<f64> = spread.chain(edges).chain(low).chain(dyadic).chain([f64::NAN, f64::INFINITY]).collect();
    for tolerance in [1e-3, 1e-12, 0.0] {
        same_bits(&cochran_2000::f_hat().unwrap().table(tolerance).unwrap(), &x);
        same_bits(&cochran_2000::g_hat().unwrap().table(tolerance).unwrap(), &x);
        // Radix 256.
        let twice: FixedFif<2, 4> = cochran_2000::g_hat().unwrap().integral(1.0).unwrap();
        same_bits(&twice.table(tolerance).unwrap(), &x);
    }
}

#[test]
fn jets_at_ends_knots_and_nan() {
    let f = cochran_2000::g_hat().unwrap().table(1e-12).unwrap();
    let g = cochran_2000::g().unwrap();
    for x in [f64::NEG_INFINITY, -1.0, 0.0] {
        assert_eq!(f.jet(x), Jet { value: 0.0, slope: 0.0, integral: 0.0 }, "{x}");
    }
    let [y0, y1] = f.system().end_values();
    assert_eq!(
        (y0, f.jet(1.0).value, f.evaluate_jet(1.0).value.bound),
        (0.0, f.system().pieces()[0].y()[1], 0.0)
    );
    for x in [2.0, 5.0, f64::INFINITY] {
        let end = f.evaluate_jet(x);
        assert_eq!((end.value.value, end.value.bound, end.slope.value), (y1, 0.0, g.end_values()[1]), "{x}");
        let whole = f.system().integral_over(0.0, 2.0);
        assert!((end.integral.value - whole.value).abs() <= end.integral.bound + whole.bound);
    }
    let nan = f.jet(f64::NAN);
    assert!(nan.value.is_nan() && nan.slope.is_nan() && nan.integral.is_nan());
    assert!(f.derivatives::<3>(f64::NAN).iter().all(|part| part.value.is_nan() && part.bound.is_nan()));
    assert!(f.derivatives::<3>(0.3)[2].value.is_nan());
}

#[test]
fn jets_without_tables() {
    // Slopes with factors near one, and 64 digits with a radix that is not a power of two: values
    // have tables, jets do not.
    let x: Vec<f64> = (0..=3).map(f64::from).collect();
    let steep = Fif::hermite(&x, &[0.0, 1.0, -1.0, 0.0], &[1.0, 0.5, -0.5, 0.25], &[0.333; 3]).unwrap();
    let (table, slope) = (steep.table(1e-9).unwrap(), steep.derivative::<Vec<_>, 3>().unwrap());
    for x in [0.3, 1.0, 2.9, f64::INFINITY] {
        let (got, want) = (table.evaluate_jet(x), slope.evaluate(x, 0.0));
        assert!((got.slope.value - want.value).abs() <= got.slope.bound + want.bound, "{x}");
        assert_eq!(got.integral.value, steep.integral_over(0.0, x).value);
    }
}

#[test]
fn jets_of_constants_and_polynomials() {
    let x = [0.0, 0.5, 1.0];
    let flat = Fif::<1>::new(&x, &[0.0; 2], &[[0.75]; 2]).unwrap();
    let jet = flat.table(1e-12).unwrap().evaluate_jet(0.3);
    assert_eq!((jet.value.value, jet.slope.value), (0.75, 0.0));
    assert!((jet.integral.value - 0.225).abs() <= jet.integral.bound);
    // x² on both halves, without a fractal part: every derivative exists.
    let square = Fif::<3>::new(&x, &[0.0; 2], &[[0.0, 0.0, 0.25], [0.25, 0.5, 0.25]]).unwrap();
    let jets = square.table(1e-12).unwrap();
    let jet = jets.evaluate_jet(0.3);
    let parts = [(jet.value, 0.09), (jet.slope, 0.6), (jet.integral, 0.009)];
    for (got, want) in parts {
        assert!((got.value - want).abs() <= got.bound + 1e-16, "{got:?} {want}");
    }
    let [_, _, second, third, fourth] = jets.derivatives(0.3);
    assert!(
        (second.value - 2.0).abs() <= second.bound && third.value.abs() <= third.bound,
        "{second:?} {third:?}"
    );
    assert!(fourth.value.is_nan());
}
