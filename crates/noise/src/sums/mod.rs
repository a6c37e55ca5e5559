//! Octaves and their sums.

pub(crate) mod anchor;
pub(crate) mod fbm;
pub(crate) mod frequency_clamp;
pub(crate) mod octave;
pub(crate) mod pass;
pub(crate) mod point;
pub(crate) mod ridged_multifractal;
pub(crate) mod shape;
pub(crate) mod spectrum;
pub(crate) mod turbulence;
pub(crate) mod whitened;
