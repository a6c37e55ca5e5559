//! Cellular noise: distances to the feature points of cells.

pub(crate) mod cellular;
pub(crate) mod metric;
pub(crate) mod rows;
pub(crate) mod search;
mod waves;
