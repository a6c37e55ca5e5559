//! Seed and effort of checks.

use crate::point::Point;

/// The seed and the effort of a [`Report`](super::Report).
///
/// ```
/// use asperity_noise::check::Settings;
///
/// let quick = Settings { samples: 10_000, ..Settings::default() };
/// assert_eq!(quick.seed, 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Seed of points and noises; the same seed, the same report.
    pub seed: u32,
    /// Seeds that statistics are taken over; at least 4096 are.
    pub samples: u32,
    /// Probability with which what is right may fail a report by chance, divided evenly among its statistical tests.
    pub significance: f64,
}

impl Default for Settings {
    /// The seed 0, 65,536 samples, and a significance of 10⁻⁶: a thousand reports fail by chance once in a thousand times.
    fn default() -> Self {
        Self { seed: 0, samples: 1 << 16, significance: 1e-6 }
    }
}

impl Settings {
    /// Words of a stream, SplitMix64 of Steele, Lea and Flood 2014.
    pub(super) fn words(self, stream: u32) -> impl FnMut() -> u64 {
        let mut state = u64::from(self.seed) << 32 | u64::from(stream);
        move || {
            state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let bits = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            bits ^ (bits >> 31)
        }
    }

    /// Uniform points of the cube up to ±`reach`, whose coordinates have 15 bits: moved by 2⁻⁸ to 2⁻¹⁶ of it they are exact.
    pub(super) fn points<V: Point>(self, stream: u32, reach: f32) -> impl FnMut() -> V {
        let mut word = self.words(stream);
        move || V::from_axes(|_| ((word() >> 49) as f32 / 16_384.0 - 1.0) * reach)
    }
}
