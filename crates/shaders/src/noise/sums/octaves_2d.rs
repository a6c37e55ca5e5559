//! Sums of octaves in the plane, of every kind of noise; and what sums of a kind of one's own are made of.

use super::{OCTAVE, SHAPE, SPECTRUM, UNIFORM_2D};
use crate::noise::{self, CELL, SAMPLE};
use crate::part::{Part, part};

/// Sum of octaves under way, [`Octaves`](asperity_noise::Octaves): what octaves of any kind are added to.
pub static TOTAL: Part = part!("noise/sums/octaves_2d/total", SAMPLE, SHAPE, SPECTRUM, OCTAVE, UNIFORM_2D);

/// Ridges that bear ridges under way, [`RidgedMultifractal`](asperity_noise::RidgedMultifractal).
///
/// Its octaves are those of a uniform's sum, of whatever shape and normalisation.
pub static RIDGED_MULTIFRACTAL: Part =
    part!("noise/sums/octaves_2d/ridged_multifractal", SAMPLE, SHAPE, SPECTRUM, OCTAVE, UNIFORM_2D);

/// Octaves of value noise, [`Value`](asperity_noise::Value): their sums and their ridged multifractal.
pub static VALUE: Part = part!(
    "noise/sums/octaves_2d/value",
    SAMPLE,
    CELL,
    noise::VALUE,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of value noise by splines, [`ValueCatmullRom`](asperity_noise::ValueCatmullRom): their sums and their ridged
/// multifractal.
pub static VALUE_CATMULL_ROM: Part = part!(
    "noise/sums/octaves_2d/value_catmull_rom",
    SAMPLE,
    CELL,
    noise::VALUE_CATMULL_ROM,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of Perlin's noise of 1985, [`Perlin1985`](asperity_noise::Perlin1985): their sums and their ridged multifractal.
pub static PERLIN_1985: Part = part!(
    "noise/sums/octaves_2d/perlin_1985",
    SAMPLE,
    CELL,
    noise::PERLIN_1985,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of Perlin's noise of 2002, [`Perlin2002`](asperity_noise::Perlin2002): their sums and their ridged multifractal.
pub static PERLIN_2002: Part = part!(
    "noise/sums/octaves_2d/perlin_2002",
    SAMPLE,
    CELL,
    noise::PERLIN_2002,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of value-gradient noise with equal weights, [`ValueGradient`](asperity_noise::ValueGradient): their sums and their
/// ridged multifractal.
pub static VALUE_GRADIENT: Part = part!(
    "noise/sums/octaves_2d/value_gradient",
    SAMPLE,
    CELL,
    noise::VALUE_GRADIENT,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of simplex noise with the continuous kernel, [`Simplex`](asperity_noise::Simplex): their sums and their ridged
/// multifractal.
pub static SIMPLEX: Part = part!(
    "noise/sums/octaves_2d/simplex",
    SAMPLE,
    noise::SIMPLEX,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of simplex noise with the customary wider kernel, [`Simplex`](asperity_noise::Simplex): their sums and their ridged
/// multifractal.
pub static SIMPLEX_WIDE: Part = part!(
    "noise/sums/octaves_2d/simplex_wide",
    SAMPLE,
    noise::SIMPLEX,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of sparse convolution noise of one impulse per cell, [`Sparse`](asperity_noise::Sparse): their sums and their
/// ridged multifractal.
pub static SPARSE: Part = part!(
    "noise/sums/octaves_2d/sparse_convolution",
    SAMPLE,
    CELL,
    noise::SPARSE,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of Gaussian noise, one channel, [`Gaussian`](asperity_noise::Gaussian): their sums and their ridged multifractal,
/// `gaussian_channel_octaves_2d` and its like.
pub static GAUSSIAN: Part = part!(
    "noise/sums/octaves_2d/gaussian",
    SAMPLE,
    CELL,
    noise::GAUSSIAN,
    SPECTRUM,
    OCTAVE,
    UNIFORM_2D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);
