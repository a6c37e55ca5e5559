//! Complete materials of engines and interchange formats.

pub(super) mod layers;
mod open_pbr;
mod relief;
mod stack;
mod standard_material;

pub use open_pbr::{OpenPbr, OpenPbrParameters};
pub use standard_material::{StandardMaterial, StandardMaterialParameters};
