//! Values with bounds: at points, at addresses, at the nodes of even grids.

pub(crate) mod address;
pub(crate) mod grid;
pub(crate) mod value;
