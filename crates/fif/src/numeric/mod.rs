//! Intervals, polynomials on the unit interval, and estimates with their errors.

pub(crate) mod bernstein;
pub(crate) mod estimate;
pub(crate) mod interval;
pub(crate) mod matrix2;
pub(crate) mod polynomial;
