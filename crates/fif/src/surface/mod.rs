//! Surfaces over rectangles: bounds, extrema, normals.

pub(crate) mod extrema;
pub(crate) mod height_field;
pub(crate) mod hermite_patch;
pub(crate) mod self_affine;
pub(crate) mod surface;
