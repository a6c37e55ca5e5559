//! Level of detail of Gaussian bump maps: the resolved part, and shading of the rest.

mod bump_field;
mod gaussian_field;
mod remapped_octaves;
mod rule;

pub use bump_field::BumpField;
pub use gaussian_field::{GaussianField, IndependentChannels, ResolvedBumps};
pub use remapped_octaves::RemappedOctaves;
pub use rule::{LevelOfDetail, facet_coordinates, far_field, shade_facet};
