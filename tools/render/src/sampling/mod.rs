//! Random, hashed, and low-discrepancy numbers for sampling.

pub mod low_discrepancy;
pub mod random;
pub mod sampler;
