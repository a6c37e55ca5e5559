//! Figures of Cohen, Procedural Bump Mapping and Noise.

pub(super) mod bevel;
pub(super) mod brick;
pub(super) mod bump;
pub(super) mod patterns;
pub(super) mod still_lifes;
