//! Golden bits, and the same bits at every SIMD level: one program, so that kinds are compiled for their levels once.

#[path = "golden/mod.rs"]
mod golden;
#[cfg(feature = "alloc")]
#[path = "lanes/mod.rs"]
mod lanes;
