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

/// The guide from a painting to a material.
#[doc = include_str!("../../docs/guide/painted-density.md")]
pub struct PaintedDensity;

/// The guide to kinds of noise.
#[doc = include_str!("../../docs/guide/which-noise.md")]
pub struct WhichNoise;

/// The guide to level of detail.
#[doc = include_str!("../../docs/guide/exact-zoom.md")]
pub struct ExactZoom;

/// The guide to fractal functions.
#[doc = include_str!("../../docs/guide/fractal-functions.md")]
pub struct FractalFunctions;

/// The guide to reproducible values.
#[doc = include_str!("../../docs/guide/determinism.md")]
pub struct Determinism;

/// The guide to tables in flash.
#[doc = include_str!("../../docs/guide/embedded.md")]
pub struct Embedded;

/// The guide to the command line, which has no Rust as yet.
#[doc = include_str!("../../docs/guide/command-line.md")]
pub struct CommandLine;
