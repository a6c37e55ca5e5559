//! Fresnel reflectance of smooth interfaces: dielectric, conductor, and Schlick's approximation.

mod conductor;
mod dielectric;
mod schlick;

pub use conductor::{Conductor, ConductorError};
pub use dielectric::{Dielectric, DielectricError};
pub use schlick::{Schlick, SchlickError};

/// A reflectance within `[0, 1]`; what overflowed to NaN is the limit of a perfect mirror.
#[inline]
fn reflectance_or_mirror(f: f32) -> f32 {
    if f >= 0.0 { f.min(1.0) } else { 1.0 }
}
