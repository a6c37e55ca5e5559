//! Float functions used by this crate, and a clamp.

pub(crate) use asperity_core::math::{atan2, cos, exp, exp_m1, exp2, floor, ln_1p, log2, pow, sin, sqrt};

/// Clamps `x` to `[0, most]`; NaN becomes 0, unlike with `clamp`.
#[inline]
pub(crate) fn clamp_to(x: f32, most: f32) -> f32 {
    if x > 0.0 { x.min(most) } else { 0.0 }
}
