//! # asperity-noise
#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-noise needs a float backend: enable the feature `std` or `libm`");

mod blend;
mod fade;
mod gaussian;
mod gaussian_levels;
mod gaussian_octaves;
mod integer_hash;
mod lattice;
mod layer;
mod math;
mod noise;
mod octaves;
mod perlin;
mod permutation_table;
mod sample;
mod simplex;
mod space;
mod spectrum;
mod statistics;
mod statistics_tables;
mod variates;

pub use glam;

pub use gaussian::Gaussian;
pub use gaussian_octaves::GaussianOctaves;
pub use integer_hash::{IntegerHash, second_word};
pub use lattice::Lattice;
pub use noise::Noise;
pub use octaves::{Normalisation, Octaves};
pub use perlin::{Perlin1985, Perlin2002};
pub use permutation_table::PermutationTable;
pub use sample::Sample;
pub use simplex::Simplex;
pub use space::Point;
pub use spectrum::{MAX_OCTAVES, Spectrum, SpectrumError};
pub use statistics::Statistics;
pub use variates::{
    edge_direction_2, edge_direction_3, gaussian_variates_2, gaussian_variates_3, unit_direction_2,
    unit_direction_3,
};
