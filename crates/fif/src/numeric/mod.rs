//! Intervals, polynomials on the unit interval, and estimates with their errors.

pub(crate) mod bernstein;
pub(crate) mod double;
pub(crate) mod elimination;
pub(crate) mod estimate;
#[cfg(feature = "alloc")]
pub(crate) mod floor;
#[cfg(feature = "alloc")]
pub(crate) mod matrix2;
pub(crate) mod polynomial;
