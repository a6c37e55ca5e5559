//! WGSL for the noises, normal distributions, materials and fractal surfaces of Asperity, and
//! helpers that pack their uniforms and tables.
//!
//! A [`Part`] is one concept: plain WGSL, its dependencies and its bindings.
//! [`compose`](fn@compose) joins parts into a module. Without `alloc` the sources are constants
//! that you join yourself.
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use asperity_wgsl::{Bindings, compose, noise};
//!
//! let wgsl = compose(&[&noise::INTEGER_HASH], Bindings::Textures { group: 0 });
//! assert!(wgsl.contains("fn integer_hash_word(terms: u32, key: u32) -> u32"));
//! # }
//! ```
//!
//! | module | contents |
//! |---|---|
//! | [`noise`] | hash, kinds of noise with analytic gradients, sums of octaves |
//! | [`ndf`] | densities of normals, their maps and tables, exact level of detail |
//! | [`shading`] | pixels, bump mapping, reflectances, textures, materials |
//! | [`fif`] | fractal interpolation: table functions, height fields, ray intersection |
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
pub mod shading;

#[cfg(feature = "alloc")]
pub use compose::{Bindings, compose, ordered};
#[cfg(feature = "alloc")]
pub use imports::{Imports, module};
pub use part::{Binding, Element, Part};
