//! Figures of Nilsson 2008.

pub(super) mod prng;
pub(super) mod sliders;
pub(super) mod zoom;
