//! Figures of the noises.

pub(super) mod cellular;
pub(super) mod curl;
pub(super) mod footprint;
pub(super) mod gradients;
pub(super) mod kinds;
pub(super) mod patterns;
pub(super) mod plane;
pub(super) mod slope;
