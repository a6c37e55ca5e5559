//! Fits to data: recovered factors, reported errors, noise, knots, refinement.

use asperity_fif::{Fif, fit};
use asperity_tests::random::Random;
use proptest::prelude::*;

use crate::properties::{knots, seeded};

/// Returns a system whose knots are points of a grid invariant under all maps, and its samples
/// there.
fn samples(y: &[f64], alpha: &[f64], each: usize) -> (Fif<2>, Vec<f64>, Vec<f64>, Vec<usize>) {
    let maps = alpha.len();
    let knots: Vec<f64> = (0..=maps).map(|k| k as f64 / maps as f64).collect();
    let f = Fif::affine(&knots, y, alpha).expect("the data are in order");
    let points = maps * each;
    let x: Vec<f64> = (0..=points).map(|k| k as f64 / points as f64).collect();
    let at = |k: usize| {
        // By its digits, because the float nearest to k/points is another point.
        let mut rest = k;
        let address = std::iter::from_fn(move || {
            rest *= maps;
            let digit = (rest / points).min(maps - 1);
            rest -= digit * points;
            Some(digit)
        });
        f.value_at_address(address, 1e-14).expect("digits of the system").value
    };
    let values = (0..=points).map(at).collect();
    (f, x, values, (0..=maps).map(|k| k * each).collect())
}

proptest! {
    #![proptest_config(seeded(0x000F_1770, 64))]

    #[test]
    fn samples_of_a_function_give_its_factors_back(
        maps in 2_usize..=6, level in 2_u32..=3,
        y in prop::collection::vec(-2.0..2.0_f64, 7), alpha in prop::collection::vec(-0.95..0.95_f64, 6),
    ) {
        let (f, x, values, knots) = samples(&y[..=maps], &alpha[..maps], maps.pow(level));
        let fit = fit::affine(&x, &values, &knots).expect("the data are in order");
        // If v is nearly 0, the data determines nothing.
        let spread = f.range().width();
        prop_assume!(spread > 0.1);
        for (got, want) in fit.system.pieces().iter().zip(f.pieces()) {
            prop_assert!((got.map().alpha - want.map().alpha).abs() < 1e-9, "{got:?} {want:?}");
        }
        // If the samples are at doubles, only rounding remains.
        if maps == 2 || maps == 4 {
            prop_assert!(fit.rms < 1e-9 && fit.error < 1e-8, "{} {}", fit.rms, fit.error);
        }
        // Refinement does not diverge either.
        let refined = fit::refine(&x, &values, &knots, 3).expect("the data are in order");
        prop_assert!(refined.rms <= fit.rms);
    }

    #[test]
    fn reported_errors_match_measured_errors(
        gaps in prop::collection::vec(0.05..1.0_f64, 24), y in prop::collection::vec(-2.0..2.0_f64, 25),
        a in 1_usize..12, b in 12_usize..24,
    ) {
        let x = knots(-1.0, &gaps);
        let knots = [0, a, b, 24];
        for fit in [fit::affine(&x, &y, &knots), fit::refine(&x, &y, &knots, 10)] {
            let fit = fit.expect("the data are in order");
            let (mut worst, mut squares) = (0.0_f64, 0.0);
            for (&x, &y) in x.iter().zip(&y) {
                let miss = (fit.system.evaluate(x, 1e-13).value - y).abs();
                worst = worst.max(miss);
                squares += miss * miss;
            }
            prop_assert!(fit.error >= worst && fit.error <= worst * (1.0 + 1e-6) + 1e-9, "{} {worst}", fit.error);
            prop_assert!((fit.rms - (squares / 25.0).sqrt()).abs() < 1e-6 * (1.0 + worst), "{}", fit.rms);
            // The collage theorem, at the data and between.
            prop_assert!(fit.error <= fit.bound * (1.0 + 1e-6) + 1e-9, "{} {}", fit.error, fit.bound);
            for k in 0..100 {
                let s = x[0] + (x[24] - x[0]) * f64::from(k) / 99.0;
                let right = x.partition_point(|&knot| knot <= s).clamp(1, 24);
                let t = (s - x[right - 1]) / (x[right] - x[right - 1]);
                let polygon = y[right - 1] * (1.0 - t) + y[right] * t;
                let miss = (fit.system.evaluate(s, 1e-12).value - polygon).abs();
                let bound = fit.bound * (1.0 + 1e-6) + 1e-9;
                prop_assert!(miss <= bound || miss <= bound + fit.system.conditioning(s), "{s}: {miss} {bound}");
            }
        }
    }

    #[test]
    fn refinement_is_never_worse(
        y in prop::collection::vec(-2.0..2.0_f64, 33), cut in prop::collection::vec(1_usize..32, 1..8),
    ) {
        let x: Vec<f64> = (0..33).map(f64::from).collect();
        let mut knots = cut;
        knots.extend([0, 32]);
        knots.sort_unstable();
        knots.dedup();
        let collage = fit::affine(&x, &y, &knots).expect("the data are in order");
        let mut last = collage.rms;
        for steps in [0, 1, 3, 10] {
            let refined = fit::refine(&x, &y, &knots, steps).expect("the data are in order");
            prop_assert!(refined.rms <= last, "{steps}: {} > {last}", refined.rms);
            prop_assert!(refined.system.pieces().iter().all(|p| p.map().alpha.abs() <= 1.0 - 1.0 / 1024.0));
            last = refined.rms;
        }
    }
}

#[test]
fn noise_perturbs_factors_proportionally() {
    let alpha = [0.6, -0.5, 0.4, 0.7];
    let (f, x, clean, knots) = samples(&[0.0, 1.0, -1.0, 0.8, 0.3], &alpha, 256);
    let noise = 0.01;
    let mut random = Random(0x5EED);
    let noisy: Vec<f64> = clean
        .iter()
        .enumerate()
        // The knots are interpolated, so they are noise free.
        .map(|(k, y)| if k % 256 == 0 { *y } else { y + noise * 12.0_f64.sqrt() * (random.uniform() - 0.5) })
        .collect();
    let collage = fit::affine(&x, &noisy, &knots).expect("the data are in order");
    let refined = fit::refine(&x, &noisy, &knots, 10).expect("the data are in order");
    for fit in [&collage, &refined] {
        for (piece, want) in fit.system.pieces().iter().zip(f.pieces()) {
            // Deviation of a factor: about noise √2/√(255 ⟨v²⟩), ⟨v²⟩ > 0.25: 1.8e-3. Five times
            // that.
            let off = (piece.map().alpha - want.map().alpha).abs();
            assert!(off < 9e-3, "{off}: {} {}", piece.map().alpha, want.map().alpha);
        }
        // The residual is the noise.
        assert!(fit.rms > 0.9 * noise && fit.rms < 1.2 * noise, "{}", fit.rms);
    }
    assert!(refined.rms <= collage.rms);
}

#[test]
fn fit_finds_the_knots() {
    // The farthest point that fits is the end of a true segment, and each segment is found in turn.
    for (y, alpha) in [
        (&[0.0, 1.0, -1.0, 0.5][..], &[0.5, -0.4, 0.6][..]),
        (&[0.2, 1.0, 0.0, -0.7, 0.4], &[0.7, 0.3, -0.6, 0.5]),
    ] {
        let maps = alpha.len();
        let (_, x, values, knots) = samples(y, alpha, maps * maps);
        let found = fit::knots(&x, &values, 1e-9, usize::MAX).expect("the data are in order");
        assert_eq!(found, knots);
        // The conditioning at thirds: an ulp to the power of the Hölder exponent 0.46.
        assert!(fit::affine(&x, &values, &found).expect("the data are in order").error < 1e-6);
    }
    // Other data: every tolerance holds at the data, and smaller tolerances give more knots.
    let x: Vec<f64> = (0..=300).map(|k| f64::from(k) / 300.0).collect();
    let y: Vec<f64> = x.iter().map(|x| (9.0 * x).sin() + 0.2 * (50.0 * x * x).sin()).collect();
    let mut last = 0;
    for tolerance in [0.5, 0.1, 0.02, 0.004] {
        let knots = fit::knots(&x, &y, tolerance, 100).expect("the data are in order");
        let fit = fit::affine(&x, &y, &knots).expect("the data are in order");
        assert!(knots.windows(2).all(|k| k[1] - k[0] <= 100) && knots.len() > last, "{knots:?}");
        assert!(fit.error <= fit.bound + 1e-9, "{} {}", fit.error, fit.bound);
        last = knots.len();
    }
}
