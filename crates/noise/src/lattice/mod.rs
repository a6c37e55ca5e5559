//! Lattices: sources of the random bits of lattice points, and the variates made of them.

pub(crate) mod chained_table;
pub(crate) mod edges;
pub(crate) mod fade;
pub(crate) mod gaussian_levels;
pub(crate) mod integer_hash;
pub(crate) mod lattice;
pub(crate) mod perlin_table;
pub(crate) mod permutation_table;
pub(crate) mod shifted;
pub(crate) mod tiled;
pub(crate) mod variates;

pub use chained_table::ChainedTable;
pub use perlin_table::PerlinTable;
pub use permutation_table::PermutationTable;
pub use tiled::Tiled;
