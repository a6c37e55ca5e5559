//! Shading by a density of normals, from afar and close by: the mean radiance of a surface is the same at every zoom. And
//! the reflectances that go with it, diffuse and glossy, each with its samples.
//!
//! A pixel resolves some octaves of a surface's bump map and not the rest. This crate decides how many from the pixel's
//! [`Footprint`], takes the resolved ones from a noise, and shades what the pixel then sees, by one of two rules
//! ([`LevelOfDetail`]): `Exact`, whose mean over the surface is the far field at every zoom, and `Fractal`, the rule of
//! Kautz, Heidrich, Seidel 2001, "Real-Time Bump Map Synthesis".
//!
//! ```
//! use asperity_shading::glam::Vec3;
//! use asperity_shading::noise::{Gaussian, GaussianOctaves, Spectrum};
//! use asperity_shading::{BumpField, Footprint, Frame, Ggx, LevelOfDetail, far_field, half_vector};
//!
//! let ndf = Ggx::new(0.2, 0.4)?;
//! let bumps = BumpField::new(GaussianOctaves::new(Gaussian::new(1), Spectrum::default()), 20.0)?;
//!
//! // A point of the surface, its normal and ∂P/∂u, the directions to the light and to the eye.
//! let (p, frame) = (Vec3::new(0.3, 0.1, 0.8), Frame::from_normal_tangent(Vec3::Z, Vec3::X));
//! let (wi, wo) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.4, 0.2, 0.9).normalize());
//!
//! let h = frame.to_local(half_vector(wi, wo));
//! let shade = |distance: f32| {
//!     let pixel = Footprint::from_distance(distance, 1e-3, wo.dot(frame.normal));
//!     LevelOfDetail::Exact.radiance(&ndf, h, bumps.coordinates(p, pixel))
//! };
//! assert_eq!(shade(100.0), far_field(&ndf, h));
//! assert_ne!(shade(1.0), far_field(&ndf, h));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! | item | is |
//! |---|---|
//! | [`half_vector`], [`reflect`] | the facet that mirrors one direction into another; the mirrored direction |
//! | [`Frame`] | tangent frame of the macro surface, from its normal with or without ∂P/∂u; of a facet, by minimal rotation |
//! | [`far_field`] | p(h), shading where nothing is resolved |
//! | [`Footprint`], [`PixelEllipse`] | width of a pixel on the surface, from distance and angle or from two derivatives; its long and its short axis |
//! | [`FrequencyClamp`] | footprint → real count of octaves, none above the pixel's Nyquist frequency |
//! | [`GaussianField`], [`Coordinates`] | two Gaussian noises over space; what is resolved of them at a point |
//! | [`RemappedOctaves`] | classic noise as such a field, through its measured distribution; [`noise::GaussianOctaves`] needs none |
//! | [`BumpField`] | a field laid into space, with its frequency clamp |
//! | [`surface_gradient`], [`tangential`], [`gradient_of_normal`], [`differences`] | gradients along a surface: from two parameters, from space, from a normal, by neighbours |
//! | [`bumped_normal`], [`lecture_normal`], [`displace`], [`facing`] | bump mapping: the normals of displaced surfaces |
//! | [`slope_facets`](fn@slope_facets) | slopes that a pixel does not resolve, as a few facets |
//! | [`LevelOfDetail`] | the rules `Exact` and `Fractal`: radiance, and the bump map's normal |
//! | [`SlopePyramidRef`], [`SlopePyramid`], [`SlopeLobes`], [`SlopeLobe`], [`SlopeMoments`] | normal maps made by hand at every zoom: their slopes within a pixel |
//! | [`facet_coordinates`], [`shade_facet`] | the `Fractal` rule in two steps, for a table of frames between them |
//! | [`Fresnel`]: [`Dielectric`], [`Conductor`], [`Schlick`], [`SchlickF82`] | Fresnel reflectance, unpolarised |
//! | [`Brdf`] | what a surface does to light: value, samples and their density |
//! | [`Lambert`], [`OrenNayar`], [`EnergyPreservingOrenNayar`] | diffuse surfaces, smooth and rough |
//! | [`CookTorrance`], [`TorranceSparrow`] | surfaces of mirrors, with Smith's masking or that of V-shaped grooves |
//! | [`Environment`]: [`LatitudeLongitude`], [`EnvironmentRef`], [`EnvironmentMap`] | light from all around by an image, its samples and their density |
//! | [`light_samples`], [`LightSample`], [`reflected_radiance`], [`even_points`] | what a surface sends on of it, by samples of both |
//! | [`Irradiance`], [`PrefilteredRef`], [`PrefilteredMap`], [`PrefilteredLevel`], [`prefiltered_radiance`] | the same by one look-up, diffuse and glossy |
//! | [`SplitSum`], [`split_sum`] | how much of even light a rough mirror sends on |
//! | [`SurfacePoint`], [`Form`], [`ParameterError`] | where materials are evaluated; printed or corrected formulas; parameters refused |
//! | [`Carpet`], [`CarpetParameters`], [`CarpetSurface`] | the carpet of a car; its parts: |
//! | [`DiffuseThreads`], [`SpecularThreads`], [`DarkAreas`] | threads together and singly; darker areas |
//! | [`Seams`], [`SeamPattern`], [`Seam`], [`linear_seam`], [`rim_light`] | seams of a carpet, light along its rim |
//! | [`MetallicPaint`], [`MetallicPaintParameters`], [`PaintSurface`], [`Facet`] | metallic paint; its parts: |
//! | [`OrangePeel`], [`PassiveFlakes`] | bumps of the clear coat; flakes that vary the colour |
//! | [`Sparkles`], [`Sparkle`], [`Elimination`], [`brighter_normal`], [`brighter_reflection`], [`boosted`], [`sparkle_width`] | sparkling flakes of a fixed width in pixels |
//! | [`flake_patch`], [`FlakePatch`], [`flake_patch_printed`], [`flake_tilt_printed`] | which flake a point is in |
//! | [`GlintField`], [`GlintFlake`] | flakes of any density, single or counted, with its mean at every distance |
//! | [`Fibres`], [`FibresParameters`], [`Fibre`] | threads that are still threads from very near |
//! | [`Scratches`], [`ScratchesParameters`], [`ScratchedSurface`] | scratches by hashes, with their mean in closed form |
//! | [`TemperedGlass`], [`TemperedGlassParameters`], [`GlassSurface`], [`GlassWaves`], [`wave_height`], [`wave_gradient`] | glass with waves |
//! | [`Variations`], [`VariationsParameters`], [`VariedSurface`] | variations for any material; its parts: |
//! | [`Blemishes`], [`varied`], [`Dents`] | spots of colour; dents here and there |
//! | [`Phong`], [`BlinnPhongLobe`], [`WardReflection`] | lobes about the mirrored direction and the half vector |
//! | [`Brick`], [`Bevel`], [`Edge`] | bricks and mortar, with the exact mean over a pixel; ridges along edges |
//! | [`StarWallpaper`], [`PerturbedTexture`], [`Marble`] | stars in cells, images that run, blue marble |
//! | [`Gas`], [`Steam`], [`march`] | gas as a density, its room over a cup, light through it |
//!
//! # Conventions
//!
//! - Directions are unit vectors that point away from the surface; `h` is in the frame of the macro surface, whose z axis
//!   is the normal. Densities and radiances per unit of light are in sr⁻¹, frequencies in lattice cells per unit of
//!   length, angles in radians.
//! - Evaluation is total: half vectors that do not exist or are below the horizon are dark, footprints that cannot be
//!   measured resolve nothing, a cosine that is NaN is the horizon's. Constructors refuse what is no parameter.
//! - Reproducibility: the same bits on every machine under the feature `libm`.
//!
//! # What it does not do
//!
//! Both rules of level of detail show p(h) as it is, without masking and shadowing; a Fresnel term is
//! multiplied on by the caller, at the angle between `h` and either direction. The full microfacet model is [`CookTorrance`].
//!
//! # Features
//!
//! | feature | does |
//! |---|---|
//! | `std` (default) | float functions of the standard library |
//! | `libm` | float functions of `libm`, without `std`; wins when both are on |
//! | `alloc` (default) | the owned tables of `asperity-ndf-sampling` |
#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-shading needs a float backend: enable the feature `std` or `libm`");

pub mod bump;
mod direction;
pub mod environment;
pub mod level_of_detail;
pub mod material;
mod math;
pub mod normal_map;
pub mod pixel;
pub mod reflectance;
pub mod texture;

pub use asperity_ndf_sampling as ndf_sampling;
pub use asperity_ndf_sampling::{Beckmann, BlinnPhong, Frame, Ggx, Microfacet, Ndf, conditional_density};
pub use asperity_noise as noise;
pub use bump::{
    Displaced, bumped_normal, differences, displace, facing, gradient_of_normal, lecture_normal,
    slope_facets, surface_gradient, tangential,
};
pub use direction::{half_vector, reflect};
pub use environment::{
    Environment, EnvironmentError, EnvironmentRef, Irradiance, LatitudeLongitude, LightSample,
    PrefilteredError, PrefilteredLevel, PrefilteredRef, SplitSum, even_points, light_samples,
    prefiltered_radiance, reflected_radiance, split_sum,
};
#[cfg(feature = "alloc")]
pub use environment::{EnvironmentMap, PrefilteredMap};
pub use glam;
pub use level_of_detail::{
    BumpField, Coordinates, GaussianField, LevelOfDetail, RemappedOctaves, facet_coordinates, far_field,
    shade_facet,
};
pub use material::{
    Blemishes, Carpet, CarpetParameters, CarpetSurface, DarkAreas, Dents, DiffuseThreads, Elimination, Facet,
    Fibre, Fibres, FibresParameters, FlakePatch, Form, GlassSurface, GlassWaves, GlintField, GlintFlake,
    Material, MetallicPaint, MetallicPaintParameters, OrangePeel, PaintSurface, ParameterError,
    PassiveFlakes, ScratchedSurface, Scratches, ScratchesParameters, Seam, SeamPattern, Seams, Sparkle,
    Sparkles, SpecularThreads, SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations,
    VariationsParameters, VariedSurface, boosted, brighter_normal, brighter_reflection, flake_patch,
    flake_patch_printed, flake_tilt_printed, linear_seam, rim_light, sparkle_width, varied, wave_gradient,
    wave_height,
};
#[cfg(feature = "alloc")]
pub use normal_map::SlopePyramid;
pub use normal_map::{SlopeLobe, SlopeLobes, SlopeMoments, SlopePyramidError, SlopePyramidRef};
pub use pixel::{Footprint, FrequencyClamp, FrequencyClampError, PixelEllipse};
pub use reflectance::{
    AlbedoError, BlinnPhongFactor, BlinnPhongLobe, Brdf, Bsdf, Conductor, ConductorError, CookTorrance,
    Dielectric, DielectricError, DiffuseError, EnergyPreservingOrenNayar, Fresnel, Lambert, Masking,
    OrenNayar, OrenNayarForm, Phong, PhongError, Schlick, SchlickError, SchlickF82, SchlickF82Error,
    TorranceSparrow, WardError, WardForm, WardReflection,
};
pub use texture::{
    Bevel, BevelError, Brick, BrickError, BrickSample, Edge, Gas, GasError, Marble, MarbleError,
    PerturbedTexture, Seen, StarWallpaper, StarWallpaperError, Steam, march,
};
