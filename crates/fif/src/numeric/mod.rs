//! Intervals, polynomials on the unit interval, and estimates with their errors.

pub(crate) mod bernstein;
pub(crate) mod double;
pub(crate) mod elimination;
pub(crate) mod estimate;
#[cfg(feature = "alloc")]
pub(crate) mod floor;
pub(crate) mod interval;
#[cfg(all(feature = "alloc", feature = "simd"))]
pub(crate) mod level;
#[cfg(feature = "alloc")]
pub(crate) mod matrix2;
pub(crate) mod polynomial;
pub(crate) mod refusal;
