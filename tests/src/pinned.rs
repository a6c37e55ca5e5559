//! Values that stay: comparison with what a function returned when it was pinned.

use glam::{Vec2, Vec3};

/// Some units in the last place of `f32`.
pub const SINGLE: f64 = 1e-6;

/// Numbers that are pinned: one, those of a vector or of an array.
pub trait Numbers<const N: usize> {
    /// The numbers in `f64`.
    fn numbers(self) -> [f64; N];
}

impl Numbers<1> for f32 {
    fn numbers(self) -> [f64; 1] {
        [f64::from(self)]
    }
}

impl Numbers<2> for Vec2 {
    fn numbers(self) -> [f64; 2] {
        vec2(self)
    }
}

impl Numbers<3> for Vec3 {
    fn numbers(self) -> [f64; 3] {
        vec3(self)
    }
}

impl<T: Into<f64>, const N: usize> Numbers<N> for [T; N] {
    fn numbers(self) -> [f64; N] {
        self.map(Into::into)
    }
}

/// Compares with pinned values, each within [`SINGLE`].
///
/// # Panics
/// If one is not.
#[track_caller]
pub fn single<const N: usize>(what: &str, got: impl Numbers<N>, expected: [f64; N]) {
    pinned(what, got, expected, SINGLE);
}

/// Compares with pinned values, each within the relative `tolerance`.
///
/// # Panics
/// If one is not.
#[track_caller]
pub fn pinned<const N: usize>(what: &str, got: impl Numbers<N>, expected: [f64; N], tolerance: f64) {
    let got = got.numbers();
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
