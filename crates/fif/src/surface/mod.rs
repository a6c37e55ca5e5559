//! Surfaces over rectangles: bounds, extrema, normals.

pub(crate) mod bounds;
#[cfg(feature = "alloc")]
pub(crate) mod extrema;
pub(crate) mod height_field;
#[cfg(feature = "alloc")]
pub(crate) mod hermite_patch;
#[cfg(feature = "alloc")]
pub(crate) mod self_affine;

pub use height_field::curve::Curve;
pub use height_field::function::Function;
#[cfg(feature = "alloc")]
pub use self_affine::{self_affine::Fold, torus_fold::TorusFold, zig_zag::ZigZag};
