//! Tables for fast values: uniform and nonuniform knots, `f32` lanes, jets.

pub(crate) mod composite;
#[cfg(feature = "alloc")]
pub(crate) mod jet;
#[cfg(feature = "alloc")]
pub(crate) mod nonuniform;
pub(crate) mod truncation;
pub(crate) mod uniform;
#[cfg(feature = "alloc")]
pub(crate) mod uniform_f32;
#[cfg(all(feature = "alloc", feature = "simd"))]
pub(crate) mod uniform_f32_lanes;
