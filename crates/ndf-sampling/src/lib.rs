//! Microfacet normal distribution functions (NDFs): evaluation, sampling and exact level of detail.
//!
//! A normal distribution function `D` describes the directions of the facets of a rough surface.
//! Every [`Ndf`] also has a bijection `T` from pairs of standard normal values ("Gaussian numbers")
//! to normals. `T` maps Gaussian noise, such as its whitened slopes, to a bump map with exactly
//! this distribution (Kautz, Heidrich, Seidel 2001, "Real-Time Bump Map Synthesis"). A pixel
//! resolves only a part of the bump map. With `T⁻¹`, [`residual_ndf`] computes the distribution of the unresolved part in
//! closed form.
//!
//! ```
//! use asperity_ndf_sampling::{Ggx, Ndf, residual_ndf, glam::{Vec2, Vec3}};
//!
//! let ggx = Ggx::new(0.2, 0.4)?;
//! // Two independent standard Gaussian numbers at a point of the surface, from any noise.
//! let z = Vec2::new(0.7, -1.2);
//! let facet = ggx.warp_gaussian(z);
//! assert!(ggx.invert(facet).abs_diff_eq(z, 1e-5));
//!
//! // The NDF of a pixel that resolves 3/4 of the variance of the noise. `resolved` is the noise of
//! // the resolved octaves, scaled to variance 1.
//! let (h, resolved) = (Vec3::new(0.1, -0.2, 0.97).normalize(), Vec2::new(0.7, -1.2));
//! assert!(residual_ndf(&ggx, h, resolved, 0.75) > ggx.d(h));
//! # Ok::<(), asperity_ndf_sampling::NdfError>(())
//! ```
//!
//! | item | purpose |
//! |---|---|
//! | [`Ndf`], [`Microfacet`] | traits: `D(m)`, `T(z)`, `T⁻¹(m)`, sampling; Smith's Λ, G₁, G₂ and visible normals |
//! | [`Ggx`], [`Beckmann`], [`StudentT`] | isotropic and anisotropic NDFs in closed form for every roughness |
//! | [`Ward`], [`BlinnPhong`], [`AshikhminShirley`] | NDFs of older reflection models, also in closed form |
//! | [`Isotropic`] | isotropic NDF from a table over cos θ |
//! | [`Mixture`], [`Blend`], [`Rotated`], [`Radial`] | weighted sums of NDFs, `Mixture` with a bijection, `Blend` without (not an [`Ndf`]); rotated NDFs; NDFs that depend on θ only |
//! | [`NdfMap`], [`PackedMapRef`] | NDF from an image or a function on the (n_x, n_y) disk; the same as one array for flash memory or a GPU |
//! | [`Masked`], [`Bounded`] | masking and visible normals of maps and tables, for BRDFs |
//! | [`Measure`], [`Reconstruction`] | interpretation of texel values; interpolation between them |
//! | [`NoiseDistribution`], [`NoiseCdfRef`], [`GaussianDistribution`], [`KurtoticDistribution`] | conversion of noise values to Gaussian numbers and back by the CDF of the noise: measured, Gaussian, or from the kurtosis |
//! | [`NormalLut`], [`normal_table`] | lookup table of `T` (table L of the paper): a normal or its tangent frame by one lookup, also in half floats |
//! | [`estimate_ndf`], [`NdfEstimator`], [`add_detail`], [`add_detail_normal`], [`normal_map`] | NDF estimation, texel decoding and added noise for existing normal maps |
//! | [`ConditionalNdf`], [`residual_ndf`], [`GaussianSplit`], [`OffsetBeckmann`] | exact level of detail |
//! | [`VisibleWarp`], [`VisibleFacets`] | visible normals as a map of Gaussian numbers; the same level of detail for visible normals |
//! | [`ConditionalTable`] | exact level of detail by one lookup, for any NDF |
//! | [`check`] (feature `check`) | property tests for any [`Ndf`] or [`Microfacet`], with a printable report |
//! | [`Frame`], [`gaussian_cdf`], [`inverse_gaussian_cdf`] | tangent frames; the Gaussian CDF and its inverse |
//!
//! Batch methods fill arrays with SIMD: the methods of [`ClosedForm`] for [`Ggx`] and [`Beckmann`],
//! [`NormalLut::bilinear_normals`] and [`PackedMapRef::inverse_batch`].
//!
//! # Conventions
//!
//! - Normals are unit vectors in a frame whose z axis is the macro normal. `D` is in sr⁻¹ with
//!   `∫ D cos θ dω = 1`. Therefore `D` is also the pdf of the projected normal (n_x, n_y).
//! - The slope of a normal is `(n_x, n_y)/n_z`, the negative gradient of the height.
//! - Roughness parameters are α, not the perceptual roughness √α.
//! - Constructors return an error for invalid parameters. Evaluation accepts every input and never
//!   panics. Each item documents its result for NaN and infinities.
//! - The API uses `f32`, except [`gaussian_cdf`] and [`inverse_gaussian_cdf`], which use `f64`.
//!   CDFs are summed, subtracted and inverted in `f64`.
//! - Reproducibility: with the feature `libm`, results are bit-identical on every machine. `D`, `T`
//!   and `T⁻¹` of [`Ggx`] and [`Beckmann`] have the same bits with `libm` and `std`; other results
//!   differ by rounding.
//!
//! # Limitations
//!
//! The crate contains no noise, image files or BRDFs. Noise values and texels are arguments. The
//! crates `asperity-noise` and `asperity-shading` provide noise and BRDFs.
//!
//! # Features
//!
//! | feature | effect |
//! |---|---|
//! | `std` (default) | float functions of the standard library |
//! | `libm` | float functions of the crate `libm`, also without `std`; takes precedence when both are enabled |
//! | `simd` (default) | SIMD in batch methods by `fearless_simd`; without `std`, at the level that the program is compiled for |
//! | `approx` | comparisons of frames, NDFs and other small structs by `approx`, and the `approx` feature of `glam` |
//! | `check` | property tests for any NDF, including your own: module [`check`] |
//! | `bytemuck` | `Pod` for the structs of [`gpu`] |
//! | `mint` | conversion between the vectors of [`glam`] and `mint`, for engines with other vectors |
//! | `serde` | serialization of the parameters of [`Ggx`], [`Beckmann`], [`StudentT`], [`Ward`], [`BlinnPhong`] and [`AshikhminShirley`], validated by `new`, and of formats and layouts |
//! | `rand` | NDFs as [`Distribution`](https://docs.rs/rand/latest/rand/distr/trait.Distribution.html)s of normals: `rng.sample(&ggx)` |
//! | `alloc` (default) | [`NdfMap`], [`Masked`], [`NdfEstimator`] and owned tables; [`NormalLut`], [`Isotropic`] and [`ConditionalTable`] borrow their entries without it |

#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "check")]
pub mod check;
mod closed_form;
mod coordinates;
mod density;
mod error;
mod frame;
pub mod gpu;
mod level_of_detail;
mod map;
#[cfg(feature = "alloc")]
mod masked;
mod microfacet;
mod ndf;
mod noise_distribution;
pub mod normal_map;
pub mod normal_table;
mod numeric;
mod radial;
#[cfg(feature = "rand")]
mod rand;
mod serde;
mod storage;

pub use glam;

pub use asperity_core::BatchError;
pub use closed_form::ClosedForm;
pub use coordinates::GaussianSplit;
pub use density::ashikhmin_shirley::AshikhminShirley;
pub use density::beckmann::Beckmann;
pub use density::blend::Blend;
pub use density::blinn_phong::BlinnPhong;
pub use density::ggx::Ggx;
pub use density::isotropic::Isotropic;
pub use density::mixture::Mixture;
pub use density::rotated::Rotated;
pub use density::student_t::StudentT;
pub use density::ward::Ward;
pub use error::NdfError;
pub use frame::Frame;
#[cfg(feature = "alloc")]
pub use level_of_detail::build::ConditionalAccuracy;
pub use level_of_detail::conditional::residual_ndf;
pub use level_of_detail::conditional_ndf::ConditionalNdf;
pub use level_of_detail::offset_beckmann::OffsetBeckmann;
pub use level_of_detail::table::ConditionalTable;
pub use level_of_detail::visible_facets::VisibleFacets;
pub use map::packed::packed_map::PackedMapRef;
pub use map::reconstruction::Reconstruction;
#[cfg(feature = "alloc")]
pub use map::{packed::ndf_map::NdfMap, texels::Measure};
#[cfg(feature = "alloc")]
pub use masked::{bounded::Bounded, masked::Masked, wedge::Wedge};
pub use microfacet::{Microfacet, VisibleWarp};
pub use ndf::Ndf;
pub use noise_distribution::distribution::{GaussianDistribution, NoiseDistribution};
pub use noise_distribution::kurtotic_noise::KurtoticDistribution;
pub use noise_distribution::noise_cdf::NoiseCdfRef;
pub use normal_map::detail::{add_detail, add_detail_normal};
#[cfg(feature = "alloc")]
pub use normal_map::estimate::{NdfEstimator, estimate_ndf};
pub use normal_table::table::NormalLut;
pub use numeric::normal_distribution::{gaussian_cdf, inverse_gaussian_cdf};
pub use radial::Radial;
