//! The program `asperity`, and the modules that it shares with other programs of this repository:
//! input, exported tables, progress, pages, command line.
#![expect(
    missing_docs,
    clippy::missing_errors_doc,
    clippy::must_use_candidate,
    reason = "only programs of this repository use it"
)]

#[cfg(feature = "program")]
mod bake;
#[cfg(feature = "program")]
mod check;
pub mod cli;
pub mod failure;
#[cfg(feature = "program")]
mod fields;
#[cfg(feature = "program")]
pub mod filter;
#[cfg(feature = "program")]
mod fractal;
pub mod html;
pub mod input;
#[cfg(feature = "program")]
pub mod invocation;
#[cfg(feature = "program")]
mod job;
#[cfg(feature = "program")]
mod ktx2_layout;
#[cfg(feature = "program")]
mod manual;
#[cfg(feature = "program")]
mod noise;
pub mod output;
#[cfg(feature = "program")]
pub mod program;
pub mod progress;
pub mod quality;
#[cfg(feature = "program")]
mod render;
#[cfg(feature = "shader")]
pub mod shader;
pub mod tables;
