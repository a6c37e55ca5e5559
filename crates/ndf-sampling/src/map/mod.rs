//! NDFs painted or computed on the hemispherical map of normals, and their CDFs.

#[cfg(feature = "alloc")]
pub(crate) mod b_spline;
#[cfg(feature = "alloc")]
pub(crate) mod breakpoints;
#[cfg(feature = "alloc")]
pub(crate) mod columns;
#[cfg(feature = "alloc")]
pub(crate) mod disk;
#[cfg(feature = "alloc")]
#[cfg(feature = "alloc")]
pub(crate) mod marginal;
pub(crate) mod packed;
#[cfg(feature = "alloc")]
pub(crate) mod piece;
#[cfg(feature = "alloc")]
pub(crate) mod pieces;
#[cfg(feature = "alloc")]
pub(crate) mod prefix_sums;
pub(crate) mod reconstruction;
#[cfg(feature = "alloc")]
pub(crate) mod texels;
