//! Lattice points: where their bits come from, and the numbers that kinds make of them.

pub(crate) mod chained_table;
pub(crate) mod fade;
pub(crate) mod gaussian_levels;
pub(crate) mod integer_hash;
pub(crate) mod lattice;
pub(crate) mod permutation_table;
pub(crate) mod tiled;
pub(crate) mod variates;
