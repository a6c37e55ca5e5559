//! Golden bits, equal bits at every SIMD level, and the public API of kinds, sums and transforms.
//!
//! One program, so that their instances are compiled once.

mod golden;
mod kinds;
#[cfg(feature = "alloc")]
mod lanes;
