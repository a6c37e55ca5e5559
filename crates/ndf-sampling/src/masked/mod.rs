//! Smith masking and visible normals of tabulated NDFs.

pub(crate) mod bounded;
pub(crate) mod masked;
pub(crate) mod projected_area;
pub(crate) mod visible_grid;
pub(crate) mod wedge;
