//! What every kind of noise of this crate offers at a point.

use glam::{Vec2, Vec3, Vec4};

use crate::{
    contract::kernel::{Kernel, samples, values},
    contract::point::Point,
    contract::sample::Sample,
    simd::lanes::Scalar,
    statistics::statistics::Statistics,
};

/// A random field over points `V`, one of many that a seed selects.
///
/// Evaluation is total. A point with an infinite or NaN coordinate gives value 0 and gradient 0. From |x| = 2²³ on
/// `f32` holds integers only, so the noise is seen at its lattice points; from 2³¹ on cells wrap modulo 2³².
///
/// ```
/// use asperity_noise::{Noise, Perlin2002, glam::Vec3};
///
/// let noise = Perlin2002::default();
/// let sample = noise.sample(Vec3::new(0.3, -4.2, 7.9), 1);
/// assert!(sample.value.abs() <= 1.0);
/// assert_eq!(noise.sample(Vec3::new(f32::NAN, 0.0, 0.0), 1).value, 0.0);
/// ```
pub trait Noise<V> {
    /// Value and gradient at `p`.
    #[must_use]
    fn sample(&self, p: V, seed: u32) -> Sample<V>;

    /// The value alone, the same bits as [`sample`](Self::sample)'s.
    #[must_use]
    fn value(&self, p: V, seed: u32) -> f32;

    /// The measured statistics of the kind in this dimension.
    #[must_use]
    fn statistics(&self) -> &'static Statistics;
}

macro_rules! noise {
    ($vector:ty, $n:literal) => {
        impl<K: Kernel<$n>> Noise<$vector> for K {
            #[inline]
            fn sample(&self, p: $vector, seed: u32) -> Sample<$vector> {
                let (value, gradient) = samples(self, Scalar, Point::<$n>::coordinates(p), seed);
                Sample { value, gradient: Point::<$n>::from_coordinates(gradient) }
            }

            #[inline]
            fn value(&self, p: $vector, seed: u32) -> f32 {
                values(self, Scalar, Point::<$n>::coordinates(p), seed)
            }

            fn statistics(&self) -> &'static Statistics {
                Kernel::<$n>::statistics(self)
            }
        }
    };
}

noise!(f32, 1);
noise!(Vec2, 2);
noise!(Vec3, 3);
noise!(Vec4, 4);
