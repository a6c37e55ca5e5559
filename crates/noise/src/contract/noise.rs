//! Kinds of noise: their statistics, moments and seeds, beside their values.

use crate::{contract::field::Field, point::Point, statistics::statistics::Statistics};

/// A kind of noise: a random field, one of many that its seed selects, with measured statistics.
///
/// ```
/// use asperity_noise::{Field, Noise, Perlin2002, glam::Vec3};
///
/// let noise = Perlin2002::new(1);
/// let sample = noise.sample(Vec3::new(0.3, -4.2, 7.9));
/// assert!(sample.value.abs() <= Noise::<Vec3>::statistics(&noise).range);
/// assert_eq!(noise.value(Vec3::new(f32::NAN, 0.0, 0.0)), 0.0);
/// ```
pub trait Noise<V: Point>: Field<V> {
    /// The measured statistics of the kind in this dimension.
    #[must_use]
    fn statistics(&self) -> &'static Statistics;

    /// σ₁, the standard deviation of this very noise; other than the table's where a kind has parameters.
    #[must_use]
    fn standard_deviation(&self) -> f32;

    /// E|n|, E|n|², E|n|³ and E|n|⁴ over all points and seeds, measured; what a [`Shape`](crate::Shape)'s mean follows from.
    #[must_use]
    fn absolute_moments(&self) -> [f32; 4];

    /// The seed.
    #[must_use]
    fn seed(&self) -> u32;

    /// The noise that another seed selects.
    #[must_use]
    fn with_seed(self, seed: u32) -> Self
    where
        Self: Sized;
}

/// A kind without parameters: its constructor, its seed and its lattice.
macro_rules! kind {
    ($kind:ident) => {
        impl $kind {
            /// The noise that `seed` selects.
            #[must_use]
            pub const fn new(seed: u32) -> Self {
                Self { seed, lattice: IntegerHash }
            }
        }

        impl Default for $kind {
            /// Seed 0.
            fn default() -> Self {
                Self::new(0)
            }
        }

        impl<L> $kind<L> {
            /// Its words drawn from another lattice.
            #[must_use]
            pub fn with_lattice<M>(self, lattice: M) -> $kind<M> {
                $kind { seed: self.seed, lattice }
            }

            /// Another seed.
            #[must_use]
            pub fn with_seed(self, seed: u32) -> Self {
                Self { seed, ..self }
            }
        }
    };
}

pub(crate) use kind;

/// The public traits of a kind that is a [`Kernel`](crate::simd::Kernel).
macro_rules! noise {
    ($kind:ident) => {
        impl<V, L, const N: usize> $crate::contract::field::Field<V> for $kind<L>
        where
            V: $crate::point::Point<Coordinates = [f32; N]>,
            L: $crate::lattice::lattice::Lattice,
        {
            #[inline]
            fn sample(&self, p: V) -> $crate::sample::Sample<V> {
                let (value, gradient) = $crate::contract::kernel::samples(
                    self,
                    $crate::lanes::lanes::Scalar,
                    p.coordinates(),
                    self.seed,
                );
                $crate::sample::Sample { value, gradient: V::from_coordinates(gradient) }
            }

            #[inline]
            fn value(&self, p: V) -> f32 {
                $crate::contract::kernel::values(
                    self,
                    $crate::lanes::lanes::Scalar,
                    p.coordinates(),
                    self.seed,
                )
            }

            fn range(&self) -> [f32; 2] {
                let range = $crate::contract::kernel::Kernel::<N>::statistics(self).range;
                [-range, range]
            }

            fn fill(
                &self,
                points: &$crate::row::points::Points<'_, V>,
                target: $crate::row::points::Target<'_, V>,
            ) {
                $crate::contract::kernel::fill::<Self, V, N>(self, points, target);
            }
        }

        impl<V, L, const N: usize> $crate::contract::noise::Noise<V> for $kind<L>
        where
            V: $crate::point::Point<Coordinates = [f32; N]>,
            L: $crate::lattice::lattice::Lattice,
        {
            fn statistics(&self) -> &'static $crate::statistics::statistics::Statistics {
                $crate::contract::kernel::Kernel::<N>::statistics(self)
            }

            fn standard_deviation(&self) -> f32 {
                $crate::contract::kernel::Kernel::<N>::standard_deviation(self)
            }

            fn absolute_moments(&self) -> [f32; 4] {
                $crate::contract::kernel::Kernel::<N>::absolute_moments(self)
            }

            fn seed(&self) -> u32 {
                self.seed
            }

            #[inline]
            fn with_seed(self, seed: u32) -> Self {
                $kind::with_seed(self, seed)
            }
        }
    };
    ($kind:ident, curved) => {
        noise!($kind);

        impl<V, L, const N: usize> $crate::contract::field::Curved<V> for $kind<L>
        where
            V: $crate::point::Point<Coordinates = [f32; N], Matrix = [[f32; N]; N]>,
            L: $crate::lattice::lattice::Lattice,
        {
            #[inline]
            fn second_order(&self, p: V) -> $crate::sample::SecondOrder<V> {
                $crate::contract::hessian::at(self, p.coordinates(), self.seed).at()
            }
        }
    };
}

pub(crate) use noise;
