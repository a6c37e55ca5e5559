//! Fresnel reflectance of smooth interfaces: dielectric, conductor, and Schlick's approximation.

mod conductor;
mod dielectric;
mod schlick;

pub use conductor::{Conductor, ConductorError};
pub use dielectric::{Dielectric, DielectricError};
pub use schlick::{Schlick, SchlickError};

/// The cosine as every reflectance here takes it: clamped to `[0, 1]`, with NaN as 0.
#[inline]
fn clamped_cosine(cos_theta: f32) -> f32 {
    // `clamp` would pass NaN on; `max` drops it.
    cos_theta.max(0.0).min(1.0)
}

/// A reflectance within `[0, 1]`; what overflowed to NaN is the limit of a perfect mirror.
#[inline]
fn reflectance_or_mirror(f: f32) -> f32 {
    if f >= 0.0 { f.min(1.0) } else { 1.0 }
}
