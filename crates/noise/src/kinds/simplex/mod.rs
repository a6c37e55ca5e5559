//! Simplex noise, plain and tiled.

pub(crate) mod rows;
pub(crate) mod simplex;
pub(crate) mod tiled;
