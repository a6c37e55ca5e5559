//! SIMD lanes that kinds are written over, and the levels that a machine has.

pub(crate) mod lanes;
pub(crate) mod level;
#[cfg(feature = "simd")]
pub(crate) mod look_up;
#[cfg(feature = "simd")]
pub(crate) mod registers;
