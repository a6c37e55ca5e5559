//! Radiance along rays, and pictures of it.

pub mod direct;
pub mod hemisphere;
pub mod path_tracer;
pub mod pixels;
pub mod request;
pub mod swatch;
