//! Simplex noise, plain and tiled.

#[cfg(feature = "simd")]
pub(crate) mod at_corners;
pub(crate) mod geometry;
pub(crate) mod kernel;
pub(crate) mod rows;
pub(crate) mod simplex;
pub(crate) mod tiled;
