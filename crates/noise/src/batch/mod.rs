//! Grids and lists of points at a SIMD level.

pub(crate) mod batch;
pub(crate) mod grid;
