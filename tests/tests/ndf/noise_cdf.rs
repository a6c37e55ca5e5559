//! G: monotone, total, self-inverse, and correct for a noise with a known distribution.

use asperity_ndf_sampling::{KurtoticDistribution, NoiseCdfRef, NoiseDistribution, gaussian_cdf};
use asperity_noise::Point;
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::noise_kinds::{Testable, Visit, every_kind, every_variant};
use asperity_tests::random::Random;
use proptest::prelude::*;

/// G of the mean of two uniform numbers within ±1: a triangle.
fn triangle(r: f64) -> f64 {
    if r < 0.0 { 0.5 * (1.0 + r).max(0.0).powi(2) } else { 1.0 - 0.5 * (1.0 - r).max(0.0).powi(2) }
}

#[test]
fn known_noise_becomes_gaussian() {
    let table: Vec<f32> = (0..1025).map(|k| triangle(f64::from(k) / 512.0 - 1.0) as f32).collect();
    let g = NoiseCdfRef::new(1.0, &table).unwrap();
    let (mut random, samples) = (Random(12), 200_000_u32);
    let mut values: Vec<f64> = (0..samples)
        .map(|_| f64::from(g.invert((random.uniform() + random.uniform() - 1.0) as f32)))
        .collect();
    values.sort_by(f64::total_cmp);
    let distance = values.iter().zip(0..).fold(0.0_f64, |worst, (&z, k)| {
        let (below, above) = (f64::from(k) / f64::from(samples), f64::from(k + 1) / f64::from(samples));
        worst.max((gaussian_cdf(z) - below).abs()).max((gaussian_cdf(z) - above).abs())
    });
    // Kolmogorov's 0.1 % point is 1.95/√n = 0.0044.
    assert!(distance < 1.95 / f64::from(samples).sqrt(), "{distance}");
}

/// Measured tables of each noise of the noise crate.
#[derive(Default)]
struct Measured {
    rows: Vec<String>,
}

impl Visit for Measured {
    fn visit<V: Point<Coordinates = [f32; N]>, K: Testable<V, N>, const N: usize>(
        &mut self,
        name: &str,
        noise: K,
    ) {
        let statistics = noise.statistics(N);
        let g = NoiseCdfRef::new(4.0, statistics.cdf).expect("a distribution");
        for k in -350..=350 {
            let r = k as f32 * 0.01;
            let (u, z) = (g.cdf(r), g.invert(r));
            assert_abs_diff_eq!(gaussian_cdf(f64::from(z)), f64::from(u), epsilon = 1e-6, "{name} at {r}");
            assert!(z.is_finite(), "{name} at {r}");
            // Where the noise has values, they are recovered.
            if u > 1e-4 && u < 0.9999 {
                let density = (g.cdf(r + 0.02) - g.cdf(r - 0.02)) / 0.04;
                let tolerance = 1e-6 + 3e-7 / density.max(1e-3);
                assert_abs_diff_eq!(g.warp_gaussian(z), r, epsilon = tolerance, "{name}");
            }
        }
        // The tables are for eight octaves with gain ½: Σ a⁴/(Σ a²)² = (16/15)/(16/9), up to 10⁻⁵.
        let kurtosis = 0.6 * statistics.excess_kurtosis;
        let fitted = KurtoticDistribution::new(1.0, kurtosis).expect("in range");
        let gaussian = KurtoticDistribution::new(1.0, 0.0).expect("valid");
        let distance = |of: KurtoticDistribution| {
            (-400..=400).map(|k| k as f32 * 0.01).map(|r| (of.cdf(r) - g.cdf(r)).abs()).fold(0.0, f32::max)
        };
        let (plain, bent) = (distance(gaussian), distance(fitted));
        // Perlin noise of 1985 in 1-D has only two gradients. Its distribution is uneven, and its
        // kurtosis does not describe it.
        assert!(bent < plain + 1e-3, "{name}: {bent} {plain}");
        // The kurtosis is exact. The largest of these distances, 4.3e-3, is for sparse noise with
        // two impulses.
        assert!(N != 3 || kurtosis.abs() > 0.5 || bent < 4.5e-3, "{name}: {bent}");
        self.rows.push(format!("| {name} | {kurtosis:.2} | {plain:.4} | {bent:.4} |"));
    }
}

#[test]
fn every_measured_distribution_maps_and_inverts() {
    let mut measured = Measured::default();
    every_kind(&mut measured);
    every_variant(&mut measured);
    println!("{}", measured.rows.join("\n"));
    assert!(measured.rows.len() > 40, "{}", measured.rows.len());
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: proptest::test_runner::RngSeed::Fixed(5), failure_persistence: None, ..ProptestConfig::with_cases(1000)
    })]

    #[test]
    fn monotone_and_inverse(
        weights in proptest::collection::vec(0.01_f32..1.0, 1..40), range in 0.1_f32..10.0, a in -1.2_f32..1.2, b in -1.2_f32..1.2,
    ) {
        let total: f32 = weights.iter().sum();
        let mut table = vec![0.0];
        table.extend(weights.iter().scan(0.0_f32, |sum, w| { *sum += w / total; Some(sum.min(1.0)) }));
        let g = NoiseCdfRef::new(range, &table).unwrap();
        let (low, high) = (a.min(b) * range, a.max(b) * range);
        prop_assert!(g.cdf(low) <= g.cdf(high));
        prop_assert!(g.invert(low) <= g.invert(high));
        prop_assert!(g.invert(low).is_finite() && g.invert(high).is_finite());
        // The steepness of the inverse is at most the number of entries divided by the minimum
        // weight.
        let r = a.clamp(-1.0, 1.0) * range;
        let steep = 2.0 * range * total / 0.01 / weights.len() as f32;
        prop_assert!((g.quantile(g.cdf(r)) - r).abs() < 3e-7 * (steep + range), "{} {r}", g.quantile(g.cdf(r)));
        let z = 3.0 * a;
        let back = g.cdf(g.warp_gaussian(z));
        let u = (gaussian_cdf(f64::from(z)) as f32).clamp(table[0], table[table.len() - 1]);
        prop_assert!((back - u).abs() < 1e-5, "{back} {u}");
    }
}
