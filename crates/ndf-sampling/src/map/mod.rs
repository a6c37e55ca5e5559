//! Densities painted or computed on the hemispherical map of normals, and their distribution functions.

#[cfg(feature = "alloc")]
pub(crate) mod b_spline;
#[cfg(feature = "alloc")]
pub(crate) mod breakpoints;
#[cfg(feature = "alloc")]
pub(crate) mod cdf;
#[cfg(feature = "alloc")]
pub(crate) mod columns;
#[cfg(feature = "alloc")]
pub(crate) mod disk;
#[cfg(feature = "alloc")]
pub(crate) mod ndf_map;
pub(crate) mod packed;
#[cfg(feature = "alloc")]
pub(crate) mod piece;
#[cfg(feature = "alloc")]
pub(crate) mod pieces;
#[cfg(feature = "alloc")]
pub(crate) mod prefix_sums;
#[cfg(feature = "alloc")]
pub(crate) mod quantiles;
pub(crate) mod reconstruction;
#[cfg(feature = "alloc")]
pub(crate) mod row_guide;
#[cfg(feature = "alloc")]
pub(crate) mod texels;
