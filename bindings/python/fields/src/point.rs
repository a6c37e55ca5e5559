//! Points with N coordinates, laid out as the rows of an array.

use asperity_noise::Point;
use bytemuck::TransparentWrapper;

/// A point with N coordinates.
#[derive(Clone, Copy, Debug, PartialEq, TransparentWrapper)]
#[repr(transparent)]
pub struct At<const N: usize>(pub [f32; N]);

impl<const N: usize> Default for At<N> {
    fn default() -> Self {
        Self([0.0; N])
    }
}

impl<const N: usize> Point for At<N> {
    type Coordinates = [f32; N];
    type Matrix = [[f32; N]; N];
    type Array<T> = [T; N];

    #[inline(always)]
    fn coordinates(self) -> [f32; N] {
        self.0
    }
    #[inline(always)]
    fn from_coordinates(coordinates: [f32; N]) -> Self {
        Self(coordinates)
    }
    #[inline(always)]
    fn array<T>(make: impl FnMut(usize) -> T) -> [T; N] {
        std::array::from_fn(make)
    }
    #[inline(always)]
    fn from_axes(make: impl FnMut(usize) -> f32) -> Self {
        Self(std::array::from_fn(make))
    }
}

/// Returns the rows of an array of N columns as points; numbers that fill no row are left out.
#[must_use]
pub fn points<const N: usize>(numbers: &[f32]) -> &[At<N>] {
    At::wrap_slice(numbers.as_chunks().0)
}
