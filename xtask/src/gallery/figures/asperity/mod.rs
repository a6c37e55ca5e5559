//! Figures of the level of detail and of reflectance.

pub(super) mod mean_radiance;
pub(super) mod measured;
pub(super) mod normal_maps;
pub(super) mod reflectance;
