//! Noise: the hash of lattice points, kinds with analytic gradients, sums of octaves.

use crate::part::{Part, part};

/// Structures of value and gradient in two, three and four dimensions.
pub static SAMPLE: Part = part!("noise/sample");

/// Hash of lattice points, the bits of [`IntegerHash`](asperity_noise::IntegerHash).
///
/// Seeds come as keys: [`Lattice::key`](asperity_noise::Lattice::key) of the seed, which takes 64 bits.
pub static INTEGER_HASH: Part = part!("noise/lattice/integer_hash");
