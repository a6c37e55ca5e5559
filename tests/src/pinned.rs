//! Pinned values: comparison with recorded results.

use glam::{Vec2, Vec3};

/// A few units in the last place of `f32`.
pub const SINGLE: f64 = 1e-6;

/// Pinned numbers: a number, or the components of a vector or an array.
pub trait Numbers<const N: usize> {
    /// Returns the numbers in `f64`.
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

/// Asserts that values equal the pinned values within [`SINGLE`].
///
/// # Panics
///
/// If a value differs.
#[track_caller]
pub fn single<const N: usize>(what: &str, got: impl Numbers<N>, expected: [f64; N]) {
    pinned(what, got, expected, SINGLE);
}

/// Asserts that values equal the pinned values within the relative `tolerance`.
///
/// # Panics
///
/// If a value differs.
#[track_caller]
pub fn pinned<const N: usize>(what: &str, got: impl Numbers<N>, expected: [f64; N], tolerance: f64) {
    let got = got.numbers();
    let close =
        got.iter().zip(expected).all(|(got, expected)| (got - expected).abs() <= tolerance * expected.abs());
    assert!(close, "{what}: {got:?} is pinned to {expected:?}");
}

/// Returns the components.
#[must_use]
pub fn vec3(v: Vec3) -> [f64; 3] {
    v.as_dvec3().to_array()
}

/// Returns the components.
#[must_use]
pub fn vec2(v: Vec2) -> [f64; 2] {
    v.as_dvec2().to_array()
}
