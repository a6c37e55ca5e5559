//! BRDFs and BSDFs: the trait and models, smooth and rough, diffuse and glossy, complete materials, with sampling.

mod absorption;
pub(crate) mod brdf;
mod bsdf;
pub(crate) mod coat;
mod cook_torrance;
mod diffuse;
mod energy;
mod facet_brdf;
mod fresnel;
mod fuzz;
pub(crate) mod lobe;
mod phong;
mod rough_dielectric;
mod standard;
mod torrance_sparrow;
mod ward;

pub use absorption::Absorption;
pub use brdf::{Brdf, BsdfSample, SampleKind};
pub use bsdf::Bsdf;
pub use coat::Coat;
pub use cook_torrance::{BumpFacets, CookTorrance, Masking};
pub use diffuse::{EnergyPreservingOrenNayar, Lambert, OrenNayar, OrenNayarVariant};
#[cfg(feature = "alloc")]
pub use energy::AlbedoTable;
pub use energy::{DirectionalAlbedo, EnergyCompensated, GgxAlbedo, GlassAlbedo, directional_albedo};
pub use facet_brdf::FacetBrdf;
pub use fresnel::{Conductor, Dielectric, Fresnel, Schlick, SchlickF82};
pub use fuzz::{CharlieSheen, ZeltnerFuzz};
pub use lobe::Lobe;
pub(crate) use lobe::LobePart;
pub use phong::{BlinnPhongBrdf, BlinnPhongNormalization, Phong};
pub use rough_dielectric::RoughDielectric;
pub use standard::{OpenPbr, OpenPbrParameters, StandardMaterial, StandardMaterialParameters};
pub use torrance_sparrow::TorranceSparrow;
pub use ward::{WardBrdf, WardNormalization};
