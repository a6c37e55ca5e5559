//! Fresnel reflectance of smooth interfaces: dielectric, conductor, Schlick, Schlick with F82 tint.

mod conductor;
mod dielectric;
mod interface;
mod schlick;
mod schlick_f82;
mod schlick_rgb;

pub use conductor::Conductor;
pub use dielectric::Dielectric;
pub use interface::Fresnel;
pub(super) use interface::MEAN_NODES;
pub use schlick::Schlick;
pub use schlick_f82::SchlickF82;
pub(super) use schlick_rgb::SchlickRgb;
