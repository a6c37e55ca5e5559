//! Numbers of flakes in bins of their tilt, drawn by hashes along a binary tree.

use super::axis::{Axis, Bin};
use crate::math::{clamp_to, exp, exp_m1, floor, ln_1p, sqrt};

/// The flakes around a point of the lattice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flakes {
    /// Their random word.
    pub word: u32,
    /// Their number.
    pub count: f32,
}

impl Flakes {
    /// The fraction of these flakes that is in a bin of both tilts.
    ///
    /// Splits both tilts in turn, and draws the number of flakes in each half.
    pub(super) fn fraction(self, x: &Bin, y: &Bin, splits: usize) -> f32 {
        let mut flakes = self;
        for split in 0..splits {
            for bin in [x, y] {
                let (is_outer, outer) = bin.at(split);
                flakes = flakes.half(is_outer, flakes.outer(outer));
                if flakes.count <= 0.0 {
                    return 0.0;
                }
            }
        }
        flakes.count / self.count
    }

    /// The bin of one of these flakes. Both numbers become uniform within the bin.
    pub(super) fn sample(self, axis: &Axis, [u, v]: [&mut f32; 2]) -> [i32; 2] {
        let (mut flakes, mut bin) = (self, [0, 0]);
        for split in 0..axis.splits() {
            for (index, u) in bin.iter_mut().zip([&mut *u, &mut *v]) {
                let outer = flakes.outer(axis.outer(split, *index));
                let is_outer = choose(u, outer / flakes.count);
                flakes = flakes.half(is_outer, outer);
                *index = Axis::child(split, *index, is_outer);
            }
        }
        bin
    }

    /// How many of these flakes are in the half farther from 0.
    fn outer(self, probability: f32) -> f32 {
        binomial(self.count, probability, self.word)
    }

    /// The flakes of a half, `outer` of which are in the half farther from 0.
    fn half(self, is_outer: bool, outer: f32) -> Self {
        let mut word = self.word.wrapping_add(if is_outer { 0x3c6e_f372 } else { 0x9e37_79b9 });
        word = (word ^ (word >> 15)).wrapping_mul(0x846c_a68b);
        Self { word: word ^ (word >> 16), count: if is_outer { outer } else { self.count - outer } }
    }
}

/// Whether a uniform number is below a probability; the number becomes uniform again.
fn choose(u: &mut f32, probability: f32) -> bool {
    let below = *u < probability;
    *u = if below { *u / probability } else { (*u - probability) / (1.0 - probability) };
    // Rounding, and 0/0.
    *u = clamp_to(*u, 0.999_999_94);
    below
}

/// A number of successes of `n` trials of this probability, whole and with the mean `n p`, from a
/// random word.
///
/// By inversion up to 16 expected successes, so more trials have the same successes and further
/// ones. Beyond, a rounded sum of four bytes with the mean and the variance, and from 2¹³ the
/// rounded mean, whose relative deviation would be 1 %.
fn binomial(n: f32, p: f32, word: u32) -> f32 {
    let mean = n * p;
    if mean > 8192.0 {
        return floor(mean + 0.5);
    }
    if mean > 16.0 {
        /// Standard deviation of the sum of four bytes: `√(4 (256² − 1)/12)`.
        const DEVIATION: f32 = 147.801;
        let sum: i32 = word.to_le_bytes().into_iter().map(i32::from).sum();
        // At most 3.45 standard deviations, which are less than the mean.
        return floor(mean + sqrt(mean * (1.0 - p)) / DEVIATION * (sum - 510) as f32 + 0.5).min(n);
    }
    let uniform = (word as f32 + 0.5) / 4_294_967_296.0;
    if n <= 1.0 {
        return if uniform < p { n } else { 0.0 };
    }
    let log = ln_1p(-p);
    // P(count > k), from above: small probabilities keep their digits.
    let mut above = -exp_m1(n * log);
    let mut chance = mean * exp((n - 1.0) * log);
    let mut k = 0.0;
    while uniform < above && k < n && k < 64.0 {
        k += 1.0;
        above -= chance;
        chance *= (n - k) / (k + 1.0) * p / (1.0 - p);
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use asperity_noise::{IntegerHash, Lattice};
    use std::vec::Vec;

    #[test]
    fn binomial_has_mean_and_variance() {
        for (n, p) in [
            (1.0, 0.3),
            (4.0, 0.3),
            (16.0, 1e-3),
            (1024.0, 4e-4),
            (4096.0, 0.01),
            (65_536.0, 0.1),
            (78.0, 0.9),
        ] {
            let count = 20_000_i32;
            let (mut sum, mut squares) = (0.0, 0.0);
            for i in 0..count {
                let k = f64::from(binomial(n, p, IntegerHash.word([i], 5)));
                assert!(k >= 0.0 && k <= f64::from(n) && k.fract() == 0.0, "{k} of {n}");
                sum += k - f64::from(n * p);
                squares += (k - f64::from(n * p)).powi(2);
            }
            let (mean, variance) = (sum / f64::from(count), squares / f64::from(count));
            let expected = f64::from(n) * f64::from(p) * f64::from(1.0 - p);
            // Four standard errors, and the rounding of whole numbers beyond 2²⁴.
            let epsilon = 4.0 * (expected / f64::from(count)).sqrt() + f64::from(n) * 6e-8;
            assert_abs_diff_eq!(mean, 0.0, epsilon = epsilon, "{n}, {p}");
            let spread = if expected < 1.0 { 0.4 } else { 0.05 };
            assert!((variance / expected - 1.0).abs() < spread, "{n}, {p}: {variance} {expected}");
        }
    }

    #[test]
    fn bins_hold_all_flakes_and_more_flakes_hold_the_same_ones() {
        let axis = Axis::new(0.5);
        let centers = || (-10..10).map(|k| 0.5 * k as f32 + 0.25);
        for i in 0..60_i32 {
            let word = IntegerHash.word([i], 1);
            let all = |count: f32| -> Vec<f32> {
                let flakes = Flakes { word, count };
                let bins = centers().flat_map(|x| centers().map(move |y| (x, y)));
                bins.map(|(x, y)| {
                    count * flakes.fraction(&axis.bins(x, true)[0], &axis.bins(y, true)[0], axis.splits())
                })
                .collect()
            };
            let (few, more) = (all(4.0), all(16.0));
            assert_abs_diff_eq!(few.iter().sum::<f32>(), 4.0, epsilon = 1e-5);
            assert_abs_diff_eq!(more.iter().sum::<f32>(), 16.0, epsilon = 1e-5);
            assert!(few.iter().zip(&more).all(|(few, more)| few <= more), "{few:?} {more:?}");
        }
    }

    #[test]
    fn samples_are_in_the_bins_of_the_flakes() {
        let axis = Axis::new(0.5);
        for i in 0..40_i32 {
            let flakes = Flakes { word: IntegerHash.word([i], 1), count: 16.0 };
            let at = |[x, y]: [i32; 2]| {
                let [x, y] = [x, y].map(|k| axis.bins(0.5 * k as f32 + 0.25, true)[0]);
                flakes.fraction(&x, &y, axis.splits())
            };
            let mut sum = 0.0;
            for k in 0..32_u8 {
                let (mut u, mut v) = ((f32::from(k) + 0.5) / 32.0, 0.3);
                let bin = flakes.sample(&axis, [&mut u, &mut v]);
                assert!(at(bin) > 0.0 && (0.0..1.0).contains(&u) && (0.0..1.0).contains(&v), "{bin:?}");
                sum += at(bin);
            }
            assert!(sum > 0.0);
        }
    }
}
