//! One-dimensional numerics: the Gaussian distribution, Bernstein polynomials, compensated sums,
//! quadrature, guide tables, half floats.

pub(crate) mod bernstein;
pub(crate) mod binary16;
#[cfg(feature = "alloc")]
pub(crate) mod compensated_sum;
pub(crate) mod gauss_kronrod;
#[cfg(feature = "alloc")]
pub(crate) mod guide_table;
pub(crate) mod normal_distribution;
