//! Lattice noises with exact analytic gradients, noise that is exactly Gaussian at every point, and sums of octaves.
//!
//! Every evaluation returns the value and the gradient together, in the plane ([`glam::Vec2`]) and in space
//! ([`glam::Vec3`]). [`GaussianOctaves`] is what a statistical model wants: its value is N(0, 1) at every point, for
//! every real number of octaves, in two independent channels at the price of one and a half. No allocation, no state.
//!
//! ```
//! use asperity_noise::{GaussianOctaves, Spectrum, glam::Vec3};
//!
//! let noise = GaussianOctaves::new(Spectrum::default(), 42);
//! let p = Vec3::new(0.3, -1.2, 4.5);
//! let [first, second] = noise.pair(p, 6.5);
//!
//! let h = 1e-3;
//! let difference = (noise.sample(p + h * Vec3::X, 1.0).value - noise.sample(p - h * Vec3::X, 1.0).value) / (2.0 * h);
//! assert!((noise.sample(p, 1.0).gradient.x - difference).abs() < 5e-3);
//! assert_ne!(first, second);
//! ```
//!
//! | item | is |
//! |---|---|
//! | [`Noise`], [`Sample`] | a kind of noise; its value and gradient at a point |
//! | [`Perlin1985`], [`Perlin2002`] | gradient noise with unit gradients and cubic weights; with edge directions and quintic weights |
//! | [`Simplex`] | gradient noise on simplices, kernel radius² 0.5 (continuous) or 0.6 (customary) |
//! | [`Gaussian`] | value-gradient noise over its standard deviation at the point: N(0, 1) everywhere |
//! | [`Spectrum`] | lacunarity, gain, number of octaves; weights, norms and shares of a real number of octaves |
//! | [`Octaves`], [`Normalisation`] | sums of any kind, normalised to range or variance |
//! | [`GaussianOctaves`] | sums that are N(0, 1) at every point, and their share of the endless spectrum's variance |
//! | [`Lattice`], [`IntegerHash`], [`PermutationTable`] | where a lattice point's bits come from; without period; with period 256 |
//! | [`gaussian_variates_3`], [`unit_direction_3`], [`edge_direction_3`], [`second_word`] | what noises make of the bits, and their like in the plane |
//! | [`Statistics`] | measured deviation, kurtosis, range and distribution of a kind |
//!
//! # Statistics
//!
//! Measured over 8.4 million points, standard errors 0.0003 σ₁ and 0.002. Classic noises are neither Gaussian nor
//! stationary: gradient noise is 0 at every lattice point.
//!
//! | kind | σ₁ 2-D | κ₁ 2-D | σ₁ 3-D | κ₁ 3-D |
//! |---|---|---|---|---|
//! | Perlin 1985 | 0.299 | −0.35 | 0.211 | −0.37 |
//! | Perlin 2002 | 0.305 | −0.47 | 0.261 | −0.46 |
//! | simplex, r² = 0.5 | 0.539 | −1.20 | 0.393 | −0.34 |
//! | simplex, r² = 0.6 | 0.468 | −1.08 | 0.435 | −0.73 |
//! | Gaussian | 1 | 0 | 1 | 0 |
//!
//! # Reproducibility
//!
//! The same bits on every platform and with every feature: evaluation uses +, −, ×, ÷, √ and integers only, no fused
//! multiply-add, no logarithm and no trigonometry. Changed bits are a value-breaking change.
//!
//! # Precision
//!
//! Value and gradient are within 4e-6 and 9e-6 of an `f64` evaluation at the same point (kinds of range 1: 9e-7 and
//! 3e-6). A coordinate x itself has a spacing of |x|·2⁻²³, and octave i of a sum sees fᵢ x: keep fᵢ |x| under 10⁵ or so.
//! What happens far out and at points that are not finite is stated at [`Noise`].
//!
//! # What it does not do
//!
//! No value, sparse-convolution or cellular noise, no turbulence of absolute values, no domain warping, no batches, no
//! dimension other than 2 and 3.
//!
//! # Features
//!
//! | feature | does |
//! |---|---|
//! | `std` (default) | √ of the standard library |
//! | `libm` | √ of `libm`, without `std`; wins when both are on; the same bits |
#![no_std]
#![expect(
    clippy::needless_range_loop,
    reason = "an axis indexes several arrays, and closures of iterators are not compiled for the lanes' SIMD level"
)]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-noise needs a float backend: enable the feature `std` or `libm`");

mod absolute_moments;
mod batch;
mod catmull_rom;
mod cell_hessian;
mod cell_noise;
mod chained_table;
mod columns;
mod curl;
mod directions;
mod fade;
mod field;
mod footprint;
mod gaussian;
mod gaussian_levels;
mod gaussian_octaves;
mod hessian;
mod integer_hash;
mod kernel;
mod lanes;
mod lattice;
mod layer;
mod lecture;
mod level;
mod math;
mod noise;
mod octaves;
mod perlin;
mod permutation_table;
mod point;
mod power;
mod ridged_multifractal;
mod sample;
mod scratch;
mod shape;
mod simplex;
mod span;
mod sparse;
mod spectrum;
mod statistics;
mod statistics_tables;
mod tiled;
mod tiled_simplex;
mod turbulence;
mod value;
mod value_gradient;
mod variance;
mod warp;
mod white;
#[cfg(feature = "simd")]
mod wide;

pub use glam;

pub use batch::{Batch, BatchError, Grid};
pub use chained_table::ChainedTable;
pub use curl::{Curl2, Curl3, CurlPotential, Velocity};
pub use directions::{edge_gradient, gaussian_corner, unit_gradient};
pub use field::{Field, Seeded};
pub use footprint::{pixel_footprint, removed_share};
pub use gaussian::Gaussian;
pub use gaussian_octaves::{FirstGaussianOctaves, GaussianOctaves};
pub use hessian::{Curved, CurvedField, Jet};
pub use integer_hash::IntegerHash;
pub use kernel::{Kernel, LaneSample, Row};
pub use lanes::{Floats, Lanes, Scalar, Words};
pub use lattice::Lattice;
pub use layer::Rotation;
pub use lecture::{Gnoise, LectureTables, Vgnoise, Vnoise};
pub use level::Level;
pub use noise::Noise;
pub use octaves::{FirstOctaves, Normalisation, Octaves};
pub use perlin::{Perlin1985, Perlin2002};
pub use permutation_table::{PermutationTable, PermutationTableError};
pub use point::Point;
pub use power::Power;
pub use ridged_multifractal::{FeedbackError, FirstRidges, RidgedMultifractal};
pub use sample::Sample;
pub use shape::{Shape, Signed};
pub use simplex::Simplex;
pub use sparse::{Sparse, SparseError};
pub use spectrum::{MAX_OCTAVES, Spectrum, SpectrumError};
pub use statistics::Statistics;
pub use tiled::{Tiled, TiledError};
pub use tiled_simplex::TiledSimplex;
pub use turbulence::{Billow, Plasma, Ridged, Turbulence};
pub use value::{Value, ValueCatmullRom};
pub use value_gradient::{ValueGradient, ValueGradientError};
pub use warp::{Displacement, Warp, WarpError};
pub use white::White;
