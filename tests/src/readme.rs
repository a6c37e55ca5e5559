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
