//! Multiple scattering: directional albedos, and BRDFs scaled to return the light they lose.

mod albedo;
#[cfg(feature = "alloc")]
mod albedo_table;
mod compensated;
mod ggx;
mod glass;
mod glass_tables;
pub(super) mod spline;
mod tables;

pub use albedo::{DirectionalAlbedo, directional_albedo};
#[cfg(feature = "alloc")]
pub use albedo_table::AlbedoTable;
pub use compensated::EnergyCompensated;
pub(super) use compensated::multiple_bounces;
pub use ggx::GgxAlbedo;
pub use glass::GlassAlbedo;
