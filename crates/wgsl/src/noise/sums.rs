//! Sums of octaves: spectra, shapes, octaves of every kind of noise.
//!
//! A module has up to eight sums of a dimension, for instance a field and the fields that warp it.
//! Functions index them from 0. Every kind has its own function. A custom kind adds its octaves to
//! a [`TOTAL`](fbm_3d::TOTAL) in the same way.
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use asperity_wgsl::{Bindings, compose, noise::sums::fbm_3d};
//!
//! let wgsl = compose(&[&fbm_3d::PERLIN], Bindings::Textures { group: 0 });
//! assert!(wgsl.contains("fn perlin_fbm_3d(p: vec3<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample3d"));
//! assert!(wgsl.contains("fn perlin_multifractal_3d(p: vec3<f32>, octaves: f32, feedback: f32, sum: u32) -> Sample3d"));
//! assert!(wgsl.contains("var<uniform> fbm_uniform_3d: array<FbmUniform3d, 8>;"));
//! # }
//! ```
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use asperity_wgsl::{Bindings, Part, compose, noise::{self, sums::fbm_3d}};
//!
//! // A custom kind: value-gradient noise that is mostly gradients.
//! static STEEP: Part = Part::new(
//!     "steep",
//!     "fn steep(p: vec3<f32>, octaves: f32, sum: u32) -> Sample3d {
//!     var total = fbm_total_3d(octaves, 0.0, sum);
//!     while fbm_goes_on(total.walk) {
//!         let layer = fbm_layer_3d(sum, total.walk.octave);
//!         let at = cell_place_3d(fbm_point_3d(layer, p));
//!         let key = bitcast<u32>(layer.cell_and_key.w);
//!         let octave = value_gradient_in_cell_3d(layer.cell_and_key.xyz + at.cell, at.place, 0.9, key);
//!         total = fbm_added_3d(total, layer, sample_known_3d(octave, at.known));
//!     }
//!     return fbm_divided_3d(total);
//! }
//! ",
//!     &[&fbm_3d::TOTAL, &noise::VALUE_GRADIENT],
//! );
//! assert!(compose(&[&STEEP], Bindings::Textures { group: 0 }).contains("fn steep"));
//! # }
//! ```

pub mod fbm_2d;
pub mod fbm_3d;
pub mod fbm_4d;

mod fbm;
mod mip_mapped;

pub use mip_mapped::MipMapped;

use asperity_noise::gpu::{
    FbmLayer2d, FbmLayer3d, FbmLayer4d, FbmSpectrumUniform, FbmUniform2d, FbmUniform3d, FbmUniform4d,
};

use super::{CELL, GAUSSIAN};
use crate::part::{Binding, Part, part};

/// Shapes of octaves: [`Turbulence`](asperity_noise::Turbulence), plasma, billow and ridged.
pub static SHAPE: Part = part!("noise/sums/shape");

/// Frequency clamping, [`filtered_fraction`](asperity_noise::filtered_fraction).
pub static FREQUENCY_CLAMP: Part = part!("noise/sums/frequency_clamp");

/// Weights of a real number of octaves, [`FbmSpectrum`](asperity_noise::FbmSpectrum), and the
/// divisor of a sum.
pub static SPECTRUM: Part = part!("noise/sums/spectrum", [FbmSpectrumUniform], FREQUENCY_CLAMP);

/// One octave, such as [`FbmLayer3d`]: its affine map in two, three and four dimensions.
pub static OCTAVE: Part = part!("noise/sums/octave", [FbmLayer2d, FbmLayer3d, FbmLayer4d]);

/// Uniform of sums of octaves in 3-D.
pub static UNIFORM_3D: Part = part!("noise/sums/uniform_3d", [FbmUniform3d], SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "fbm_uniform_3d", of: "array<FbmUniform3d, 8>" }]);

/// Uniform of sums of octaves in 2-D.
pub static UNIFORM_2D: Part = part!("noise/sums/uniform_2d", [FbmUniform2d], SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "fbm_uniform_2d", of: "array<FbmUniform2d, 8>" }]);

/// Uniform of sums of octaves in 4-D.
pub static UNIFORM_4D: Part = part!("noise/sums/uniform_4d", [FbmUniform4d], SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "fbm_uniform_4d", of: "array<FbmUniform4d, 8>" }]);

/// Sums of octaves of Gaussian noise in 3-D, two channels,
/// [`GaussianFbm`](asperity_noise::GaussianFbm).
pub static GAUSSIAN_FBM_3D: Part =
    part!("noise/sums/gaussian_fbm_3d", SPECTRUM, OCTAVE, UNIFORM_3D, CELL, GAUSSIAN);

/// Sums of octaves of Gaussian noise in 2-D, two channels,
/// [`GaussianFbm`](asperity_noise::GaussianFbm).
pub static GAUSSIAN_FBM_2D: Part =
    part!("noise/sums/gaussian_fbm_2d", SPECTRUM, OCTAVE, UNIFORM_2D, CELL, GAUSSIAN);

/// Octaves of Gaussian noise in 2-D from a mip-mapped texture, [`MipMapped`].
///
/// The method of Kautz, Heidrich, Seidel 2001, §5.2.2. Bound to the two-channel texture
/// `mip_mapped_noise`, and to a repeating sampler that is linear between texels and levels.
pub static MIP_MAPPED: Part = part!("noise/sums/mip_mapped", SPECTRUM, UNIFORM_2D).with_bindings(&[
    Binding::Texture { name: "mip_mapped_noise" },
    Binding::Sampler { name: "mip_mapped_sampler" },
]);
