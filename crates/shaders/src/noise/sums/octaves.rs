//! Parts of sums of octaves, the same in every dimension.

/// The parts of sums in a dimension: a sum under way, a ridged multifractal, and octaves of kinds of noise by their names.
macro_rules! octaves {
    ($dimension:literal, $uniform:path, [$($kind:ident),*]) => {
        use $crate::noise::sums::{OCTAVE, SHAPE, SPECTRUM};
        use $crate::noise::{self, CELL, SAMPLE};
        use $crate::part::{Part, part};

        /// Sum of octaves under way, [`Octaves`](asperity_noise::Octaves): what octaves of any kind are added to.
        pub static TOTAL: Part = part!(
            concat!("noise/sums/octaves_", $dimension, "/total"),
            SAMPLE,
            SHAPE,
            SPECTRUM,
            OCTAVE,
            $uniform
        );

        /// Ridges that bear ridges under way, [`RidgedMultifractal`](asperity_noise::RidgedMultifractal).
        ///
        /// Its octaves are those of a uniform's sum, of whatever shape and normalisation.
        pub static RIDGED_MULTIFRACTAL: Part = part!(
            concat!("noise/sums/octaves_", $dimension, "/ridged_multifractal"),
            SAMPLE,
            SHAPE,
            SPECTRUM,
            OCTAVE,
            $uniform
        );

        $(octaves!(@$kind $dimension $uniform);)*
    };
    (@of $dimension:literal $uniform:path, $(#[$doc:meta])* $name:ident $file:literal $($need:path)*) => {
        $(#[$doc])*
        pub static $name: Part = part!(
            concat!("noise/sums/octaves_", $dimension, "/", $file),
            SAMPLE,
            $($need,)*
            SPECTRUM,
            OCTAVE,
            $uniform,
            TOTAL,
            RIDGED_MULTIFRACTAL
        );
    };
    (@VALUE $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of value noise, [`Value`](asperity_noise::Value): their sums and their ridged multifractal.
            VALUE "value" CELL noise::VALUE);
    };
    (@VALUE_CATMULL_ROM $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of value noise by splines, [`ValueCatmullRom`](asperity_noise::ValueCatmullRom): their sums and their ridged
            /// multifractal.
            VALUE_CATMULL_ROM "value_catmull_rom" CELL noise::VALUE_CATMULL_ROM);
    };
    (@PERLIN_1985 $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of Perlin's noise of 1985, [`Perlin1985`](asperity_noise::Perlin1985): their sums and their ridged multifractal.
            PERLIN_1985 "perlin_1985" CELL noise::PERLIN_1985);
    };
    (@PERLIN_2002 $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of Perlin's noise of 2002, [`Perlin2002`](asperity_noise::Perlin2002): their sums and their ridged multifractal.
            PERLIN_2002 "perlin_2002" CELL noise::PERLIN_2002);
    };
    (@VALUE_GRADIENT $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of value-gradient noise with equal weights, [`ValueGradient`](asperity_noise::ValueGradient): their sums and their
            /// ridged multifractal.
            VALUE_GRADIENT "value_gradient" CELL noise::VALUE_GRADIENT);
    };
    (@SIMPLEX $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of simplex noise with the continuous kernel, [`Simplex`](asperity_noise::Simplex): their sums and their ridged
            /// multifractal.
            SIMPLEX "simplex" noise::SIMPLEX);
    };
    (@SIMPLEX_WIDE $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of simplex noise with the customary wider kernel, [`Simplex`](asperity_noise::Simplex): their sums and their ridged
            /// multifractal.
            SIMPLEX_WIDE "simplex_wide" noise::SIMPLEX);
    };
    (@SPARSE $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of sparse convolution noise of one impulse per cell, [`Sparse`](asperity_noise::Sparse): their sums and their
            /// ridged multifractal.
            SPARSE "sparse_convolution" CELL noise::SPARSE);
    };
    (@GAUSSIAN $dimension:literal $uniform:path) => {
        octaves!(@of $dimension $uniform,
            /// Octaves of Gaussian noise, one channel, [`Gaussian`](asperity_noise::Gaussian): their sums and their ridged multifractal,
            /// `gaussian_channel_octaves_3d` and its like.
            GAUSSIAN "gaussian" CELL noise::GAUSSIAN);
    };
}

pub(crate) use octaves;
