//! The examples of every README, run as documentation tests.

/// The project's page.
#[doc = include_str!("../../README.md")]
pub struct Project;

/// The page of `asperity-noise`.
#[doc = include_str!("../../crates/noise/README.md")]
pub struct Noise;

/// The page of `asperity-ndf-sampling`.
#[doc = include_str!("../../crates/ndf-sampling/README.md")]
pub struct NdfSampling;

/// The page of `asperity-fif`.
#[doc = include_str!("../../crates/fif/README.md")]
pub struct System;

/// The page of `asperity-shading`.
#[doc = include_str!("../../crates/shading/README.md")]
pub struct Shading;

/// The page of `asperity-shaders`.
#[doc = include_str!("../../crates/shaders/README.md")]
pub struct Shaders;

/// The guide for those who come from another noise library.
#[doc = include_str!("../../docs/guide/coming-from-noise.md")]
pub struct ComingFromNoise;

/// The guide to a renderer.
#[doc = include_str!("../../docs/guide/renderer.md")]
pub struct Renderer;

/// The guide to textures.
#[doc = include_str!("../../docs/guide/engine-textures.md")]
pub struct EngineTextures;

/// The guide to shaders.
#[doc = include_str!("../../docs/guide/shaders.md")]
pub struct ShadersInEngines;

/// The guide to fits.
#[doc = include_str!("../../docs/guide/fractal-fit.md")]
pub struct FractalFit;
