//! Seed and sample count of checks.

use glam::Vec2;

use crate::split_mix::SplitMix64;

/// The seed, the sample count and the significance of a [`Report`](super::Report).
///
/// ```
/// use asperity_core::check::Settings;
///
/// let quick = Settings { samples: 10_000, ..Settings::default() };
/// assert_eq!(quick.seed, 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Seed of the samples; equal seeds give equal reports.
    pub seed: u32,
    /// Samples of each χ² test; at least 4096 are drawn.
    pub samples: u32,
    /// Probability that a correct subject fails a report by chance, divided evenly among its
    /// statistical tests.
    pub significance: f64,
}

impl Settings {
    /// Iterates endlessly over uniform points of the unit square; each stream has its own points.
    ///
    /// ```
    /// use asperity_core::check::Settings;
    ///
    /// let mean = Settings::default().points(0).take(10_000).map(|u| u.x - u.y).sum::<f32>() / 10_000.0;
    /// assert!(mean.abs() < 0.02);
    /// ```
    pub fn points(&self, stream: u8) -> impl Iterator<Item = Vec2> + use<> {
        let mut random = SplitMix64 { state: (u64::from(self.seed) << 8 | u64::from(stream)) << 32 };
        core::iter::repeat_with(move || Vec2::new(random.uniform(), random.uniform()))
    }
}

impl Default for Settings {
    /// Seed 0, 65,536 samples, and a significance of 10⁻⁶.
    ///
    /// Among a thousand reports the probability of a false failure is 1/1000.
    fn default() -> Self {
        Self { seed: 0, samples: 1 << 16, significance: 1e-6 }
    }
}
