//! Kinds of noise: random fields with measured statistics.

use crate::statistics::statistics::Statistics;

/// A kind of noise: a random field selected by a seed, with measured statistics.
///
/// ```
/// use asperity_noise::{Field, Noise, Perlin, glam::Vec3};
///
/// let noise = Perlin::new(1);
/// let sample = noise.sample(Vec3::new(0.3, -4.2, 7.9));
/// assert!(sample.value.abs() <= noise.statistics(3).range);
/// assert_eq!(noise.value(Vec3::new(f32::NAN, 0.0, 0.0)), 0.0);
/// ```
pub trait Noise {
    /// Returns the measured statistics in 1 to 4 dimensions, of the nearest of these for other
    /// numbers.
    ///
    /// [`Field::moments`](crate::Field::moments) includes the parameters of the kind, such as the
    /// weight of [`ValueGradient`](crate::ValueGradient).
    #[must_use]
    fn statistics(&self, dimension: usize) -> &'static Statistics;

    /// Returns the noise with another seed.
    #[must_use]
    fn with_seed(self, seed: u32) -> Self
    where
        Self: Sized;
}

/// The constructors of a kind, with the initial values of its parameters.
macro_rules! kind {
    ($kind:ident $({ $($parameter:ident: $value:expr),+ }, $about:literal)?) => {
        impl $kind {
            #[doc = concat!("The noise that `seed` selects", $(", ", $about,)? ".")]
            #[must_use]
            pub const fn new(seed: u32) -> Self {
                Self { seed, $($($parameter: $value,)+)? lattice: $crate::lattice::integer_hash::IntegerHash }
            }
        }

        impl Default for $kind {
            #[doc = concat!("Seed 0", $(", ", $about,)? ".")]
            fn default() -> Self {
                Self::new(0)
            }
        }

        impl<L> $kind<L> {
            /// Sets the lattice that random words are drawn from.
            #[must_use]
            pub fn with_lattice<M>(self, lattice: M) -> $kind<M> {
                $kind { seed: self.seed, $($($parameter: self.$parameter,)+)? lattice }
            }

            /// The noise on the standard lattice.
            #[inline(always)]
            pub(crate) fn standard(&self) -> $kind {
                let lattice = $crate::lattice::integer_hash::IntegerHash;
                $kind { seed: self.seed, $($($parameter: self.$parameter,)+)? lattice }
            }

            /// Makes the noise periodic along each axis.
            ///
            /// If p and p + period are both exact in `f32`, values and gradients have the same
            /// bits. From |x| = 2³¹ on cells wrap modulo 2³², and only periods that are powers of
            /// two continue. Call [`Fbm::tiled`](crate::Fbm::tiled) for sums of octaves.
            ///
            /// # Errors
            ///
            /// If a period is 0 or above 2²¹, or in simplex noise in 3-D not a multiple of 3.
            #[doc(alias("seamless", "tileable", "periodic"))]
            pub fn tiled<const N: usize>(
                self,
                periods: [u32; N],
            ) -> Result<
                <Self as $crate::lattice::tiled::Tile<N>>::Tiled,
                $crate::error::NoiseError,
            >
            where
                Self: $crate::lattice::tiled::Tile<N>,
            {
                $crate::lattice::tiled::Tile::tiled(self, periods)
            }

            /// Sets the seed.
            #[must_use]
            pub fn with_seed(self, seed: u32) -> Self {
                Self { seed, ..self }
            }
        }

        impl<L: $crate::lattice::lattice::Lattice> $crate::lattice::lattice::OnLattice for $kind<L> {
            type Lattice = L;

            #[inline(always)]
            fn lattice(&self) -> &L {
                &self.lattice
            }

            #[inline(always)]
            fn of_octave(&self, frequency: f32, cell: &[i32]) -> Option<Self> {
                let lattice = self.lattice.of_octave(frequency, cell)?;
                Some($kind { seed: self.seed, $($($parameter: self.$parameter,)+)? lattice })
            }
        }

        impl<L: $crate::lattice::lattice::Lattice + Clone, const N: usize> $crate::contract::kernel::Anchor<N> for $kind<L>
        where
            Self: $crate::contract::kernel::Kernel<N>,
            $kind<$crate::lattice::shifted::Shifted<L, N>>: $crate::contract::kernel::Kernel<N>,
        {
            type Shifted = $kind<$crate::lattice::shifted::Shifted<L, N>>;

            fn shifted(self) -> Self::Shifted {
                let lattice = $crate::lattice::shifted::Shifted::new(self.lattice.clone());
                self.with_lattice(lattice)
            }
        }
    };
}

pub(crate) use kind;

/// Implements `Tile` for a kind on the integer lattice.
macro_rules! tiles {
    ($kind:ident) => {
        impl<L: Clone, const N: usize> $crate::lattice::tiled::Tile<N> for $kind<L> {
            type Tiled = $kind<$crate::lattice::tiled::Tiled<L, N>>;

            fn tiled(self, periods: [u32; N]) -> Result<Self::Tiled, $crate::error::NoiseError> {
                let lattice = $crate::lattice::tiled::Tiled::new(self.lattice.clone(), periods)?;
                Ok(self.with_lattice(lattice))
            }
        }
    };
}

pub(crate) use tiles;

/// Implements `Measured` for a kind whose statistics are all in one table.
macro_rules! measured {
    ($kind:ident, |$self:ident| $table:expr) => {
        impl<L, const N: usize> $crate::contract::kernel::Measured<N> for $kind<L> {
            fn seed(&$self) -> u32 {
                $self.seed
            }

            fn statistics(&$self) -> &'static $crate::statistics::statistics::Statistics {
                let table: &[_; 4] = $table;
                &table[N - 1]
            }
        }
    };
}

pub(crate) use measured;

/// The public traits of a kind that is a [`Kernel`](crate::contract::kernel::Kernel), in all
/// dimensions or in one.
macro_rules! noise {
    ($kind:ident) => {
        noise!($kind, [, const N: usize], N);
        $crate::contract::compiled::compiled!($kind);

        impl<L> $crate::contract::noise::Noise for $kind<L> {
            fn statistics(&self, dimension: usize) -> &'static $crate::statistics::statistics::Statistics {
                match dimension {
                    0 | 1 => $crate::contract::kernel::Measured::<1>::statistics(self),
                    2 => $crate::contract::kernel::Measured::<2>::statistics(self),
                    3 => $crate::contract::kernel::Measured::<3>::statistics(self),
                    _ => $crate::contract::kernel::Measured::<4>::statistics(self),
                }
            }

            fn with_seed(self, seed: u32) -> Self {
                $kind::with_seed(self, seed)
            }
        }
    };
    ($kind:ident, curved) => {
        noise!($kind);

        impl<V, L, const N: usize> $crate::contract::field::HasHessian<V> for $kind<L>
        where
            V: $crate::point::Point<Coordinates = [f32; N], Matrix = [[f32; N]; N]>,
            L: $crate::lattice::lattice::Lattice,
        {
            #[inline]
            fn sample_with_hessian(&self, p: V) -> $crate::sample::SampleHessian<V> {
                $crate::contract::hessian::at(self, p.coordinates(), self.seed).at()
            }

            #[inline]
            fn octave_with_hessian(
                &self,
                p: V,
                octave: $crate::contract::field::OctaveOf<'_>,
            ) -> $crate::sample::SampleHessian<V> {
                let own = $crate::contract::kernel::Kernel::<N>::of_octave(self, octave.frequency, octave.cell);
                $crate::contract::hessian::at(own.as_ref().unwrap_or(self), p.coordinates(), octave.seed).at()
            }
        }
    };
    ($kind:ident, [$($generic:tt)*], $n:tt $(, $bound:path)?) => {
        impl<V, L $($generic)*> $crate::contract::field::Field<V> for $kind<L>
        where
            V: $crate::point::Point<Coordinates = [f32; $n]>,
            L: $crate::lattice::lattice::Lattice $(+ $bound)?,
        {
            #[inline]
            fn sample(&self, p: V) -> $crate::sample::Sample<V> {
                let seed = $crate::contract::kernel::Measured::<$n>::seed(self);
                let (value, gradient) =
                    $crate::contract::kernel::Kernel::<$n>::sample_at(self, p.coordinates(), seed);
                $crate::sample::Sample { value, gradient: V::from_coordinates(gradient) }
            }

            #[inline]
            fn value(&self, p: V) -> f32 {
                let seed = $crate::contract::kernel::Measured::<$n>::seed(self);
                $crate::contract::kernel::Kernel::<$n>::value_at(self, p.coordinates(), seed)
            }

            fn range(&self) -> [f32; 2] {
                $crate::contract::kernel::Measured::<$n>::bounds(self)
            }

            #[inline]
            fn moments(&self) -> Option<$crate::statistics::statistics::Moments> {
                Some($crate::statistics::statistics::Moments {
                    mean: $crate::contract::kernel::Measured::<$n>::mean(self),
                    standard_deviation: $crate::contract::kernel::Measured::<$n>::standard_deviation(self),
                    absolute: $crate::contract::kernel::Measured::<$n>::absolute_moments(self),
                })
            }

            fn seed(&self) -> u32 {
                $crate::contract::kernel::Measured::<$n>::seed(self)
            }

            #[inline(always)]
            fn visit<R: $crate::contract::field::Visit<V>>(&self, visitor: R) -> R::Output {
                visitor.kernel::<Self, $n>(self)
            }

            fn fill(
                &self,
                points: &$crate::row::points::Points<'_, V>,
                target: $crate::row::points::Target<'_, V>,
            ) {
                $crate::contract::kernel::fill::<Self, V, $n>(self, points, target);
            }
        }
    };
}

pub(crate) use noise;
