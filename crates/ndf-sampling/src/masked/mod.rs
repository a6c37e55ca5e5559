//! Smith's masking and visible normals of densities that are tables.

pub(crate) mod bounded;
pub(crate) mod masked;
pub(crate) mod projected_area;
pub(crate) mod wedge;
