//! WGSL functions for the noise, normal distributions, materials and fractal surfaces of Asperity.
//!
//! A [`Part`] is one concept: plain WGSL, its dependencies and its bindings.
//! [`compose`](fn@compose) joins parts into a WGSL module. You write the entry point. Without the
//! feature `alloc`, the sources are constants that you join yourself.
//!
//! The module `gpu` of each crate defines the uniforms as `#[repr(C)]` structs. The methods `gpu()`
//! return them, for instance [`Carpet::gpu`](asperity_shading::Carpet::gpu). With the feature
//! `bytemuck` the structs are `Pod`, and `bytemuck::bytes_of` returns the contents of a buffer.
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use asperity_wgsl::{Bindings, compose, noise};
//!
//! let wgsl = compose(&[&noise::PERLIN], Bindings::Textures { group: 0 });
//! assert!(wgsl.contains("fn perlin_noise_3d(p: vec3<f32>, key: u32) -> Sample3d"));
//! # }
//! ```
//!
//! `key` replaces the seed of a Rust noise:
//! [`IntegerHash::gpu_key`](asperity_noise::IntegerHash::gpu_key) of the seed. Directions of a
//! material are in the frame of its point, `surface_point_frame(point)`.
//!
//! | module | contents |
//! |---|---|
//! | [`noise`] | hash, noise with analytic gradients, fBm |
//! | [`ndf`] | normal distributions, their maps and tables, exact level of detail |
//! | [`shading`] | footprints, bump mapping, BRDFs, textures, materials |
//! | [`fif`] | fractal interpolation functions from tables, height fields, ray intersection |
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "alloc")]
mod compose;
pub mod fif;
#[cfg(feature = "alloc")]
mod imports;
pub mod ndf;
pub mod noise;
mod part;
mod parts;
pub mod shading;

#[cfg(feature = "alloc")]
pub use compose::{Bindings, compose, ordered};
#[cfg(feature = "alloc")]
pub use imports::{Imports, module};
pub use part::{Binding, Element, Part};
pub use parts::parts;
