//! Seed and effort of checks.

use glam::Vec2;

use crate::split_mix::SplitMix64;

/// The seed and the effort of a [`Report`](super::Report).
///
/// ```
/// use asperity_core::check::Settings;
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
    /// Probability with which what is right may fail a report by chance, divided evenly among its statistical tests.
    pub significance: f64,
}

impl Settings {
    /// Uniform points of the unit square without end; each stream has its own.
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
    /// The seed 0, 65,536 samples, and a significance of 10⁻⁶: a thousand reports fail by chance once in a thousand times.
    fn default() -> Self {
        Self { seed: 0, samples: 1 << 16, significance: 1e-6 }
    }
}
