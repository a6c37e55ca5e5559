//! # asperity-shading
#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-shading needs a float backend: enable the feature `std` or `libm`");

mod bump_field;
mod direction;
mod footprint;
mod frequency_clamp;
mod fresnel;
mod gaussian_field;
mod level_of_detail;
mod math;
mod remapped_octaves;

pub use asperity_ndf_sampling as ndf_sampling;
pub use asperity_ndf_sampling::{Beckmann, Frame, Ggx, Ndf, conditional_density};
pub use asperity_noise as noise;
pub use bump_field::BumpField;
pub use direction::{half_vector, reflect};
pub use footprint::Footprint;
pub use frequency_clamp::{FrequencyClamp, FrequencyClampError};
pub use fresnel::{Conductor, ConductorError, Dielectric, DielectricError, Schlick, SchlickError};
pub use gaussian_field::{Coordinates, GaussianField};
pub use glam;
pub use level_of_detail::{LevelOfDetail, facet_coordinates, far_field, shade_facet};
pub use remapped_octaves::RemappedOctaves;
