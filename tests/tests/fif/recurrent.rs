//! Recurrent systems: the functional equation, and agreement with systems whose sources are the
//! whole domain.

use asperity_fif::{Fif, FifError, RecurrentFif, System};
use asperity_tests::assert_abs_diff_eq;
use proptest::prelude::*;

use crate::properties::{affine, config};

/// Knots 0 to 8, sources of 2, 4 or 8 maps: every orbit of a double with few bits is exact.
fn dyadic(steepest: f64) -> impl Strategy<Value = RecurrentFif<3>> {
    let source = (1_u32..=3, 0_usize..7).prop_map(|(bits, from)| {
        let wide = 1 << bits;
        let from = from.min(8 - wide);
        [from, from + wide]
    });
    let list = |range: std::ops::Range<f64>, len| prop::collection::vec(range, len);
    let sources = prop::collection::vec(source, 8);
    (list(-2.0..2.0, 9), list(-steepest..steepest, 8), list(-1.0..1.0, 8), sources).prop_map(
        |(y, alpha, bend, sources)| {
            let x: Vec<f64> = (0..=8).map(f64::from).collect();
            // A line through both ends, and a parabola that vanishes there.
            let q: Vec<[f64; 3]> = (0..8)
                .map(|j| {
                    let [from, to] = sources[j];
                    let (l, r) = (x[from], x[to]);
                    let ends = [y[j] - alpha[j] * y[from], y[j + 1] - alpha[j] * y[to]];
                    let slope = (ends[1] - ends[0]) / (r - l);
                    [ends[0] - slope * l + bend[j] * l * r, slope - bend[j] * (l + r), bend[j]]
                })
                .collect();
            RecurrentFif::new(&x, &y, &alpha, &q, &sources).expect("the data are in order")
        },
    )
}

/// Recurrent systems on arbitrary knots.
fn uneven(steepest: f64) -> impl Strategy<Value = (RecurrentFif<2>, Vec<f64>)> {
    (affine(steepest), prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), 64)).prop_map(|(f, choices)| {
        let (x, y, alpha) = data(&f);
        let maps = alpha.len();
        let sources: Vec<[usize; 2]> = choices
            .iter()
            .take(maps)
            .enumerate()
            .map(|(j, (l, r))| {
                // At least two maps, including the map itself: wider than its image.
                let from = ((j as f64 + 1.0) * l) as usize;
                let to = (j + 1 + ((maps - j) as f64 * r) as usize).min(maps);
                if to - from > 1 { [from, to] } else { [0, maps] }
            })
            .collect();
        (RecurrentFif::affine(&x, &y, &alpha, &sources).expect("the data are in order"), y)
    })
}

/// Knots, ordinates and factors.
fn data(f: &Fif<2>) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let pieces = f.pieces();
    let last = &pieces[pieces.len() - 1];
    (
        pieces.iter().map(|p| p.x()[0]).chain([last.x()[1]]).collect(),
        pieces.iter().map(|p| p.y()[0]).chain([last.y()[1]]).collect(),
        pieces.iter().map(|p| p.map().alpha).collect(),
    )
}

proptest! {
    #![proptest_config(config(96))]

    #[test]
    fn recurrent_functional_equation(f in dyadic(0.95), at in 0_u32..1 << 20, tolerance in -14.0..-2.0_f64) {
        let tolerance = 10_f64.powf(tolerance);
        let s = f64::from(at) / f64::from(1 << 20);
        for (piece, [from, to]) in f.pieces().zip(f.sources()) {
            let x = from as f64 + s * (to - from) as f64;
            let inner = f.evaluate(x, tolerance);
            let (image, want) = piece.map().apply(x, inner.value);
            let got = f.evaluate(image, tolerance);
            let error = (got.value - want).abs();
            prop_assert!(error <= got.bound + inner.bound + 1e-13, "{x}: {got:?}, {inner:?}, {want}");
            prop_assert!(got.bound <= tolerance.max(1e-10), "{got:?} to {tolerance:e}");
        }
    }

    #[test]
    fn integrals_obey_their_equation(f in dyadic(0.95), at in 0_u32..1 << 20) {
        let s = f64::from(at) / f64::from(1 << 20);
        for (j, (piece, [from, to])) in f.pieces().zip(f.sources()).enumerate() {
            let (l, wide) = (from as f64, (to - from) as f64);
            let x = l + s * wide;
            let [c0, c1, c2] = piece.map().q;
            let primitive = |x: f64| x * (c0 + x * (c1 / 2.0 + x * c2 / 3.0));
            let (whole, start) = (f.integral(x), f.integral(l));
            let part = piece.map().alpha * (whole.value - start.value) + primitive(x) - primitive(l);
            let (before, got) = (f.integral(j as f64), f.integral(j as f64 + s));
            let error = (got.value - before.value - part / wide).abs();
            let bound = got.bound + before.bound + (whole.bound + start.bound) / wide;
            prop_assert!(error <= bound + 1e-13 && bound < 1e-8, "{x}: {error:e}, {bound:e}");
        }
    }

    #[test]
    fn whole_sources_make_the_plain_system(f in affine(0.9), s in 0.0..1.0_f64) {
        let (x, y, alpha) = data(&f);
        let maps = alpha.len();
        let recurrent = RecurrentFif::affine(&x, &y, &alpha, &vec![[0, maps]; maps]).unwrap();
        let (domain, x) = (f.domain(), f.domain().lo + s * f.domain().width());
        let got = recurrent.evaluate(x, 1e-9);
        let near = 64.0 * f64::EPSILON * (domain.magnitude() + domain.width());
        let taken = f.extrema_over(x - near, x + near, 1e-9).unwrap().enclosure().inflated(got.bound);
        prop_assert!(taken.contains(got.value), "{x}: {got:?} {taken:?}");
        let (sum, want) = (recurrent.integral(x), f.integral_over(domain.lo, x));
        prop_assert!((sum.value - want.value).abs() <= sum.bound + want.bound, "{x}: {sum:?} {want:?}");
        let (range, extrema) = (recurrent.range(), f.extrema(1e-6));
        prop_assert!(range.lo <= extrema.minimum.hi && range.hi >= extrema.maximum.lo);
        // Measured: at most 2.5 times as wide.
        prop_assert!(range.width() <= 3.0 * (extrema.maximum.hi - extrema.minimum.lo), "{range:?} {extrema:?}");
    }

    #[test]
    fn ranges_hold_the_values_and_knots_are_exact((f, y) in uneven(0.99), s in prop::collection::vec(0.0..1.0_f64, 16)) {
        let pieces: Vec<_> = f.pieces().zip(f.ranges()).collect();
        for (piece, range) in &pieces {
            for (x, y) in piece.x().into_iter().zip(piece.y()) {
                let got = f.evaluate(x, 1e-6);
                prop_assert_eq!((got.value, got.bound), (y, 0.0));
                prop_assert!(range.contains(y) && f.range().contains(y));
            }
            for s in &s {
                let x = piece.x()[0] + s * (piece.x()[1] - piece.x()[0]);
                let (rough, fine) = (f.evaluate(x, 1e-4), f.evaluate(x, 0.0));
                prop_assert!((rough.value - fine.value).abs() <= rough.bound + fine.bound);
                prop_assert!(fine.bound < 1e-8, "{fine:?}");
                prop_assert!(range.inflated(fine.bound).contains(fine.value), "{x}: {fine:?} {range:?}");
                // Bounds of an integral from the bounds of the values.
                let sum = f.integral(x).value - f.integral(piece.x()[0]).value;
                let wide = x - piece.x()[0];
                let error = f.integral(x).bound + f.integral(piece.x()[0]).bound;
                prop_assert!(range.scaled(wide).inflated(error).contains(sum), "{x}: {sum} {range:?}");
            }
        }
        let ends = [f.evaluate(f64::NEG_INFINITY, 1e-9).value, f.evaluate(f64::INFINITY, 1e-9).value];
        prop_assert_eq!(ends, [y[0], y[y.len() - 1]]);
    }

    #[test]
    fn near_critical_systems_are_honest((f, _) in uneven(0.9999), s in 0.0..1.0_f64) {
        let x = f.domain().lo + s * f.domain().width();
        let (rough, fine) = (f.evaluate(x, 1e-3), f.evaluate(x, 0.0));
        prop_assert!((rough.value - fine.value).abs() <= rough.bound + fine.bound, "{rough:?} {fine:?}");
        prop_assert!(fine.bound < f.range().width() && f.range().inflated(fine.bound).contains(fine.value));
        prop_assert!(f.integral(x).bound.is_finite());
    }
}

#[test]
fn self_copying_half_equals_the_plain_system() {
    let (x, y) = ([0.0, 1.0, 2.0, 3.0, 4.0], [0.0, 1.0, 0.0, 1.0, 0.0]);
    let f = RecurrentFif::affine(&x, &y, &[0.5, 0.5, 0.0, 0.25], &[[0, 2], [0, 2], [0, 4], [2, 4]]).unwrap();
    let takagi = System::<Vec<_>, 2>::affine(&x[..3], &y[..3], &[0.5, 0.5]).unwrap();
    for k in 0..=200 {
        let x = f64::from(k) / 128.0;
        let (got, want) = (f.evaluate(x, 1e-12), takagi.evaluate(x, 1e-12));
        assert!((got.value - want.value).abs() <= got.bound + want.bound, "{x}: {got:?} {want:?}");
        let (got, want) = (f.integral(x), takagi.integral_over(0.0, x));
        assert!((got.value - want.value).abs() <= got.bound + want.bound, "{x}: {got:?} {want:?}");
    }
    // A straight line over the third map.
    assert_abs_diff_eq!(f.evaluate(2.3, 1e-12).value, 0.3, epsilon = 1e-14);
    for nan in [f.evaluate(f64::NAN, 1e-9), f.integral(f64::NAN)] {
        assert!(nan.value.is_nan() && nan.bound.is_nan());
    }
    let whole = f.integral(f64::INFINITY);
    assert_eq!((whole.value, f.integral(-3.0).value), (f.integral(4.0).value, 0.0));
}

#[test]
fn recurrent_errors_name_the_parameter() {
    let (x, y) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 0.0, 1.0]);
    let whole = [[0, 3]; 3];
    let says = |alpha: &[f64], sources: &[[usize; 2]], message: &str| {
        let error: FifError = RecurrentFif::affine(&x, &y, alpha, sources).unwrap_err();
        assert_eq!(error.to_string(), message);
    };
    let alpha = [0.5; 3];
    says(&alpha, &whole[1..], "`sources` must have 3 elements, got 2");
    says(&alpha, &[[0, 3], [2, 2], [0, 3]], "`sources` of map 2 must increase within 0 to 3, got 2 to 2");
    says(&alpha, &[[0, 3], [0, 3], [2, 4]], "`sources` of map 3 must increase within 0 to 3, got 2 to 4");
    says(&alpha, &[[1, 2], [0, 3], [0, 3]], "`sources` of map 1 must be wider than its image of 1, got 1");
    says(&[0.5, 1.0, 0.5], &whole, "`alpha` of map 2 must be in (-1, 1), got 1");
    says(&[0.5; 2], &whole, "`alpha` must have 3 elements, got 2");
    let q = [[0.0, 1.0 / 3.0], [1.0, -1.0 / 3.0], [0.0, 0.5]];
    let error = RecurrentFif::new(&x, &y, &[0.0; 3], &q, &whole).unwrap_err();
    assert_eq!(error.to_string(), "`q` of map 3 must send the right end to 1, got 1.5");
    let nan = RecurrentFif::new(&x, &y, &[0.0; 3], &[[f64::NAN]; 3], &whole).unwrap_err();
    assert_eq!(nan.to_string(), "`q` of map 1 must have a finite coefficient of x^0, got NaN");
}
