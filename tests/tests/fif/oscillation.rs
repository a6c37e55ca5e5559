//! Dimension and spectrum of data, against the formula of systems, Takagi's function and fractional
//! Brownian motion.

use asperity_fif::{Fif, HeightField, box_dimension, cochran_2000, fit, oscillation_exponent};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;

use crate::properties::g;

/// Fractional Brownian motion of Hurst exponent `hurst`, by the recursion of Hosking (1984) for its
/// increments.
fn brownian(hurst: f64, count: usize, seed: u64) -> Vec<f64> {
    let mut random = Random(seed);
    let mut normal = || (0..12).map(|_| random.uniform()).sum::<f64>() - 6.0;
    let power = |k: f64| k.abs().powf(2.0 * hurst);
    let covariance: Vec<f64> = (0..count)
        .map(|k| k as f64)
        .map(|k| 0.5 * (power(k + 1.0) - 2.0 * power(k) + power(k - 1.0)))
        .collect();
    let (mut weights, mut variance) = (Vec::<f64>::new(), 1.0);
    let mut steps = vec![normal()];
    for k in 1..count {
        let known: f64 = weights.iter().zip(covariance[1..k].iter().rev()).map(|(w, c)| w * c).sum();
        let last = (covariance[k] - known) / variance;
        let old = weights.clone();
        for (weight, mirrored) in weights.iter_mut().zip(old.iter().rev()) {
            *weight -= last * mirrored;
        }
        weights.push(last);
        variance *= 1.0 - last * last;
        let mean: f64 = weights.iter().zip(steps.iter().rev()).map(|(w, step)| w * step).sum();
        steps.push(mean + variance.sqrt() * normal());
    }
    let mut sum = 0.0;
    let walk = steps.into_iter().map(|step| {
        sum += step;
        sum
    });
    std::iter::once(0.0).chain(walk).collect()
}

fn samples<const C: usize>(f: &Fif<C>, count: usize) -> Vec<f64> {
    let domain = f.domain();
    let at = |i: usize| domain.lo + domain.width() * i as f64 / (count - 1) as f64;
    (0..count).map(|i| f.evaluate(at(i), 1e-9).value).collect()
}

#[test]
fn dimension_of_samples_matches_the_system() {
    let sevenths: Vec<f64> = (0..8).map(f64::from).collect();
    let y = [0.0, 1.0, -0.5, 0.25, 1.5, -1.0, 0.0, 0.5];
    for (factor, count) in [(0.3, 16_808), (0.5, 16_808), (0.8, 16_808), (0.8, 5_000)] {
        let f = Fif::<2>::affine(&sevenths, &y, &[factor; 7]).unwrap();
        let measured = box_dimension(&samples(&f, count), count).unwrap();
        assert_abs_diff_eq!(measured.value, f.dimension().middle(), epsilon = 0.06, "{factor} {measured:?}");
    }
    // Takagi's oscillations fall like s log 1/s: 1 + 1/ln(1/s) at the scales of the samples.
    let mut takagi = [0.0; 4097];
    cochran_2000::f().unwrap().grid(&mut takagi).unwrap();
    let measured = box_dimension(&takagi, 4097).unwrap();
    assert!((1.05..1.2).contains(&measured.value), "{measured:?}");
}

#[test]
fn dimension_of_fractional_brownian_motion() {
    for hurst in [0.3, 0.5, 0.7] {
        let measured: Vec<f64> =
            (1..=8).map(|seed| box_dimension(&brownian(hurst, 4096, seed), 4097).unwrap().value).collect();
        let mean = measured.iter().sum::<f64>() / 8.0;
        println!("{hurst}: {mean} {measured:?}");
        assert_abs_diff_eq!(mean, 2.0 - hurst, epsilon = 0.04, "{hurst}");
        assert!(measured.iter().all(|d| (d + hurst - 2.0).abs() < 0.15), "{hurst}: {measured:?}");
    }
}

#[test]
fn spectrum_matches_the_factors() {
    // Σ |α|^q a^{−τ} = 1 on halves: τ = −log₂ Σ |α|^q.
    let f = Fif::<2>::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], &[0.9, -0.4]).unwrap();
    let data = samples(&f, 4097);
    for q in [0.5, 1.0, 2.0, 3.0] {
        let want = -(0.9_f64.powf(q) + 0.4_f64.powf(q)).log2();
        let got = oscillation_exponent(&data, 4097, q).unwrap();
        println!("{q}: {got:?} {want}");
        assert_abs_diff_eq!(got.value, want, epsilon = 0.06, "{q}");
    }
    let walk = brownian(0.5, 4096, 3);
    let bend = [1.0, 2.0, 3.0].map(|q| oscillation_exponent(&walk, 4097, q).unwrap().value);
    assert!((bend[0] - 2.0 * bend[1] + bend[2]).abs() < 0.05, "{bend:?}");
}

#[test]
fn dimension_of_an_image_matches_the_surface() {
    let surface = HeightField::new(g(), g());
    let at = |i: usize| i as f64 / 128.0;
    let image: Vec<f64> = (0..257 * 257).map(|k| surface.height(at(k / 257), at(k % 257))).collect();
    let measured = box_dimension(&image, 257).unwrap();
    println!("{measured:?}");
    assert_abs_diff_eq!(measured.value, 2.0 + 1.7_f64.log2(), epsilon = 0.06, "{measured:?}");
}

#[test]
fn fit_is_compared_with_its_data() {
    let data = brownian(0.4, 1024, 5);
    let x: Vec<f64> = (0..data.len()).map(|k| k as f64).collect();
    let knots: Vec<usize> = (0..=1024).step_by(16).collect();
    let system = fit::affine(&x, &data, &knots).unwrap().system;
    let [of_data, of_fit] = [data, samples(&system, 1025)].map(|y| box_dimension(&y, 1025).unwrap());
    println!("{of_data:?} {of_fit:?} {:?}", system.dimension());
    assert_abs_diff_eq!(of_data.value, 1.6, epsilon = 0.15);
    // Least-squares factors omit what they cannot follow, so the fit is smoother.
    assert_abs_diff_eq!(of_fit.value, system.dimension().middle(), epsilon = 0.1);
    assert!(of_fit.value < of_data.value, "{of_fit:?}");
}
