//! Reflectances: the trait and its models, smooth and rough, diffuse and glossy, with their samples.

pub(crate) mod brdf;
mod bsdf;
pub(crate) mod coat;
mod cook_torrance;
mod diffuse;
mod fresnel;
pub(crate) mod lobe;
mod phong;
mod torrance_sparrow;
mod ward;

pub use brdf::Brdf;
pub use bsdf::Bsdf;
pub use coat::{Coat, Delta};
pub use cook_torrance::{CookTorrance, Masking};
pub use diffuse::{AlbedoError, DiffuseError, EnergyPreservingOrenNayar, Lambert, OrenNayar, OrenNayarForm};
pub use fresnel::{
    Conductor, ConductorError, Dielectric, DielectricError, Fresnel, Schlick, SchlickError, SchlickF82,
    SchlickF82Error,
};
pub use lobe::Lobe;
pub use phong::{BlinnPhongFactor, BlinnPhongLobe, Phong, PhongError};
pub use torrance_sparrow::TorranceSparrow;
pub use ward::{WardError, WardForm, WardReflection};
