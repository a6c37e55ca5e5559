//! Sums of octaves: spectra, shapes, the octaves of any kind of noise, and the words of their uniforms.
//!
//! A module holds up to [`SUMS`] sums of a dimension, which functions number from 0: a field and those that warp it, for instance.
//! Sums of octaves of any kind call a function of one octave, and a part beside them says which:
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use asperity_shaders::{Bindings, compose, noise::sums};
//!
//! let parts = [&sums::OCTAVES_3D, &sums::OF_PERLIN_2002];
//! let wgsl = compose(&parts, Bindings::Textures { group: 0 });
//! assert!(wgsl.contains("fn octaves_sum_3d(p: vec3<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample3d"));
//! assert!(wgsl.contains("var<uniform> octaves_uniform_3d: array<OctavesUniform3d, 8>;"));
//! # }
//! ```

mod uniform;

pub use uniform::{OctavesUniform, ShaderShape};

use super::{
    CELL, GAUSSIAN, PERLIN_1985, PERLIN_2002, SAMPLE, SIMPLEX, SPARSE, VALUE, VALUE_CATMULL_ROM,
    VALUE_GRADIENT,
};
use crate::part::{Binding, Part, part};

/// Sums of octaves that a uniform holds, numbered from 0. Those that a module does not use may hold anything.
pub const SUMS: usize = 8;

/// Shapes of octaves, [`Turbulence`](asperity_noise::Turbulence) and its like.
pub static SHAPE: Part = part!("noise/sums/shape");

/// Frequency clamping, [`removed_share`](asperity_noise::removed_share).
pub static FREQUENCY_CLAMP: Part = part!("noise/sums/frequency_clamp");

/// Weights of a real number of octaves, [`Spectrum`](asperity_noise::Spectrum), and what a sum is divided by.
pub static SPECTRUM: Part = part!("noise/sums/spectrum", FREQUENCY_CLAMP);

/// One octave, [`Octave`](asperity_noise::Octave): its map in two, three and four dimensions.
pub static OCTAVE: Part = part!("noise/sums/octave");

/// Uniform of sums of octaves in space.
pub static UNIFORM_3D: Part = part!("noise/sums/uniform_3d", SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "octaves_uniform_3d", of: "array<OctavesUniform3d, 8>" }]);

/// Uniform of sums of octaves in the plane.
pub static UNIFORM_2D: Part = part!("noise/sums/uniform_2d", SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "octaves_uniform_2d", of: "array<OctavesUniform2d, 8>" }]);

/// Uniform of sums of octaves in four dimensions.
pub static UNIFORM_4D: Part = part!("noise/sums/uniform_4d", SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "octaves_uniform_4d", of: "array<OctavesUniform4d, 8>" }]);

/// Sums of octaves of Gaussian noise in space, two channels, [`GaussianOctaves`](asperity_noise::GaussianOctaves).
pub static GAUSSIAN_OCTAVES_3D: Part =
    part!("noise/sums/gaussian_octaves_3d", SPECTRUM, OCTAVE, UNIFORM_3D, CELL, GAUSSIAN);

/// Sums of octaves of Gaussian noise in the plane, two channels, [`GaussianOctaves`](asperity_noise::GaussianOctaves).
pub static GAUSSIAN_OCTAVES_2D: Part =
    part!("noise/sums/gaussian_octaves_2d", SPECTRUM, OCTAVE, UNIFORM_2D, CELL, GAUSSIAN);

/// Sums of octaves of any kind in space, [`Octaves`](asperity_noise::Octaves); with a part that says which kind.
pub static OCTAVES_3D: Part =
    part!("noise/sums/octaves_3d", SAMPLE, SHAPE, FREQUENCY_CLAMP, SPECTRUM, OCTAVE, UNIFORM_3D);

/// Sums of octaves of any kind in the plane, [`Octaves`](asperity_noise::Octaves); with a part that says which kind.
pub static OCTAVES_2D: Part =
    part!("noise/sums/octaves_2d", SAMPLE, SHAPE, FREQUENCY_CLAMP, SPECTRUM, OCTAVE, UNIFORM_2D);

/// Sums of octaves in four dimensions, [`Octaves`](asperity_noise::Octaves), for what moves in space; with a part that says which kind.
pub static OCTAVES_4D: Part =
    part!("noise/sums/octaves_4d", SAMPLE, SHAPE, FREQUENCY_CLAMP, SPECTRUM, OCTAVE, UNIFORM_4D);

/// Ridges that bear ridges in space, [`RidgedMultifractal`](asperity_noise::RidgedMultifractal); with a part that says which kind.
pub static RIDGED_MULTIFRACTAL_3D: Part =
    part!("noise/sums/ridged_multifractal_3d", SAMPLE, SHAPE, SPECTRUM, OCTAVE, UNIFORM_3D);

/// Ridges that bear ridges in the plane, [`RidgedMultifractal`](asperity_noise::RidgedMultifractal); with a part that says which kind.
pub static RIDGED_MULTIFRACTAL_2D: Part =
    part!("noise/sums/ridged_multifractal_2d", SAMPLE, SHAPE, SPECTRUM, OCTAVE, UNIFORM_2D);

/// Ridges that bear ridges in four dimensions, [`RidgedMultifractal`](asperity_noise::RidgedMultifractal); with a part that says which
/// kind.
pub static RIDGED_MULTIFRACTAL_4D: Part =
    part!("noise/sums/ridged_multifractal_4d", SAMPLE, SHAPE, SPECTRUM, OCTAVE, UNIFORM_4D);

/// Octaves of value noise, [`Value`](asperity_noise::Value), in two to four dimensions.
pub static OF_VALUE: Part = part!("noise/sums/octaves_of/value", SAMPLE, CELL, VALUE);

/// Octaves of Perlin's noise of 1985, [`Perlin1985`](asperity_noise::Perlin1985).
pub static OF_PERLIN_1985: Part = part!("noise/sums/octaves_of/perlin_1985", SAMPLE, CELL, PERLIN_1985);

/// Octaves of Perlin's noise of 2002, [`Perlin2002`](asperity_noise::Perlin2002), in two to four dimensions.
pub static OF_PERLIN_2002: Part = part!("noise/sums/octaves_of/perlin_2002", SAMPLE, CELL, PERLIN_2002);

/// Octaves of value-gradient noise with equal weights, [`ValueGradient`](asperity_noise::ValueGradient).
pub static OF_VALUE_GRADIENT: Part =
    part!("noise/sums/octaves_of/value_gradient", SAMPLE, CELL, VALUE_GRADIENT);

/// Octaves of Gaussian noise, one channel, [`Gaussian`](asperity_noise::Gaussian).
pub static OF_GAUSSIAN: Part = part!("noise/sums/octaves_of/gaussian", SAMPLE, CELL, GAUSSIAN);

/// Octaves of value noise by splines, [`ValueCatmullRom`](asperity_noise::ValueCatmullRom).
pub static OF_VALUE_CATMULL_ROM: Part =
    part!("noise/sums/octaves_of/value_catmull_rom", SAMPLE, CELL, VALUE_CATMULL_ROM);

/// Octaves of simplex noise with the continuous kernel, [`Simplex`](asperity_noise::Simplex), in two to four dimensions.
pub static OF_SIMPLEX: Part = part!("noise/sums/octaves_of/simplex", SAMPLE, SIMPLEX);

/// Octaves of simplex noise with the customary wider kernel, [`Simplex`](asperity_noise::Simplex), in two to four dimensions.
pub static OF_SIMPLEX_WIDE: Part = part!("noise/sums/octaves_of/simplex_wide", SAMPLE, SIMPLEX);

/// Octaves of sparse convolution noise of one impulse per cell, [`Sparse`](asperity_noise::Sparse).
pub static OF_SPARSE: Part = part!("noise/sums/octaves_of/sparse_convolution", SAMPLE, CELL, SPARSE);
