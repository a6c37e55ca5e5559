//! Shapes: functions applied to every octave of a sum before it is added.

use core::fmt::Debug;

/// A function φ applied to every octave of a sum.
///
/// The shapes are [`Signed`], which is the noise itself, [`Turbulence`](crate::Turbulence),
/// [`Plasma`](crate::Plasma), [`Billow`](crate::Billow), [`Ridged`](crate::Ridged), and your own.
/// Shapes are zero-sized and cost only their arithmetic.
///
/// ```
/// use asperity_noise::{Field, Fbm, Shape, Simplex, FbmSpectrum, glam::Vec2};
///
/// /// n², dark where an octave is 0, without a crease.
/// #[derive(Clone, Copy, Debug)]
/// struct Squares;
///
/// impl Shape for Squares {
///     fn value(self, n: f32) -> f32 { n * n }
///     fn slope(self, n: f32) -> f32 { 2.0 * n }
///     fn range(self, bound: f32) -> [f32; 2] { [0.0, bound * bound] }
///     fn mean_and_deviation(self, _: f32, [_, second, _, fourth]: [f32; 4]) -> [f32; 2] {
///         [second, (fourth - second * second).sqrt()]
///     }
/// }
///
/// let sum = Fbm::new(Simplex::new(5), FbmSpectrum::CLOUD).with_shape(Squares);
/// assert!(sum.value(Vec2::new(0.4, 0.1)).is_finite());
/// ```
pub trait Shape: Copy + Debug {
    /// Whether φ(n) = n, so that φ need not be computed.
    const IS_IDENTITY: bool = false;

    /// Returns φ(n).
    fn value(self, n: f32) -> f32;

    /// Returns φ′(n); at a crease the mean of the slopes of both sides.
    fn slope(self, n: f32) -> f32;

    /// Returns lower and upper bound of φ(n) for |n| ≤ `bound`.
    fn range(self, bound: f32) -> [f32; 2];

    /// Returns mean and standard deviation of φ(n), from the moments of n.
    ///
    /// `moments` are E|n|, E|n|², E|n|³ and E|n|⁴, see
    /// [`Moments::absolute`](crate::Moments::absolute).
    fn mean_and_deviation(self, standard_deviation: f32, moments: [f32; 4]) -> [f32; 2];
}

/// Fractional Brownian motion, φ(n) = n.
///
/// With [`FbmSpectrum::CLOUD`](crate::FbmSpectrum::CLOUD) it is the cloud pattern of Nilsson 2008,
/// section 4.1.5.
#[doc(alias = "fbm")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Signed;

impl Shape for Signed {
    const IS_IDENTITY: bool = true;

    #[inline(always)]
    fn value(self, n: f32) -> f32 {
        n
    }

    #[inline(always)]
    fn slope(self, _: f32) -> f32 {
        1.0
    }

    fn range(self, bound: f32) -> [f32; 2] {
        [-bound, bound]
    }

    fn mean_and_deviation(self, standard_deviation: f32, _: [f32; 4]) -> [f32; 2] {
        [0.0, standard_deviation]
    }
}
