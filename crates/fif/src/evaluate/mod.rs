//! Values with error bounds: at points, at addresses, at the nodes of uniform grids.

pub(crate) mod address;
pub(crate) mod grid;
pub(crate) mod value;
