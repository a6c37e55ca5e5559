//! Tables for value, slope, integral and higher derivatives at once.

pub(crate) mod derivatives;
pub(crate) mod jet;
#[cfg(feature = "simd")]
pub(crate) mod lanes;
pub(crate) mod orders;
pub(crate) mod primitive;
pub(crate) mod rows;
pub(crate) mod sums;
