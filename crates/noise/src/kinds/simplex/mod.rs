//! Simplex noise, plain and tiled.

pub(crate) mod geometry;
pub(crate) mod kernel;
pub(crate) mod simplex;
pub(crate) mod tiled;
