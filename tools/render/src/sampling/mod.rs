//! Numbers by which pictures are sampled: random, hashed, and of low discrepancy.

pub mod low_discrepancy;
pub mod random;
pub mod sampler;
