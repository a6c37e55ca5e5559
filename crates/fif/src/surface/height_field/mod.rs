//! Height fields `f(x) g(y)`.

pub(crate) mod area;
#[cfg(feature = "alloc")]
pub(crate) mod axis_tables;
pub(crate) mod cover;
pub(crate) mod curvature;
pub(crate) mod curve;
pub(crate) mod function;
pub(crate) mod height_field;
#[cfg(feature = "alloc")]
pub(crate) mod jet_table;
#[cfg(feature = "alloc")]
pub(crate) mod normal_distribution;
#[cfg(feature = "alloc")]
pub(crate) mod range_table;
