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
//! # Ok::<(), asperity_ndf_sampling::RoughnessError>(())
//! ```
//!
//! | item | is |
//! |---|---|
//! | [`Ndf`] | the trait: `D(m)`, `T(z)`, `T⁻¹(m)`, sampling by uniform numbers |
//! | [`Microfacet`] | the trait of Smith's Λ, G₁, G₂ and of visible normals |
//! | [`Ggx`], [`Beckmann`], [`StudentT`] | isotropic and anisotropic, in closed form for every roughness |
//! | [`Ward`], [`BlinnPhong`], [`AshikhminShirley`] | the densities of facets of older models, as exact |
//! | [`Isotropic`] | a density of the tilt, from a table over the cosine, owned or borrowed |
//! | [`Mixture`], [`Blend`], [`Rotated`], [`Radial`] | sums of densities, with and without a map; turned densities |
//! | [`NdfMap`], [`Measure`], [`Reconstruction`] | a density painted or computed on the hemispherical map, sampled exactly |
//! | [`PackedMap`] | the same in one borrowed array of `f32`, in batches too |
//! | [`Cdf`] | its marginal and conditional distribution functions and their inverses |
//! | [`phi`], [`inverse_phi`] | the Gaussian distribution function and its inverse |
//! | [`NoiseDistribution`] | G: from the values of a noise to uniform and Gaussian numbers and back |
//! | [`NoiseCdf`], [`GaussianNoise`], [`KurtoticNoise`] | measured, exactly Gaussian, and known by its kurtosis |
//! | [`NormalTable`], [`NormalTableRef`] | table L: tangent frames by look-up, owned and borrowed |
//! | [`TableLayout`], [`Spacing`], [`Chart`], [`TableEntry`] | how it is indexed and what its entries are |
//! | [`TableAccuracy`], [`Deviation`] | what its look-ups lose |
//! | [`to_half`], [`from_half`], [`unpack_frame`] | half floats for textures |
//! | [`estimate_ndf`], [`NdfEstimator`] | the density of an existing bump map |
//! | [`NormalMapFormat`], [`TangentSpace`], [`Zero`], [`Blue`] | how its texels are read |
//! | [`detailed`], [`detailed_normal`], [`NoiseChain`] | noise added to an existing bump map |
//! | [`Batch`], [`InLanes`] | closed forms for arrays of numbers, in SIMD lanes |
//! | [`Frame`] | tangent frames by the minimal rotation from (0, 0, 1) |
//! | [`ConditionalNdf`], [`conditional_density`], [`GaussianSplit`] | exact level of detail |
//! | [`ConditionalTable`], [`ConditionalTableRef`], [`ConditionalAccuracy`] | the same by one look-up, for any density |
//! | [`OffsetBeckmann`] | Gaussian slopes of any mean and covariance, as those that a Beckmann surface leaves |
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
//! | `simd` (default) | [`Batch`] in SIMD lanes by `fearless_simd`; without `std` those that the program is compiled for |
//! | `alloc` (default) | [`NdfMap`], [`Cdf`], [`NdfEstimator`] and [`NormalTable`], which own their tables; [`NormalTableRef`] does without |

#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-ndf-sampling needs a float backend: enable the feature `std` or `libm`");

mod batch_error;
mod density;
mod frame;
mod level_of_detail;
mod map;
mod math;
mod microfacet;
mod ndf;
mod noise_distribution;
mod normal_map;
mod normal_table;
mod numeric;
mod radial;
mod simd;

pub use batch_error::BatchError;
pub use density::ashikhmin_shirley::AshikhminShirley;
pub use density::batch::Batch;
pub use density::beckmann::Beckmann;
pub use density::blend::{Blend, MixtureError};
pub use density::blinn_phong::{BlinnPhong, ExponentError, MAX_EXPONENT};
pub use density::closed_form::InLanes;
pub use density::ggx::Ggx;
pub use density::isotropic::{Isotropic, IsotropicError, MAX_NODES};
pub use density::mixture::Mixture;
pub use density::rotated::{AngleError, Rotated};
pub use density::roughness::{MAX_ALPHA, MIN_ALPHA, RoughnessError};
pub use density::student_t::{MAX_GAMMA, MIN_GAMMA, StudentT, StudentTError};
pub use density::ward::Ward;
pub use frame::Frame;
pub use glam;
pub use level_of_detail::conditional::{GaussianSplit, MAX_SHARE, conditional_density};
pub use level_of_detail::conditional_ndf::ConditionalNdf;
pub use level_of_detail::offset_beckmann::{OffsetBeckmann, OffsetBeckmannError};
#[cfg(feature = "alloc")]
pub use level_of_detail::table::{ConditionalAccuracy, ConditionalTable};
pub use level_of_detail::table_ref::ConditionalTableRef;
#[cfg(feature = "alloc")]
pub use map::cdf::Cdf;
pub use map::packed::{error::PackedMapError, packed_map::PackedMap};
pub use map::reconstruction::Reconstruction;
#[cfg(feature = "alloc")]
pub use map::{
    error::{MAX_TEXELS, NdfMapError},
    ndf_map::NdfMap,
    texels::Measure,
};
pub use microfacet::Microfacet;
pub use ndf::Ndf;
pub use noise_distribution::distribution::{DeviationError, GaussianNoise, NoiseDistribution};
pub use noise_distribution::kurtotic_noise::KurtoticNoise;
pub use noise_distribution::noise_cdf::{NoiseCdf, NoiseCdfError};
pub use normal_map::detail::{NoiseChain, detailed, detailed_normal};
#[cfg(feature = "alloc")]
pub use normal_map::estimate::{EstimateError, NdfEstimator, estimate_ndf};
pub use normal_map::format::{Blue, NormalMapFormat, TangentSpace, Zero};
#[cfg(feature = "alloc")]
pub use normal_table::accuracy::{Deviation, TableAccuracy};
pub use normal_table::chart::Chart;
pub use normal_table::layout::{TableEntry, TableLayout, unpack_frame};
pub use normal_table::spacing::Spacing;
#[cfg(feature = "alloc")]
pub use normal_table::table::NormalTable;
pub use normal_table::table_ref::{NormalTableError, NormalTableRef};
pub use numeric::binary16::{MAX_HALF, from_half, to_half};
pub use numeric::normal_distribution::{inverse_phi, phi};
pub use radial::Radial;
