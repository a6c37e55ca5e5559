//! Seed and effort of checks.

/// The seed and the effort of a [`Report`](super::Report).
///
/// ```
/// use asperity_ndf_sampling::check::Settings;
///
/// let quick = Settings { samples: 10_000, ..Settings::default() };
/// assert_eq!(quick.seed, 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Seed of the samples; the same seed, the same report.
    pub seed: u32,
    /// Samples of each χ² test; at least 4096 are drawn.
    pub samples: u32,
    /// Probability with which a χ² test may fail a right density.
    pub significance: f64,
}

impl Default for Settings {
    /// The seed 0, 65,536 samples, and a significance of 10⁻⁶: a thousand runs of two tests fail once in 500 times.
    fn default() -> Self {
        Self { seed: 0, samples: 1 << 16, significance: 1e-6 }
    }
}
