//! Self-affine surfaces over a torus and over a folded grid.

pub(crate) mod address;
pub(crate) mod folded;
pub(crate) mod folded_error;
pub(crate) mod folded_limits;
pub(crate) mod folded_node;
pub(crate) mod folded_ranges;
pub(crate) mod folded_value;
pub(crate) mod torus;
pub(crate) mod torus_error;
pub(crate) mod torus_limits;
pub(crate) mod torus_node;
pub(crate) mod torus_ranges;
pub(crate) mod torus_value;
