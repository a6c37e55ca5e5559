//! Integrals, moments, inner products, linear combinations.

pub(crate) mod cells;
pub(crate) mod inner_product;
pub(crate) mod integral;
pub(crate) mod linear_combination;
pub(crate) mod moment;
pub(crate) mod moment_basis;
