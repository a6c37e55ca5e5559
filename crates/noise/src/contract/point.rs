//! The points that noises are evaluated at: numbers, and glam's vectors of two to four.

use core::fmt::Debug;

use glam::{Vec2, Vec3, Vec4};

/// A point in N dimensions: `f32`, [`Vec2`], [`Vec3`] or [`Vec4`].
pub trait Point<const N: usize>: Copy + Debug + Default + PartialEq {
    /// The coordinates.
    fn coordinates(self) -> [f32; N];
    /// The point of the coordinates.
    fn from_coordinates(coordinates: [f32; N]) -> Self;
}

impl Point<1> for f32 {
    #[inline(always)]
    fn coordinates(self) -> [f32; 1] {
        [self]
    }
    #[inline(always)]
    fn from_coordinates([x]: [f32; 1]) -> Self {
        x
    }
}

macro_rules! point {
    ($vector:ty, $n:literal) => {
        impl Point<$n> for $vector {
            #[inline(always)]
            fn coordinates(self) -> [f32; $n] {
                self.to_array()
            }
            #[inline(always)]
            fn from_coordinates(coordinates: [f32; $n]) -> Self {
                Self::from_array(coordinates)
            }
        }
    };
}

point!(Vec2, 2);
point!(Vec3, 3);
point!(Vec4, 4);
