//! The points at which noises are evaluated: `f32` and the vectors of glam.

use core::fmt::Debug;

use glam::{Vec2, Vec3, Vec4};

/// A point in one to four dimensions: `f32`, [`Vec2`], [`Vec3`] or [`Vec4`].
///
/// A field has one type of point, for instance `Field<Vec3>`, and its gradients are of the same
/// type. Implement this trait to use the vectors of another library or of another version of glam.
///
/// ```
/// use asperity_noise::{Point, glam::Vec3};
///
/// assert_eq!(Vec3::from_coordinates([1.0, 2.0, 3.0]).coordinates(), [1.0, 2.0, 3.0]);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a point type of noise",
    label = "expected `f32`, `Vec2`, `Vec3` or `Vec4` of `asperity_noise::glam`",
    note = "convert an array with `Vec3::from(array)`",
    note = "vectors of another glam version are another type: use `asperity_noise::glam` or `Vec3::from(v.to_array())`"
)]
pub trait Point: Copy + Debug + Default + PartialEq + 'static {
    /// N numbers in N dimensions.
    type Coordinates: Dimension + AsRef<[f32]> + AsMut<[f32]> + Copy + Debug + PartialEq;
    /// Matrices by rows, N of N numbers each.
    type Matrix: Copy + Debug + PartialEq;
    /// One `T` for each of the N axes.
    type Array<T>: AsRef<[T]> + AsMut<[T]>;

    /// Returns the coordinates.
    fn coordinates(self) -> Self::Coordinates;
    /// Creates a point from its coordinates.
    fn from_coordinates(coordinates: Self::Coordinates) -> Self;
    /// Creates one `T` per axis, in the order of the axes.
    fn array<T>(make: impl FnMut(usize) -> T) -> Self::Array<T>;
    /// Creates a point from coordinates computed in the order of the axes.
    fn from_axes(make: impl FnMut(usize) -> f32) -> Self;
}

/// The coordinates of a point, an array of numbers.
pub trait Dimension: Sized {
    /// One `T` for each coordinate.
    type Each<T: Copy + Debug + PartialEq>: Copy + Debug + PartialEq;

    /// Runs code that needs the number of dimensions.
    fn run<V: Point<Coordinates = Self>, R: InDimension<V>>(code: R) -> R::Output;
}

/// Code that needs the number of dimensions of a point.
pub trait InDimension<V: Point> {
    /// The result.
    type Output;

    /// Runs the code.
    fn run<const N: usize>(self) -> Self::Output
    where
        V: Point<Coordinates = [f32; N]>;
}

impl<const N: usize> Dimension for [f32; N] {
    type Each<T: Copy + Debug + PartialEq> = [T; N];

    #[inline(always)]
    fn run<V: Point<Coordinates = Self>, R: InDimension<V>>(code: R) -> R::Output {
        code.run::<N>()
    }
}

macro_rules! point {
    ($vector:ty, $n:literal, $to:expr, $from:expr) => {
        impl Point for $vector {
            type Coordinates = [f32; $n];
            type Matrix = [[f32; $n]; $n];
            type Array<T> = [T; $n];

            #[inline(always)]
            fn coordinates(self) -> [f32; $n] {
                $to(self)
            }
            #[inline(always)]
            fn from_coordinates(coordinates: [f32; $n]) -> Self {
                $from(coordinates)
            }
            #[inline(always)]
            fn array<T>(make: impl FnMut(usize) -> T) -> [T; $n] {
                core::array::from_fn(make)
            }
            #[inline(always)]
            fn from_axes(make: impl FnMut(usize) -> f32) -> Self {
                $from(core::array::from_fn(make))
            }
        }
    };
}

point!(f32, 1, |x| [x], |[x]: [f32; 1]| x);
point!(Vec2, 2, |p: Vec2| p.to_array(), Vec2::from_array);
point!(Vec3, 3, |p: Vec3| p.to_array(), Vec3::from_array);
point!(Vec4, 4, |p: Vec4| p.to_array(), Vec4::from_array);
