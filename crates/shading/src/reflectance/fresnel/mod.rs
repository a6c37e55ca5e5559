//! Fresnel reflectance of smooth interfaces: dielectric, conductor, Schlick's approximation and its tint at 82°.

mod conductor;
mod dielectric;
mod interface;
mod schlick;
mod schlick_f82;

pub use conductor::{Conductor, ConductorError};
pub use dielectric::{Dielectric, DielectricError};
pub use interface::Fresnel;
pub use schlick::{Schlick, SchlickError};
pub use schlick_f82::{SchlickF82, SchlickF82Error};
