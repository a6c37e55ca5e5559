//! Pearson's χ² test with pooled bins.

use alloc::vec::Vec;

use crate::math;

/// Bins are pooled until one expects at least this many samples.
const MIN_EXPECTED: f64 = 10.0;

/// The fraction of samples that rounding may move across the border of a bin with probability 0.
const STRAY: f64 = 5e-6;

/// Returns the p-value of `counts` under `probabilities`, by Pearson's χ² test.
///
/// ```text
/// χ² = Σ (count − n p)²/(n p),      P(χ²_{bins − 1} ≥ χ²) = Q((bins − 1)/2, χ²/2)
/// ```
///
/// If more than five in a million samples are in bins with probability 0, the result is 0, because
/// pooling would hide them. Other bins are pooled in the order of their probability until each
/// expects ten samples, so that the pooling does not depend on the counts. If the probabilities sum
/// to less than 1, the rest is another bin, whose count is `samples` minus the sum of `counts`.
///
/// - **Range:** `[0, 1]`; NaN, which fails every comparison, if fewer than two bins remain.
/// - **Accuracy:** 1e-10 relative to the larger of the result and its complement.
///
/// ```
/// use asperity_core::check::p_value;
///
/// assert!(p_value(&[5050, 4950], &[0.5, 0.5], 10_000) > 0.3);
/// assert!(p_value(&[5250, 4750], &[0.5, 0.5], 10_000) < 1e-6);
/// ```
///
/// Pearson 1900; Cochran 1954, "Some methods for strengthening the common χ² tests", for the
/// minimum expectation.
#[must_use]
pub fn p_value(counts: &[u64], probabilities: &[f64], samples: u64) -> f64 {
    let total = samples as f64;
    let mut bins: Vec<(f64, u64)> = probabilities.iter().copied().zip(counts.iter().copied()).collect();
    let counted = bins.iter().fold(0_u64, |sum, bin| sum.saturating_add(bin.1));
    bins.push((1.0 - bins.iter().map(|bin| bin.0).sum::<f64>(), samples.saturating_sub(counted)));
    let stray: u64 = bins.iter().filter(|bin| bin.0 < 1e-12).map(|bin| bin.1).sum();
    if stray as f64 > STRAY * total {
        return 0.0;
    }
    bins.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut pooled: Vec<(f64, u64)> = Vec::new();
    let mut open = (0.0, 0);
    for (probability, count) in bins {
        open = (open.0 + probability, open.1 + count);
        if open.0 * total >= MIN_EXPECTED {
            pooled.push(open);
            open = (0.0, 0);
        }
    }
    if let Some(last) = pooled.last_mut() {
        *last = (last.0 + open.0, last.1 + open.1);
    }
    if pooled.len() < 2 {
        return f64::NAN;
    }
    let statistic: f64 = pooled
        .iter()
        .map(|&(probability, count)| {
            let (expected, off) = (probability * total, count as f64 - probability * total);
            off * off / expected
        })
        .sum();
    upper_gamma(0.5 * (pooled.len() - 1) as f64, 0.5 * statistic)
}

/// `Q(s, x) = Γ(s, x)/Γ(s)` for `s > 0`, by its series below `s + 1`, by its continued fraction
/// above.
///
/// Press, Teukolsky, Vetterling, Flannery 1992, "Numerical Recipes", eq. 6.2.5 and 6.2.7.
fn upper_gamma(s: f64, x: f64) -> f64 {
    if x.is_nan() || x <= 0.0 {
        return if x <= 0.0 { 1.0 } else { f64::NAN };
    }
    let front = math::exp_f64(s * math::ln_f64(x) - x - ln_gamma(s));
    if x < s + 1.0 {
        let (mut term, mut sum) = (1.0 / s, 1.0 / s);
        for k in 1..MAX_TERMS {
            term *= x / (s + f64::from(k));
            sum += term;
            if term < 1e-16 * sum {
                break;
            }
        }
        return 1.0 - front * sum;
    }
    // Lentz's method.
    let mut b = x + 1.0 - s;
    let (mut c, mut d) = (1e300, 1.0 / b);
    let mut product = d;
    for k in 1..MAX_TERMS {
        let k = f64::from(k);
        let a = k * (s - k);
        b += 2.0;
        d = 1.0 / (a * d + b);
        c = b + a / c;
        product *= c * d;
        if (c * d - 1.0).abs() < 1e-16 {
            break;
        }
    }
    front * product
}

/// More terms than a million bins need, whose series end after some thousand terms.
const MAX_TERMS: u32 = 20_000;

/// `ln Γ(s)` for `s > 0`: Stirling's series beyond 10, where its fourth term is 6e-11 of the first;
/// by recurrence below.
fn ln_gamma(s: f64) -> f64 {
    let (mut s, mut product) = (s, 1.0);
    while s < 10.0 {
        product *= s;
        s += 1.0;
    }
    let t = 1.0 / (s * s);
    let series = (1.0 / 12.0 - t * (1.0 / 360.0 - t * (1.0 / 1260.0 - t * (1.0 / 1680.0 - t / 1188.0)))) / s;
    (s - 0.5) * math::ln_f64(s) - s + 0.5 * math::ln_f64(core::f64::consts::TAU) + series
        - math::ln_f64(product)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::split_mix::SplitMix64;

    #[test]
    fn upper_gamma_matches_tables() {
        // One, two and a hundred degrees of freedom. Two are exp(−x/2), one is erfc(√(x/2)).
        crate::assert_abs_diff_eq!(upper_gamma(1.0, 7.0) / (-7.0_f64).exp(), 1.0, epsilon = 1e-12);
        crate::assert_abs_diff_eq!(upper_gamma(1.0, 0.3), (-0.3_f64).exp(), epsilon = 1e-14);
        for x in [0.1, 0.9, 2.0, 8.0, 30.0] {
            crate::assert_abs_diff_eq!(
                upper_gamma(0.5, x) / libm::erfc(x.sqrt()),
                1.0,
                epsilon = 1e-11,
                "{x}"
            );
        }
        crate::assert_abs_diff_eq!(upper_gamma(50.0, 0.5 * 135.806_723), 0.01, epsilon = 1e-9);
        assert_eq!((upper_gamma(3.0, 0.0), upper_gamma(3.0, f64::NAN).is_nan()), (1.0, true));
    }

    fn counts(weights: [f64; 8]) -> [u64; 8] {
        let (mut random, mut counts) = (SplitMix64 { state: 7 }, [0; 8]);
        for _ in 0..100_000 {
            let u = f64::from(random.uniform());
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
    fn p_value_accepts_matching_and_rejects_other_samples() {
        let right = [0.05, 0.1, 0.1, 0.2, 0.25, 0.15, 0.1, 0.05];
        let wrong = [0.055, 0.1, 0.1, 0.195, 0.25, 0.15, 0.1, 0.05];
        assert!(p_value(&counts(right), &right, 100_000) > 0.01);
        assert!(p_value(&counts(right), &wrong, 100_000) < 1e-6);
    }

    #[test]
    fn p_value_rejects_samples_in_impossible_bin() {
        assert_eq!(p_value(&[50_000, 49_980, 20], &[0.5, 0.5, 0.0], 100_000), 0.0);
        assert!(p_value(&[50_000, 50_000, 0], &[0.5, 0.5, 0.0], 100_000) > 0.9);
        assert!(p_value(&[100], &[1.0], 100).is_nan() && p_value(&[], &[], 0).is_nan());
    }
}
