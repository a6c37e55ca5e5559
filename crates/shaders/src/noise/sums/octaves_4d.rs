//! Sums of octaves in four dimensions, of the kinds that move in space; and what sums of a kind of one's own are made of.

use super::{OCTAVE, SHAPE, SPECTRUM, UNIFORM_4D};
use crate::noise::{self, CELL, SAMPLE};
use crate::part::{Part, part};

/// Sum of octaves under way, [`Octaves`](asperity_noise::Octaves): what octaves of any kind are added to.
pub static TOTAL: Part = part!("noise/sums/octaves_4d/total", SAMPLE, SHAPE, SPECTRUM, OCTAVE, UNIFORM_4D);

/// Ridges that bear ridges under way, [`RidgedMultifractal`](asperity_noise::RidgedMultifractal).
///
/// Its octaves are those of a uniform's sum, of whatever shape and normalisation.
pub static RIDGED_MULTIFRACTAL: Part =
    part!("noise/sums/octaves_4d/ridged_multifractal", SAMPLE, SHAPE, SPECTRUM, OCTAVE, UNIFORM_4D);

/// Octaves of value noise, [`Value`](asperity_noise::Value): their sums and their ridged multifractal.
pub static VALUE: Part = part!(
    "noise/sums/octaves_4d/value",
    SAMPLE,
    CELL,
    noise::VALUE,
    SPECTRUM,
    OCTAVE,
    UNIFORM_4D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of Perlin's noise of 2002, [`Perlin2002`](asperity_noise::Perlin2002): their sums and their ridged multifractal.
pub static PERLIN_2002: Part = part!(
    "noise/sums/octaves_4d/perlin_2002",
    SAMPLE,
    CELL,
    noise::PERLIN_2002,
    SPECTRUM,
    OCTAVE,
    UNIFORM_4D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of simplex noise with the continuous kernel, [`Simplex`](asperity_noise::Simplex): their sums and their ridged
/// multifractal.
pub static SIMPLEX: Part = part!(
    "noise/sums/octaves_4d/simplex",
    SAMPLE,
    noise::SIMPLEX,
    SPECTRUM,
    OCTAVE,
    UNIFORM_4D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);

/// Octaves of simplex noise with the customary wider kernel, [`Simplex`](asperity_noise::Simplex): their sums and their ridged
/// multifractal.
pub static SIMPLEX_WIDE: Part = part!(
    "noise/sums/octaves_4d/simplex_wide",
    SAMPLE,
    noise::SIMPLEX,
    SPECTRUM,
    OCTAVE,
    UNIFORM_4D,
    TOTAL,
    RIDGED_MULTIFRACTAL
);
