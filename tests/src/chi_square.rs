//! Pearson's χ² test with pooled bins.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Bins are pooled until one expects at least this many samples.
const LEAST_EXPECTED: f64 = 10.0;

/// The share of samples that rounding may put across the border of a bin without probability.
const STRAY: f64 = 5e-6;

/// The probability that samples which do follow `probabilities` fit no better than `counts` do.
///
/// Samples in bins that have no probability make the result 0, beyond five in a million: pooled with others they would hide.
/// Other bins are pooled in the order of their probability, so that the result does not depend on the counts. What the
/// probabilities lack to 1 is a further bin, whose count is what `counts` lack to `samples`.
///
/// # Panics
/// If the bins leave no degree of freedom.
#[must_use]
pub fn p_value(counts: &[u64], probabilities: &[f64], samples: u64) -> f64 {
    assert_eq!(counts.len(), probabilities.len());
    let total = samples as f64;
    let mut bins: Vec<(f64, u64)> = probabilities.iter().copied().zip(counts.iter().copied()).collect();
    bins.push((1.0 - probabilities.iter().sum::<f64>(), samples - counts.iter().sum::<u64>()));
    let stray: u64 = bins.iter().filter(|bin| bin.0 < 1e-12).map(|bin| bin.1).sum();
    if stray as f64 > STRAY * total {
        return 0.0;
    }
    bins.sort_by(|a, b| a.0.total_cmp(&b.0));

    let mut pooled: Vec<(f64, u64)> = Vec::new();
    let mut open = (0.0, 0);
    for (probability, count) in bins {
        open.0 += probability;
        open.1 += count;
        if open.0 * total >= LEAST_EXPECTED {
            pooled.push(open);
            open = (0.0, 0);
        }
    }
    let last = pooled.last_mut().expect("no bin expects enough samples");
    last.0 += open.0;
    last.1 += open.1;
    assert!(pooled.len() > 1, "one bin holds everything");

    let statistic: f64 = pooled
        .iter()
        .map(|&(probability, count)| {
            let expected = probability * total;
            (count as f64 - expected).powi(2) / expected
        })
        .sum();
    ChiSquared::new((pooled.len() - 1) as f64).expect("positive freedom").sf(statistic)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn counts(weights: [f64; 8]) -> [u64; 8] {
        let (mut random, mut counts) = (Random(7), [0; 8]);
        for _ in 0..100_000 {
            let u = random.uniform();
            let mut sum = 0.0;
            let bin = weights.iter().take_while(|&&weight| {
                sum += weight;
                sum <= u
            });
            counts[bin.count()] += 1;
        }
        counts
    }

    #[test]
    fn accepts_the_right_and_rejects_the_wrong() {
        let right = [0.05, 0.1, 0.1, 0.2, 0.25, 0.15, 0.1, 0.05];
        let wrong = [0.055, 0.1, 0.1, 0.195, 0.25, 0.15, 0.1, 0.05];
        assert!(p_value(&counts(right), &right, 100_000) > 0.01);
        assert!(p_value(&counts(right), &wrong, 100_000) < 1e-6);
    }

    #[test]
    fn samples_in_an_impossible_bin_are_rejected() {
        assert_eq!(p_value(&[50_000, 49_980, 20], &[0.5, 0.5, 0.0], 100_000), 0.0);
        assert!(p_value(&[50_000, 50_000, 0], &[0.5, 0.5, 0.0], 100_000) > 0.9);
    }
}
