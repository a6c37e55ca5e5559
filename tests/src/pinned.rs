//! Values that stay: comparison with what a function returned when it was pinned.

use glam::{Vec2, Vec3};

/// Some units in the last place of `f32`.
pub const SINGLE: f64 = 1e-6;

/// Compares with pinned values, each within the relative `tolerance`.
///
/// # Panics
/// If one is not.
#[track_caller]
pub fn pinned<const N: usize>(what: &str, got: [f64; N], expected: [f64; N], tolerance: f64) {
    let close =
        got.iter().zip(expected).all(|(got, expected)| (got - expected).abs() <= tolerance * expected.abs());
    assert!(close, "{what}: {got:?} is pinned to {expected:?}");
}

/// The components.
#[must_use]
pub fn vec3(v: Vec3) -> [f64; 3] {
    v.as_dvec3().to_array()
}

/// The components.
#[must_use]
pub fn vec2(v: Vec2) -> [f64; 2] {
    v.as_dvec2().to_array()
}
