//! Random points and seeds of checks.

use asperity_core::{SplitMix64, check::Settings};

use crate::point::Point;

/// Random words of a stream.
pub(super) fn stream(settings: Settings, number: u32) -> SplitMix64 {
    SplitMix64 { state: u64::from(settings.seed) << 32 | u64::from(number) }
}

/// Uniform points of the cube up to ±`reach` with coordinates of 15 bits; steps of 2⁻⁸ to 2⁻¹⁶ of
/// it are exact.
pub(super) fn points<V: Point>(settings: Settings, number: u32, reach: f32) -> impl FnMut() -> V {
    let mut random = stream(settings, number);
    move || V::from_axes(|_| ((random.word() >> 49) as f32 / 16_384.0 - 1.0) * reach)
}
