//! Tables for fast values: uniform and nonuniform knots, `f32` with SIMD, jets.

pub(crate) mod composite;
pub(crate) mod jet;
#[cfg(feature = "simd")]
pub(crate) mod lanes_f32;
pub(crate) mod nonuniform;
pub(crate) mod table;
pub(crate) mod uniform;
pub(crate) mod uniform_f32;
