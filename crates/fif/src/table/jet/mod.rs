//! Tables for value, slope, integral and higher derivatives at once.

pub(crate) mod jet;
#[cfg(feature = "simd")]
pub(crate) mod lanes;
pub(crate) mod primitive;
pub(crate) mod rows;
