//! Golden bits, the same bits at every SIMD level, and kinds, sums and transforms by their public API: one program, so that what
//! they instantiate is compiled once.

mod golden;
mod kinds;
#[cfg(feature = "alloc")]
mod lanes;
