//! Noises that blend the corners of a cubic cell.

pub(crate) mod at_ends;
pub(crate) mod blend;
pub(crate) mod column;
pub(crate) mod corner;
pub(crate) mod corners;
pub(crate) mod edge_columns;
pub(crate) mod gradient_covariance;
pub(crate) mod hessian;
pub(crate) mod kernel;
pub(crate) mod row_edges;
pub(crate) mod rows;
pub(crate) mod variance;
