//! Figures of the level of detail, of reflectance and of the shaders.

pub(super) mod furnace;
pub(super) mod fuzz;
pub(super) mod glints;
pub(super) mod graphics_card;
pub(super) mod height_bumps;
pub(super) mod mean_radiance;
pub(super) mod measured;
pub(super) mod normal_maps;
pub(super) mod reflectance;
pub(super) mod standard_material;
pub(super) mod visible_zoom;
