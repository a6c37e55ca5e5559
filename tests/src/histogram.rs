//! Histograms of values that should be standard Gaussian.

use statrs::function::erf::erf;

fn phi(x: f64) -> f64 {
    0.5 + 0.5 * erf(x * std::f64::consts::FRAC_1_SQRT_2)
}

/// Bins of the distribution; KS is evaluated at their edges.
const BINS: usize = 8192;
const REACH: f64 = 6.0;

/// Measures the KS distance of values to N(0, 1).
#[derive(Clone, Debug)]
pub struct Histogram(Vec<u64>);

impl Default for Histogram {
    fn default() -> Self {
        Self::new()
    }
}

impl Histogram {
    /// Creates an empty histogram.
    #[must_use]
    pub fn new() -> Self {
        Self(vec![0; BINS])
    }

    /// Adds a value.
    pub fn add(&mut self, value: f32) {
        let bin = (f64::from(value) / REACH + 1.0) * 0.5 * BINS as f64;
        self.0[(bin as usize).min(BINS - 1)] += 1;
    }

    /// Adds the values of another histogram.
    #[must_use]
    pub fn join(mut self, other: &Self) -> Self {
        self.0.iter_mut().zip(&other.0).for_each(|(a, b)| *a += b);
        self
    }

    /// Returns the number of values.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.0.iter().sum()
    }

    /// Returns the largest difference of the distribution functions.
    #[must_use]
    pub fn distance(&self) -> f64 {
        let (total, mut below) = (self.count() as f64, 0);
        (0..BINS)
            .map(|bin| {
                below += self.0[bin];
                let edge = REACH * (2.0 * (bin + 1) as f64 / BINS as f64 - 1.0);
                (below as f64 / total - phi(edge)).abs()
            })
            .fold(0.0, f64::max)
    }
}
