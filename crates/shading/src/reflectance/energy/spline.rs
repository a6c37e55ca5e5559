//! Uniform quadratic B-splines, the interpolation of every table of albedos.

use crate::math::{clamp_to, sqrt};

/// The first of three coefficients at `x` in `[0, 1]`, and their weights.
///
/// `count` coefficients, at least 3, divide `[0, 1]` into `count − 2` intervals. NaN is read as 0.
#[inline]
pub(in crate::reflectance) fn weights(x: f32, count: usize) -> (usize, [f32; 3]) {
    let x = clamp_to(x, 1.0) * (count - 2) as f32;
    let first = (x as usize).min(count - 3);
    (first, between(x - first as f32))
}

/// The weights of three coefficients at a fraction of the way through an interval.
#[inline]
pub(super) fn between(t: f32) -> [f32; 3] {
    [0.5 * (1.0 - t) * (1.0 - t), 0.5 + t * (1.0 - t), 0.5 * t * t]
}

/// The number of a table entry.
#[inline]
pub(in crate::reflectance) fn as_number(entry: u16) -> f32 {
    f32::from(entry) * (1.0 / 60_000.0)
}

/// The value at these weights of coefficients that are `stride` apart.
#[inline]
pub(in crate::reflectance) fn blend(weights: [f32; 3], coefficient: impl Fn(usize) -> f32) -> f32 {
    weights[0] * coefficient(0) + weights[1] * coefficient(1) + weights[2] * coefficient(2)
}

/// The place in `[0, 1]` of `t` in `[0, 1]`, with a finer scale below `width`: `√(t (1 + w)/(t + w))`.
///
/// Albedos dip at cosines near α. Scaled by it, the dip is at the same place for all small α.
#[inline]
pub(super) fn place(t: f32, width: f32) -> f32 {
    sqrt(t * (1.0 + width) / (t + width).max(f32::MIN_POSITIVE))
}
