//! The float functions that this crate calls, and a clamp.

pub(crate) use asperity_core::math::{atan2, cos, exp, exp_m1, exp2, floor, ln_1p, log2, pow, sin, sqrt};

/// `x` within `[0, most]`, with NaN as 0, which `clamp` would pass on.
#[inline]
pub(crate) fn clamp_to(x: f32, most: f32) -> f32 {
    if x > 0.0 { x.min(most) } else { 0.0 }
}
