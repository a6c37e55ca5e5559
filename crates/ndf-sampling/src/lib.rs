//! Normal density functions: densities, exact sampling by noise, its inverse, and exact level of detail.
//!
//! A normal density `D` says how the facets of a rough surface are tilted. With the bijection `T` from Gaussian coordinates
//! to normals that every [`Ndf`] brings along, two channels of Gaussian noise become a bump map with exactly that density
//! (Kautz, Heidrich, Seidel 2001, "Real-Time Bump Map Synthesis"), and with its inverse the density that a pixel still sees
//! when it resolves a part of the bump map is known in closed form.
//!
//! ```
//! use asperity_ndf_sampling::{Ggx, Ndf, conditional_density, glam::{Vec2, Vec3}};
//!
//! let ggx = Ggx::new(0.2, 0.4)?;
//! // Two independent, standard Gaussian numbers at a point of the surface, from any noise.
//! let z = Vec2::new(0.7, -1.2);
//! let facet = ggx.from_gaussian(z);
//! assert!(ggx.to_gaussian(facet).abs_diff_eq(z, 1e-5));
//!
//! // A pixel that resolves three quarters of the noise's variance, here with the same numbers, sees this of a half vector.
//! let h = Vec3::new(0.1, -0.2, 0.97).normalize();
//! assert!(conditional_density(&ggx, h, z, 0.75) > ggx.density(h));
//! # Ok::<(), asperity_ndf_sampling::RangeError>(())
//! ```
//!
//! | item | is |
//! |---|---|
//! | [`Ndf`], [`Microfacet`] | the traits: `D(m)`, `T(z)`, `T⁻¹(m)`, sampling; Smith's Λ, G₁, G₂ and visible normals |
//! | [`Ggx`], [`Beckmann`], [`StudentT`] | isotropic and anisotropic, in closed form for every roughness |
//! | [`Ward`], [`BlinnPhong`], [`AshikhminShirley`] | densities of facets of older models, as exact |
//! | [`Isotropic`], [`IsotropicRef`] | a density of the tilt, from a table over the cosine |
//! | [`Mixture`], [`Blend`], [`Rotated`], [`Radial`] | sums of densities, with and without a map; turned densities |
//! | [`NdfMap`], [`PackedMapRef`] | a density painted or computed on the hemispherical map; as one array, for flash or a GPU |
//! | [`Masked`], [`Bounded`] | masking and visible normals of maps and tables, for reflectances |
//! | [`Measure`], [`Reconstruction`] | the meaning of texel values; interpolation between them |
//! | [`NoiseDistribution`], [`NoiseCdfRef`], [`GaussianNoise`], [`KurtoticNoise`] | G: from values of a noise to Gaussian numbers and back; measured, Gaussian, by its kurtosis |
//! | [`NormalTable`], [`NormalTableRef`], [`normal_table`] | table L: tangent frames by look-up; its layouts, accuracy and half floats |
//! | [`estimate_ndf`], [`NdfEstimator`], [`detailed`], [`detailed_normal`], [`normal_map`] | existing bump maps: their density, their texels, noise added to them |
//! | [`ConditionalNdf`], [`conditional_density`], [`GaussianSplit`], [`level_of_detail`] | exact level of detail |
//! | [`ConditionalTable`], [`ConditionalTableRef`] | exact level of detail by one look-up, for any density |
//! | [`check`] (feature `check`) | property tests for any [`Ndf`] or [`Microfacet`], with a report that prints |
//! | [`Frame`], [`phi`], [`inverse_phi`] | tangent frames; the Gaussian distribution function and its inverse |
//!
//! Plural calls fill arrays, in SIMD lanes: those of [`ClosedForm`] for [`Ggx`] and [`Beckmann`],
//! [`NormalTableRef::bilinear_normals`], [`PackedMapRef::inverses`].
//!
//! # Conventions
//!
//! - Normals are unit vectors in a frame whose z axis is the macro normal. Densities are in sr⁻¹ with `∫ D cos θ dω = 1`: over
//!   the map of projected normals (n_x, n_y) the density is `D` itself.
//! - The slope of a normal is `(n_x, n_y)/n_z`, minus the gradient of the height.
//! - Constructors refuse what is no parameter; evaluation is total and never panics, see each item for NaN and infinities.
//! - `f32` outside; `f64` where distribution functions are summed, subtracted and inverted.
//! - Reproducibility: the same bits on every machine under the feature `libm`. Between `libm` and `std` results differ by
//!   rounding, but for `D`, `T` and `T⁻¹` of [`Ggx`] and [`Beckmann`], whose bits depend on nothing.
//!
//! # What it does not do
//!
//! No noise, no images, no reflection. Numbers come in as arguments.
//!
//! # Features
//!
//! | feature | does |
//! |---|---|
//! | `std` (default) | float functions of the standard library |
//! | `libm` | those of the crate `libm`, also without `std`; wins when both are on |
//! | `simd` (default) | plural calls in SIMD lanes by `fearless_simd`; without `std` those that the program is compiled for |
//! | `approx` | comparisons of frames, densities and other small records by `approx`, and those of `glam` |
//! | `check` | property tests for any density, your own included: module [`check`] |
//! | `serde` | the parameters of [`Ggx`], [`Beckmann`], [`StudentT`], [`Ward`], [`BlinnPhong`] and [`AshikhminShirley`] in files, read through `new`; formats and layouts |
//! | `rand` | densities as [`Distribution`](https://docs.rs/rand/latest/rand/distr/trait.Distribution.html)s of normals: `rng.sample(&ggx)` |
//! | `alloc` (default) | [`NdfMap`], [`Masked`], [`NdfEstimator`] and [`NormalTable`], which own their tables; [`NormalTableRef`] does without |

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
mod frame;
pub mod level_of_detail;
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
mod range_error;
mod serde;

pub use glam;

pub use asperity_core::BatchError;
pub use closed_form::ClosedForm;
pub use density::ashikhmin_shirley::AshikhminShirley;
pub use density::beckmann::Beckmann;
pub use density::blend::Blend;
pub use density::blinn_phong::BlinnPhong;
pub use density::ggx::Ggx;
#[cfg(feature = "alloc")]
pub use density::isotropic::Isotropic;
pub use density::isotropic::{IsotropicError, IsotropicIn, IsotropicRef};
pub use density::mixture::{Mixture, MixtureError};
pub use density::rotated::Rotated;
pub use density::roughness::{MAX_ALPHA, MIN_ALPHA};
pub use density::student_t::StudentT;
pub use density::ward::Ward;
pub use frame::Frame;
#[cfg(feature = "alloc")]
pub use level_of_detail::ConditionalTable;
pub use level_of_detail::{
    ConditionalNdf, ConditionalTableIn, ConditionalTableRef, GaussianSplit, OffsetBeckmann,
    OffsetBeckmannError, conditional_density,
};
pub use map::packed::error::PackedMapError;
pub use map::packed::packed_map::PackedMapRef;
pub use map::reconstruction::Reconstruction;
#[cfg(feature = "alloc")]
pub use map::{
    error::{MAX_TEXELS, NdfMapError},
    packed::ndf_map::NdfMap,
    texels::Measure,
};
#[cfg(feature = "alloc")]
pub use masked::{bounded::Bounded, masked::Masked, wedge::Wedge};
pub use microfacet::Microfacet;
pub use ndf::Ndf;
pub use noise_distribution::distribution::{GaussianNoise, NoiseDistribution};
pub use noise_distribution::kurtotic_noise::KurtoticNoise;
pub use noise_distribution::noise_cdf::{NoiseCdfError, NoiseCdfRef};
#[cfg(feature = "alloc")]
pub use normal_map::{NdfEstimator, estimate_ndf};
pub use normal_map::{detailed, detailed_normal};
#[cfg(feature = "alloc")]
pub use normal_table::NormalTable;
pub use normal_table::{NormalTableError, NormalTableIn, NormalTableRef};
pub use numeric::normal_distribution::{inverse_phi, phi};
pub use radial::Radial;
pub use range_error::RangeError;
