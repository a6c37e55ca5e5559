//! Kinds on [`IntegerHash`](crate::IntegerHash) in one to three dimensions, compiled in this crate.
//!
//! Kinds are generic over their lattice, and kernels over the lanes. Without this module every
//! program would compile each kind again for each SIMD level. A build with debug assertions does,
//! because compiling the used kinds without optimization takes less time than compiling all kinds.

use core::any::Any;

use crate::{
    contract::kernel::{FillList, FillRow, Kernel, OctaveSamples, OctavesAt, lone},
    lanes::level::Instructions,
    lanes::{LaneSample, Scalar},
    lattice::lattice::{IS_FULL, Lattice, OnLattice},
};

/// The dimensions that kinds are compiled in.
///
/// A kind in 4-D takes as long to compile as in all other dimensions together, and few programs use
/// it.
const DIMENSIONS: usize = 3;

/// Whether kinds on a lattice are compiled here.
#[must_use]
pub(crate) const fn is_compiled<L: Lattice>(dimensions: usize) -> bool {
    L::STANDARD && dimensions <= DIMENSIONS
}

/// Whether a kind, on its own lattice, is compiled here.
pub(crate) const fn has_forms<K: OnLattice>(dimensions: usize) -> bool {
    is_compiled::<K::Lattice>(dimensions)
}

/// The evaluations of a kind in N dimensions.
pub(crate) struct Forms<K: Kernel<N>, const N: usize> {
    pub(crate) value: fn(&K, [f32; N], u32) -> f32,
    pub(crate) sample: fn(&K, [f32; N], u32) -> LaneSample<Scalar, N>,
    pub(crate) row: fn(FillRow<'_, K, N>, Instructions),
    pub(crate) list: fn(FillList<'_, K, N>, Instructions),
    pub(crate) octaves: fn(&K, OctavesAt<'_, N>, &mut OctaveSamples<N>) -> Option<()>,
}

impl<K: Kernel<N>, const N: usize> Forms<K, N> {
    /// The evaluations, in a [full](IS_FULL) build.
    ///
    /// The functions of a static are compiled even if it is unused.
    pub(crate) const ALL: Self = if IS_FULL {
        Self {
            value: |noise, p, seed| lone::<K, N, false>(noise, p, seed).0,
            sample: |noise, p, seed| lone::<K, N, true>(noise, p, seed),
            row: |call, instructions| call.at(instructions),
            list: |call, instructions| call.at(instructions),
            octaves: |noise, octaves, samples| octaves.evaluate(noise, samples),
        }
    } else {
        Self::NONE
    };

    /// For dimensions that are not compiled and builds that are not full.
    pub(crate) const NONE: Self = Self {
        value: |_, _, _| 0.0,
        sample: |_, _, _| (0.0, [0.0; N]),
        row: |_, _| (),
        list: |_, _| (),
        octaves: |_, _, _| None,
    };
}

/// A kind of noise that this crate compiles.
pub(crate) trait Compiled<const N: usize>: Sized + 'static {
    /// Its evaluations.
    fn forms() -> &'static Forms<Self, N>
    where
        Self: Kernel<N>;
}

/// Selects the forms in N dimensions from the forms of all dimensions.
#[inline(always)]
pub(crate) fn in_dimension<T: 'static, const N: usize>(
    forms: [&'static dyn Any; DIMENSIONS],
) -> Option<&'static T> {
    forms.get(N - 1)?.downcast_ref()
}

/// Implements `Compiled` for a kind, with statics that dependent programs do not compile again.
macro_rules! compiled {
    ($kind:ident) => {
        impl<const N: usize> $crate::contract::compiled::Compiled<N> for $kind {
            #[inline(always)]
            fn forms() -> &'static $crate::contract::compiled::Forms<Self, N> {
                use $crate::contract::compiled::Forms;
                static LINE: Forms<$kind, 1> = Forms::ALL;
                static PLANE: Forms<$kind, 2> = Forms::ALL;
                static SPACE: Forms<$kind, 3> = Forms::ALL;
                let forms = $crate::contract::compiled::in_dimension::<_, N>([&LINE, &PLANE, &SPACE]);
                forms.unwrap_or(const { &Forms::NONE })
            }
        }
    };
}

pub(crate) use compiled;

/// The methods of a [`Kernel`] that this crate compiles for the standard lattice.
macro_rules! on_standard_lattice {
    () => {
        #[inline]
        fn value_at(&self, p: [f32; N], seed: u32) -> f32 {
            use $crate::contract::compiled::Compiled;
            if const { $crate::contract::compiled::has_forms::<Self>(N) } {
                return (Compiled::<N>::forms().value)(&self.standard(), p, seed);
            }
            $crate::contract::kernel::lone::<Self, N, false>(self, p, seed).0
        }

        #[inline]
        fn sample_at(&self, p: [f32; N], seed: u32) -> $crate::lanes::LaneSample<$crate::lanes::Scalar, N> {
            use $crate::contract::compiled::Compiled;
            if const { $crate::contract::compiled::has_forms::<Self>(N) } {
                return (Compiled::<N>::forms().sample)(&self.standard(), p, seed);
            }
            $crate::contract::kernel::lone::<Self, N, true>(self, p, seed)
        }

        fn fill_row(
            call: $crate::contract::kernel::FillRow<'_, Self, N>,
            instructions: $crate::lanes::level::Instructions,
        ) {
            use $crate::contract::{compiled::Compiled, kernel::FillRow};
            if const { $crate::contract::compiled::has_forms::<Self>(N) } {
                let FillRow { kernel, seed, row, scratch, values, gradients } = call;
                let call = FillRow { kernel: &kernel.standard(), seed, row, scratch, values, gradients };
                return (Compiled::<N>::forms().row)(call, instructions);
            }
            call.at(instructions);
        }

        fn fill_list(
            call: $crate::contract::kernel::FillList<'_, Self, N>,
            instructions: $crate::lanes::level::Instructions,
        ) {
            use $crate::contract::{compiled::Compiled, kernel::FillList};
            if const { $crate::contract::compiled::has_forms::<Self>(N) } {
                let FillList { kernel, seed, points, values, gradients } = call;
                let call = FillList { kernel: &kernel.standard(), seed, points, values, gradients };
                return (Compiled::<N>::forms().list)(call, instructions);
            }
            call.at(instructions);
        }

        fn octaves_at(
            &self,
            octaves: $crate::contract::kernel::OctavesAt<'_, N>,
            samples: &mut $crate::contract::kernel::OctaveSamples<N>,
        ) -> Option<()> {
            use $crate::contract::compiled::Compiled;
            if const { $crate::contract::compiled::has_forms::<Self>(N) } {
                return (Compiled::<N>::forms().octaves)(&self.standard(), octaves, samples);
            }
            octaves.evaluate(self, samples)
        }
    };
}

pub(crate) use on_standard_lattice;

/// The methods of a [`Kernel`] for octaves, by its lattice.
macro_rules! on_lattice {
    () => {
        $crate::contract::compiled::on_standard_lattice!();

        const TILED: bool = <<Self as $crate::lattice::lattice::OnLattice>::Lattice as $crate::lattice::lattice::Lattice>::TILED;

        fn period(&self, axis: usize) -> u32 {
            $crate::lattice::lattice::Lattice::period($crate::lattice::lattice::OnLattice::lattice(self), axis)
        }

        fn key(&self, seed: u32) -> u32 {
            $crate::lattice::lattice::Lattice::key($crate::lattice::lattice::OnLattice::lattice(self), seed)
        }

        #[inline(always)]
        fn of_octave(&self, frequency: f32, cell: &[i32]) -> Option<Self> {
            $crate::lattice::lattice::OnLattice::of_octave(self, frequency, cell)
        }
    };
}

pub(crate) use on_lattice;
