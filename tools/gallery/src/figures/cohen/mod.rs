//! Figures of Cohen, Procedural Bump Mapping and Noise.

pub(super) mod bumps;
pub(super) mod patterns;
pub(super) mod still_lifes;
