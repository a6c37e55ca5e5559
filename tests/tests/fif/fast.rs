//! Values from tables of composites, against exact rationals and against map-by-map evaluation.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its reference has failed")]

use asperity_fif::{Fif, FifError};
use asperity_tests::even_systems;
use asperity_tests::fif_systems::Reference;
use proptest::prelude::*;

use crate::jets::smooth;
use crate::properties::{affine_over, seeded};

fn check_doubles<const C: usize>(name: &str) -> [f64; 2] {
    let r = Reference::<C>::load(name);
    let mut worst = 0.0_f64;
    let mut bounds = [0.0; 2];
    for (bound, tolerance) in bounds.iter_mut().zip([1e-12, 0.0]) {
        let fast = r.system.table(tolerance).unwrap();
        *bound = fast.bound();
        for p in r.doubles() {
            let got = fast.evaluate(p.x);
            let error = (got.value - p.y).abs();
            assert!(
                error <= got.bound && got.bound <= fast.bound(),
                "{name} x = {}: {got:?} != {}",
                p.x,
                p.y
            );
            worst = worst.max(error);
        }
        for piece in r.system.pieces() {
            for (x, y) in piece.x().into_iter().zip(piece.y()) {
                let got = fast.evaluate(x);
                assert_eq!((got.value, got.bound), (y, 0.0), "{name} knot {x}");
            }
        }
    }
    assert!(worst <= 7e-13, "{name}: worst {worst:e}");
    bounds
}

#[test]
fn table_values_match_exact_rationals() {
    // Maximum measured errors: f 6.1e-13, takagi 3.0e-13, f integrated 1.2e-13, g and its integral
    // 4.4e-16; bounds up to 6.7e-13.
    for [bound, least] in even_systems!(check_doubles) {
        assert!(bound <= 1e-12 && least <= bound, "bounds {bound:e} {least:e}");
    }
}

/// Affine systems on 2 to 64 equally spaced knots of `[0, 1]`, factors of magnitude up to
/// `steepest`.
fn affine(steepest: f64) -> impl Strategy<Value = Fif<2>> {
    (2_usize..=64)
        .prop_flat_map(move |maps| {
            let y = prop::collection::vec(-2.0..2.0_f64, maps + 1);
            (y, prop::collection::vec(-steepest..steepest, maps))
        })
        .prop_map(|(y, alpha)| {
            let maps = alpha.len();
            let x: Vec<f64> = (0..=maps).map(|j| j as f64 / maps as f64).collect();
            Fif::affine(&x, &y, &alpha).expect("the data are in order")
        })
}

/// Affine systems on 2 to 64 unequal knots, gaps up to 1 : 100 000, factors of magnitude up to
/// `steepest`.
fn uneven(steepest: f64) -> impl Strategy<Value = Fif<2>> {
    affine_over(2..=64, -3.0..3.0, (-5.0..0.0_f64).prop_map(|gap| 10_f64.powf(gap)), -steepest..steepest)
}

/// Whether the function takes a value within sixteen units in the last place of the point.
fn taken_nearby(f: &Fif<2>, x: f64, value: f64, bound: f64) -> Result<(), TestCaseError> {
    let near = 16.0 * f64::EPSILON * f.domain().magnitude();
    let taken = f.extrema_over(x - near, x + near, 1e-9).unwrap().enclosure().inflated(bound);
    prop_assert!(taken.contains(value), "{x}: {value} ± {bound:e}, {taken:?}");
    Ok(())
}

proptest! {
    #![proptest_config(seeded(0x00FA_57F1, 12))]

    #[test]
    fn unequal_knots_have_values_of_points_nearby(f in uneven(0.9), s in prop::collection::vec(0.0..1.0_f64, 8)) {
        let mut before = f64::INFINITY;
        for tolerance in [1e-2, 1e-6, 1e-9, 0.0] {
            let fast = match f.table(tolerance) {
                Ok(fast) => fast,
                Err(error) => {
                    prop_assert!(matches!(error, FifError::TableDepth { alpha, .. } if alpha > 0.6), "{error}");
                    break;
                }
            };
            prop_assert!(fast.bound() <= before && fast.bound() <= tolerance.max(1e-10), "{:e}", fast.bound());
            before = fast.bound();
            for s in &s {
                let x = f.domain().lo + s * f.domain().width();
                let got = fast.evaluate(x);
                prop_assert!(got.bound <= fast.bound() && got.value == fast.value(x));
                taken_nearby(&f, x, got.value, got.bound)?;
            }
            for piece in f.pieces() {
                let got = fast.evaluate(piece.x()[0]);
                prop_assert_eq!((got.value, got.bound), (piece.y()[0], 0.0));
            }
        }
    }

    #[test]
    fn near_critical_unequal_knots_are_correct_or_an_error(f in uneven(0.999), s in 0.0..1.0_f64) {
        if let Ok(fast) = f.table(1e-4) {
            let x = f.domain().lo + s * f.domain().width();
            let got = fast.evaluate(x);
            taken_nearby(&f, x, got.value, got.bound)?;
        }
    }
}

proptest! {
    #![proptest_config(seeded(0x00FA_57F1, 64))]

    #[test]
    fn tables_agree_with_the_plain_evaluation(
        f in affine(0.95),
        x in prop::collection::vec(0.0..1.0_f64, 16),
        tolerance in prop::sample::select(vec![1e-3, 1e-6, 1e-12]),
    ) {
        // 64 steps exceed the tolerance only with so many maps that a single map makes a composite.
        let fast = match f.table(tolerance) {
            Ok(fast) => fast,
            Err(error) => {
                prop_assert!(matches!(error, FifError::TableDepth { alpha, .. } if alpha > 0.6), "{error}");
                return Ok(());
            }
        };
        prop_assert!(fast.bound() <= tolerance.max(1e-11), "{:e} for {tolerance:e}", fast.bound());
        for x in x.into_iter().chain([0.5, 1e-4, 1e-300, 1.0 - 1e-16]) {
            let (got, want) = (fast.evaluate(x), f.evaluate(x, 0.0));
            prop_assert!((got.value - want.value).abs() <= got.bound + want.bound, "{x}: {got:?} {want:?}");
            prop_assert!(got.bound <= fast.bound() && got.value == fast.value(x));
        }
    }

    #[test]
    fn tables_of_high_degree_agree_too(all in smooth(), x in prop::collection::vec(0.0..2.0_f64, 16)) {
        let f = &all[0];
        let fast = f.table(1e-12).expect("integrals are gentle");
        prop_assert!(fast.bound() <= 1e-12, "{:e}", fast.bound());
        for x in x {
            let (got, want) = (fast.evaluate(x), f.evaluate(x, 0.0));
            prop_assert!((got.value - want.value).abs() <= got.bound + want.bound, "{x}: {got:?} {want:?}");
        }
    }

    #[test]
    fn near_critical_tables_are_correct_or_an_error(f in affine(0.999), x in prop::collection::vec(0.0..1.0_f64, 8)) {
        let fast = match f.table(1e-9) {
            Ok(fast) => fast,
            Err(error) => {
                let honest = matches!(error, FifError::TableDepth { steps: 64, bound, .. } if bound > 1e-9);
                prop_assert!(honest && !f.pieces().len().is_power_of_two(), "{error}");
                return Ok(());
            }
        };
        for x in x {
            let (got, want) = (fast.evaluate(x), f.evaluate(x, 0.0));
            prop_assert!((got.value - want.value).abs() <= got.bound + want.bound, "{x}: {got:?} {want:?}");
        }
    }

    #[test]
    fn bounds_fall_with_the_tolerance(f in affine(0.9), x in 0.0..1.0_f64) {
        let mut before = [f64::INFINITY; 2];
        for tolerance in [1.0, 1e-2, 1e-4, 1e-8, 1e-12, 1e-14, 0.0] {
            let Ok(fast) = f.table(tolerance) else { break };
            let bounds = [fast.bound(), fast.evaluate(x).bound];
            prop_assert!(bounds[0] <= before[0] && bounds[1] <= before[1], "{tolerance:e}: {bounds:?} {before:?}");
            before = bounds;
        }
    }
}

#[test]
fn table_value_at_knots_of_narrow_cells() {
    for width in [1e-301, 1e-290, 1e-100, 1e-30, 1e-16_f64] {
        for x in [[0.0, width, 1.0], [0.0, 1.0, 1.0 + width.max(f64::EPSILON)], [-width, 0.0, 1.0]] {
            let f: Fif<2> = Fif::affine(&x, &[0.0, 1.0, 0.25], &[0.8, -0.5]).unwrap();
            let table = f.table(1e-6).unwrap();
            for (at, want) in x.into_iter().zip([0.0, 1.0, 0.25]) {
                assert_eq!([table.value(at), f.evaluate(at, 0.0).value], [want; 2], "{x:?} at {at:e}");
            }
            // f(width / 2) = 0.8 f(1/2) + …, both within their bounds of each other.
            let half = x[0] + 0.5 * (x[1] - x[0]);
            let [a, b] = [table.evaluate(half), f.evaluate(half, 0.0)];
            assert!((a.value - b.value).abs() <= a.bound + b.bound, "{x:?}: {a:?} {b:?}");
        }
    }
    let error = Fif::affine(&[0.0, 5e-324, 1.0], &[0.0, 1.0, 0.25], &[0.8, -0.9]).unwrap_err();
    assert!(matches!(error, FifError::NarrowCell { map: 1, .. }), "{error}");
}
