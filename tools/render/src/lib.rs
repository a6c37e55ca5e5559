//! The renderer of the gallery and of `asperity render`: shapes, light, materials, integrators.

#![allow(
    missing_docs,
    clippy::missing_errors_doc,
    clippy::missing_panics_doc,
    clippy::must_use_candidate,
    reason = "only tools and tests use it"
)]

pub mod failure;
pub mod geometry;
pub mod image;
pub mod input_file;
pub mod integrator;
pub mod interpolation;
pub mod light;
pub mod materials;
pub mod sampling;
pub mod scene;
pub mod scenes;
pub mod shaded;
