//! Surfaces that can be baked.

pub(super) mod density;
pub(super) mod finish;
pub(super) mod fractal;
pub(super) mod material;
pub(super) mod noise;
