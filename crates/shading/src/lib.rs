//! Materials, BRDFs and bump mapping with a level of detail that keeps the mean radiance.
//!
//! A pixel resolves only the octaves of a bump map that are coarser than its [`Footprint`]. This
//! crate evaluates the resolved octaves as noise, and represents the remaining octaves by an NDF.
//! The two rules of [`LevelOfDetail`] return the value D of this NDF at the half vector, in sr⁻¹.
//! With `Exact`, the mean of D over the surface is the same at every zoom: [`far_field`], the NDF
//! when no bump is resolved. `Fractal` is the rule of Kautz, Heidrich, Seidel 2001, "Real-Time Bump
//! Map Synthesis". The crate also contains diffuse and glossy BRDFs with importance sampling,
//! complete materials, and environment lighting.
//!
//! ```
//! use asperity_shading::glam::Vec3;
//! use asperity_shading::noise::{GaussianNoise, GaussianFbm, FbmSpectrum};
//! use asperity_shading::{BumpField, Footprint, Frame, Ggx, LevelOfDetail, far_field, half_vector};
//!
//! let ndf = Ggx::new(0.2, 0.4)?;
//! let bumps = BumpField::new(GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default()), 20.0)?;
//!
//! // A point of the surface, its normal and ∂P/∂u, the directions to the light and to the eye.
//! let (p, frame) = (Vec3::new(0.3, 0.1, 0.8), Frame::from_normal_tangent(Vec3::Z, Vec3::X));
//! let (wi, wo) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.4, 0.2, 0.9).normalize());
//!
//! let h = frame.to_local(half_vector(wi, wo));
//! let shade = |distance: f32| {
//!     let pixel = Footprint::from_distance(distance, 1e-3, wo.dot(frame.normal));
//!     LevelOfDetail::Exact.radiance(&ndf, h, bumps.coordinates(p, &frame, pixel))
//! };
//! assert_eq!(shade(100.0), far_field(&ndf, h));
//! assert_ne!(shade(1.0), far_field(&ndf, h));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! [`Material::bsdf`] returns the BSDF at a point, including unresolved bumps as roughness.
//!
//! ```
//! use asperity_shading::glam::{Vec2, Vec3};
//! use asperity_shading::{Carpet, CarpetParameters, Footprint, Material, SurfacePoint};
//!
//! let carpet = Carpet::new(CarpetParameters::default())?;
//! let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.0), Vec3::Z, Footprint::from_width(1e-4))
//!     .with_uv(Vec2::new(0.3, 0.2), [Vec3::X, Vec3::Y]);
//! let (wi, wo) = (Vec3::new(0.6, 0.0, 0.8), Vec3::Z);
//! let light = carpet.bsdf(&point, wo).eval_cos(wo, wi);
//! assert!(light.min_element() > 0.0);
//! # Ok::<(), asperity_shading::ShadingError>(())
//! ```
//!
//! | module | contents | re-exported at the root |
//! |---|---|---|
//! | [`pixel`] | round and elliptic pixel footprints; the number of resolved octaves | [`Footprint`], [`PixelEllipse`] |
//! | [`mod@bump`] | surface gradients, bumped normals, displacement, facets from slopes | |
//! | [`level_of_detail`] | bump maps from Gaussian noise: the resolved part, and two rules to shade the rest | [`BumpField`], [`LevelOfDetail`], [`far_field`] |
//! | [`reflectance`] | BRDFs with sampling, Fresnel terms, [`Bsdf`]: layers of lobes around the normals of unresolved bumps, under an optional coat | [`Brdf`], [`Bsdf`], [`Lambert`], [`EnergyPreservingOrenNayar`], [`CookTorrance`], [`TorranceSparrow`], [`Phong`], [`Fresnel`], [`Dielectric`], [`Conductor`], [`Schlick`], [`StandardMaterial`], [`OpenPbr`] |
//! | [`environment`] | environment maps (HDRI) with importance sampling; irradiance, prefiltered maps, split sum | [`Environment`], [`EnvironmentMap`], [`Irradiance`], [`reflected_radiance`] |
//! | [`normal_map`] | normal maps at every zoom, filtered by the moments of their slopes (LEAN mapping with several lobes) | [`SlopePyramid`] |
//! | [`texture`] | bricks, bevels, stars, marble, perturbed images, gas | [`Brick`], [`Marble`] |
//! | [`material`] | [`Material`] and all materials: carpet, metallic paint, glass, wear, bump maps, walls | [`Material`], [`SurfacePoint`], [`Carpet`], [`MetallicPaint`], [`TemperedGlass`], [`Variations`], [`Scratches`], [`BumpMapped`] |
//! | [`check`] (feature `check`) | property tests for any [`Brdf`] or [`Material`], with a printable report | |
//!
//! [`half_vector`] and [`reflect`] compute directions of reflection, and [`Frame`] is a tangent
//! frame. The underlying crates are re-exported as [`ndf_sampling`] and [`noise`].
//!
//! # Conventions
//!
//! - Directions are unit vectors that point away from the surface. `wi` points to the light and
//!   `wo` to the eye. Directions of a [`Bsdf`] and of a [`Material`] are in world space. Directions
//!   of a [`Brdf`], and `h` of an NDF, are in the frame of the surface, whose z axis is the normal.
//! - Colors are linear RGB. Pdfs, and radiances per unit of light, are in sr⁻¹. Frequencies are in
//!   lattice cells per unit of length, and angles in radians.
//! - Evaluation accepts every input. The radiance is 0 if the half vector is undefined or below the
//!   horizon. Invalid footprints resolve no octave. A NaN cosine is treated as 0 (grazing).
//!   Constructors return an error for invalid parameters.
//! - Reproducibility: with the feature `libm`, results are bit-identical on every machine.
//!
//! # Limitations
//!
//! The caller multiplies the value of a rule by a Fresnel term as in the source. For the full
//! microfacet model with bumps see [`reflectance::FacetBrdf`]. A [`Bsdf`] describes a single point. Light transport between surfaces is the task of the renderer.
//!
//! # Features
//!
//! | feature | effect |
//! |---|---|
//! | `std` (default) | float functions of the standard library |
//! | `libm` | float functions of `libm`, without `std`; takes precedence when both are enabled |
//! | `alloc` (default) | the owned tables of `asperity-ndf-sampling`, environment maps, normal maps, boxed materials |
//! | `simd` (default) | SIMD for many lights and for the noise at a point, at the best available level; the same bits without it |
//! | `check` | property tests for any BRDF, including your own: module [`check`] |
//! | `mint` | conversion between the vectors of [`glam`] and `mint`, for engines with other vectors |
//! | `serde` | serialization of the parameters of materials and BRDFs; files contain the parameters that differ from the defaults |
//! | `bytemuck` | `Pod` for the structs of [`gpu`] |
//! | `approx` | the traits of `approx` for points, pixels, facets, light samples and textures; also enables `approx` of `asperity-noise` and `asperity-ndf-sampling`, and `approx-05` of glam |
#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-shading needs a float backend: enable the feature `std` or `libm`");

#[cfg(feature = "approx")]
mod approx;
pub mod bump;
#[cfg(feature = "check")]
pub mod check;
mod direction;
pub mod environment;
mod error;
pub mod gpu;
mod image;
pub mod level_of_detail;
mod low_discrepancy;
pub mod material;
mod math;
pub mod normal_map;
mod parameter;
pub mod pixel;
pub mod reflectance;
pub mod texture;

pub use asperity_ndf_sampling as ndf_sampling;
pub use asperity_ndf_sampling::{Beckmann, Frame, Ggx, Ndf};
pub use asperity_noise as noise;
pub use direction::{half_vector, reflect};
pub use environment::{Environment, EnvironmentMap, Irradiance, reflected_radiance};
pub use error::ShadingError;
pub use glam;
pub use level_of_detail::{BumpField, LevelOfDetail, far_field};
pub use material::{
    BumpMapped, Carpet, CarpetParameters, Material, MetallicPaint, MetallicPaintParameters, Scratches,
    ScratchesParameters, SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations,
    VariationsParameters,
};
pub use normal_map::SlopePyramid;
pub use pixel::{Footprint, PixelEllipse};
pub use reflectance::{
    Brdf, Bsdf, Conductor, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Fresnel, Lambert, OpenPbr,
    OpenPbrParameters, Phong, Schlick, StandardMaterial, StandardMaterialParameters, TorranceSparrow,
};
pub use texture::{Brick, Marble};
