//! Procedural noise with analytic gradients, in one to four dimensions.
//!
//! Every noise, fBm and transform is a [`Field`]. [`value`](Field::value) returns the value at a
//! point, and [`sample`](Field::sample) returns the value and the gradient. Points, values and
//! gradients are `f32`. Batch methods evaluate lists and grids of points with SIMD and return the
//! same bits. Most kinds of noise have values in [−1, 1]. [`Fbm`] has mean 0 and variance 1 by
//! default; [`Normalization::UnitRange`] keeps the range of one octave. Fields own their parts.
//! They can be added, blended, warped, returned from functions and boxed as `Box<dyn Field<Vec3>>`.
//!
//! Use [`GaussianFbm`] when the statistics matter. Its values have the distribution N(0, 1) at
//! every point, for every real number of octaves.
//!
//! Evaluation does not allocate and has no mutable state. Results are bit-identical on every
//! machine.
//!
//! ```
//! use asperity_noise::{Field, GaussianFbm, GaussianNoise, Grid, Fbm, Perlin, FbmSpectrum, Warp, glam::{Vec2, Vec3}};
//!
//! // A point: value and gradient.
//! let sample = Perlin::new(42).sample(Vec3::new(0.3, -1.2, 4.5));
//! assert!(sample.value.abs() <= 1.0);
//!
//! // A picture of fractional Brownian motion, warped by itself.
//! let fbm = |seed| Fbm::new(Perlin::new(seed), FbmSpectrum::default());
//! let warped = Warp::new(fbm(1), [fbm(2), fbm(3)], 0.3)?;
//! let grid = Grid { origin: Vec2::ZERO, step: Vec2::splat(0.05), size: [64, 48] };
//! let mut heights = [0.0; 64 * 48];
//! warped.grid_values(&grid, &mut heights)?;
//!
//! // Two independent Gaussian channels of 6½ octaves.
//! let noise = GaussianFbm::new(GaussianNoise::new(42), FbmSpectrum::default()).with_octaves(6.5);
//! let [first, second] = noise.pair(Vec3::new(0.3, -1.2, 4.5));
//! assert_ne!(first, second);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Kinds
//!
//! | kind | is | dimensions | Hessian | tiles |
//! |---|---|---|---|---|
//! | [`WhiteNoise`] | one value per cell | 1–4 | – | yes |
//! | [`ValueNoise`], [`ValueCatmullRom`] | lattice values, blended by quintic weights or by a spline over 4ⁿ points | 1–4 | `ValueNoise` | yes |
//! | [`PerlinClassic`], [`Perlin`] | unit gradients and cubic weights; edge directions and quintic weights | 1–4 | yes | yes |
//! | [`ValueGradient`] | a weighted sum of value noise and gradient noise on one lattice | 1–4 | yes | yes |
//! | [`Simplex`] | gradient noise on simplices, r² = 0.5 (continuous) or 0.6 (classic) | 1–4 | yes | in 1-D and 3-D; in 2-D and 4-D the lattice is irrational along the axes |
//! | [`SparseConvolution`] | impulses at random positions, convolved with a radial kernel | 1–4 | – | yes |
//! | [`Cellular`] | distances to the nearest of random feature points, or a random value of the nearest, in three metrics | 1–4 | – | yes |
//! | [`GaussianNoise`] | value-gradient noise over its standard deviation at the point: N(0, 1) everywhere | 1–4 | yes | yes |
//! | [`ebert_1994`] | the algorithms of Ebert (ed.) 1994, with the random tables of the book | 3 | – | period 256 |
//!
//! | other items | are |
//! |---|---|
//! | [`Field`], [`Noise`], [`HasHessian`] | functions with gradients; kinds with measured statistics; functions with Hessians |
//! | [`Sample`], [`SampleHessian`] | value and gradient; value, gradient and Hessian |
//! | [`Grid`] | regular points, for images and volumes |
//! | [`FbmSpectrum`], [`Fbm`], [`Rotation`], [`Normalization`] | lacunarity, gain and a real number of octaves; sums of any field, also of your own |
//! | [`Turbulence`], [`Plasma`], [`Billow`], [`Ridged`], [`RidgedMultifractal`] | fBm with creases |
//! | [`Perlin::tiled`], [`Fbm::tiled`] | tileable noises, and sums in which each octave has its own periods |
//! | [`Fbm::anchored`] | fBm at offsets from an `f64` anchor, accurate to 1/1000 cell at 10¹² cells |
//! | [`Fbm::band_limited`], [`filtered_fraction`], [`pixel_footprint`] | frequency clamping to a pixel |
//! | [`GaussianFbm`], [`Fbm::whitened_gradient`] | sums that are N(0, 1) at every point; their slopes, two independent N(0, 1) |
//! | [`ops`] | fields composed of fields: sums, products, blends, powers, curves, frequencies, values in [0, 1] |
//! | [`Warp`], [`curl`] | domain warping with its Jacobian; divergence-free velocities |
//! | [`CellularOutput`], [`Metric`] | output and metric of cellular noise |
//! | [`Lattice`], [`IntegerHash`], [`lattice`] | hash functions of lattice points, and the random values derived from the hashes |
//! | [`Statistics`] | measured standard deviation, kurtosis, range and distribution of a kind |
//! | [`simd`] | SIMD levels, for tests and benchmarks |
//!
//! # Statistics
//!
//! σ₁ is the standard deviation and κ₁ the excess kurtosis of one octave. They are measured over
//! 8.4 million points, with standard errors of 0.0003 σ₁ and 0.002. Sparse noise is normalized to
//! σ₁ = 1. It is measured over a million points, with standard errors of 0.003 and 0.02. Only
//! [`GaussianNoise`] is Gaussian. Only it, [`WhiteNoise`] and
//! [`SparseConvolution`] have equal variance at every point. For example, gradient noise is 0 at
//! every lattice point.
//!
//! | kind | σ₁ 2-D | κ₁ 2-D | σ₁ 3-D | κ₁ 3-D |
//! |---|---|---|---|---|
//! | white | 0.577 | −1.20 | 0.577 | −1.20 |
//! | value, quintic | 0.452 | −0.84 | 0.401 | −0.65 |
//! | value, Catmull–Rom | 0.301 | −0.78 | 0.217 | −0.60 |
//! | Perlin 1985 | 0.299 | −0.35 | 0.211 | −0.37 |
//! | Perlin 2002 | 0.326 | −0.47 | 0.261 | −0.46 |
//! | value-gradient, equal weights | 0.273 | −0.61 | 0.229 | −0.49 |
//! | simplex, r² = 0.5 | 0.544 | −1.20 | 0.392 | −0.33 |
//! | simplex, r² = 0.6 | 0.472 | −1.08 | 0.435 | −0.73 |
//! | sparse, one impulse | 0.999 | 0.63 | 1.002 | 1.42 |
//! | Gaussian | 1 | 0 | 1 | 0 |
//!
//! # Reproducibility
//!
//! Results are bit-identical on every platform, at every SIMD level and with every feature.
//! Evaluation uses +, −, ×, ÷, √ and integers only. It uses no fused multiply-add and no logarithm
//! or trigonometric function of a library. Bits change only in a new minor version, or by a bug fix
//! that the changelog marks as value-breaking.
//!
//! # Accuracy
//!
//! The table lists the largest errors seen, compared with an `f64` evaluation at the same points.
//! They are measured at 10⁵ random points within ±64, in 1-D to 4-D. Slow kinds are measured at
//! fewer points in 3-D and 4-D. Simplex noise is measured within ±4, where the rounding of its
//! corners is smallest. Errors at other points can be twice as large.
//!
//! | kind | value | gradient |
//! |---|---|---|
//! | Perlin 1985 | 2.7e-7 | 6.6e-7 |
//! | Perlin 2002 | 1.7e-6 | 5.6e-6 |
//! | value, quintic | 1.9e-6 | 4.3e-6 |
//! | value, Catmull–Rom | 3.9e-7 | 8.7e-7 |
//! | value-gradient, equal weights | 1.4e-6 | 2.6e-6 |
//! | simplex, r² = 0.5 | 2.0e-6 | 1.4e-5 |
//! | simplex, r² = 0.6 | 1.8e-6 | 9.9e-6 |
//! | sparse, one impulse | 9.2e-7 | 2.0e-6 |
//! | Gaussian | 4.5e-6 | 1.2e-5 |
//!
//! Kinds with quintic weights are least accurate next to the upper border of a cell, where the
//! weight has a rounding error of up to 1.2e-6. Coordinates near x have a spacing of |x|·2⁻²³ in
//! `f32`. An octave of frequency f is evaluated at f x. Keep f |x| below about 10⁵, or place an
//! `f64` anchor near the points with [`Fbm::anchored`]. [`Field`] documents values far from the
//! origin and at non-finite points.
//!
//! # Limitations
//!
//! The crate has no 5-D noise and no `f64` values.
//!
//! # Features
//!
//! | feature | effect |
//! |---|---|
//! | `std` (default) | √ of the standard library, SIMD detection at run time; enables `alloc` |
//! | `alloc` | [`Field`] for `Box`, `Rc` and, on targets with atomic pointers, `Arc` |
//! | `simd` (default) | SIMD through `fearless_simd`; without `std` only the levels that the program is compiled for |
//! | `libm` | √ of `libm`, without `std`; takes precedence if both are enabled; the same bits |
//! | `approx` | the traits of `approx` for [`Sample`] and [`SampleHessian`] |
//! | `check` | property tests for any field, including custom fields: module [`check`] |
//! | `bytemuck` | `Pod` for the structs of [`gpu`] |
//! | `mint` | conversion between the vectors of [`glam`] and `mint`, for engines with other vectors |
//! | `serde` | serialization of [`FbmSpectrum`], [`Grid`], [`Normalization`] and [`Rotation`]; a spectrum is deserialized through [`FbmSpectrum::new`] |
//!
//! # Compile time
//!
//! All kinds in one to three dimensions are compiled once, in this crate, for SSE2, AVX2 and
//! AVX-512. The first optimized build takes 50 seconds of CPU time with all dependencies. A program
//! that boxes seven kinds then compiles in 2 seconds.
//!
//! Noise in 4-D, and on lattices other than [`IntegerHash`], is compiled with the program that uses
//! it. Each kind adds 4 seconds, and its fBm another 4. With debug assertions, every kind is
//! compiled with the program, at the optimization level of the program. Without `simd`
//! (`default-features = false, features = ["std"]`), batches evaluate one point at a time.
#![no_std]
#![expect(
    clippy::needless_range_loop,
    reason = "an axis indexes several arrays, and closures of iterators are not compiled for the lanes' SIMD level"
)]

#[cfg(any(feature = "alloc", test))]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "check")]
pub mod check;
mod contract;
pub mod ebert_1994;
mod error;
pub mod gpu;
mod kinds;
mod lanes;
pub mod lattice;
mod point;
mod row;
mod sample;
mod statistics;
mod sums;
mod transforms;

pub use asperity_core::BatchError;
pub use glam;

pub use contract::field::{Field, HasHessian};
pub use contract::kernel::Anchor;
pub use contract::noise::Noise;
pub use error::NoiseError;
pub use kinds::cellular::cellular::{Cellular, CellularOutput};
pub use kinds::cellular::metric::Metric;
pub use kinds::gaussian::GaussianNoise;
pub use kinds::perlin::{Perlin, PerlinClassic};
pub use kinds::simplex::simplex::Simplex;
pub use kinds::simplex::tiled::TiledSimplex;
pub use kinds::sparse_convolution::SparseConvolution;
pub use kinds::value::{ValueCatmullRom, ValueNoise};
pub use kinds::value_gradient::ValueGradient;
pub use kinds::white::WhiteNoise;
pub use lattice::integer_hash::IntegerHash;
pub use lattice::lattice::Lattice;
pub use point::Point;
pub use row::grid::Grid;
pub use sample::{Sample, SampleHessian};
pub use statistics::statistics::{Moments, Statistics};
pub use sums::fbm::{Fbm, GaussianFbm, Normalization};
pub use sums::frequency_clamp::{filtered_fraction, pixel_footprint};
pub use sums::octave::Rotation;
pub use sums::ridged_multifractal::RidgedMultifractal;
pub use sums::shape::{Shape, Signed};
pub use sums::spectrum::FbmSpectrum;
pub use sums::turbulence::{Billow, Plasma, Ridged, Turbulence};
pub use transforms::warp::{Displacement, Warp};

/// Fields composed of fields, by value.
pub mod ops {
    pub use crate::transforms::arithmetic::{Add, Blend, Clamp, Map, Multiply, ScaleBias};
    pub use crate::transforms::frequency::Frequency;
    pub use crate::transforms::power::Power;
    pub use crate::transforms::unit::Unit;
}

/// Curl noise: velocities without divergence, from the gradients of fields.
pub mod curl {
    pub use crate::transforms::curl::{Curl2, Curl3, CurlPotential, Velocity};
}

/// SIMD levels for tests and benchmarks, and the arguments of [`Field::fill`].
///
/// Fields use the best level by themselves.
pub mod simd {
    pub use crate::contract::batch::Batch;
    pub use crate::lanes::level::Level;
    pub use crate::row::points::{Points, Target};
}
