//! Self-affine surfaces over a torus and over a folded grid.

pub(crate) mod address;
pub(crate) mod error;
pub(crate) mod folded;
pub(crate) mod folded_ranges;
pub(crate) mod limits;
pub(crate) mod rough_folded;
pub(crate) mod self_affine;
pub(crate) mod torus;
pub(crate) mod torus_fold;
pub(crate) mod torus_ranges;
pub(crate) mod zig_zag;
