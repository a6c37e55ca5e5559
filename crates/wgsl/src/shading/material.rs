//! Materials: reflectance times cosine at a point, filtered over a pixel.
//!
//! Each material has a function `material_eval_cos(material, point, wo, wi)` of its structure, the
//! point, and the directions to eye and light in the frame of the point. It returns
//! [`Bsdf::eval_cos`](asperity_shading::Bsdf::eval_cos) of
//! [`Material::bsdf`](asperity_shading::Material::bsdf). `material(point, wo, wi)` evaluates the
//! material in a uniform.

mod carpet;
mod glass;
mod glint;
mod mapped;
mod paint;
mod surface;
mod textured;
mod wear;

pub use carpet::CARPET;
pub use glass::TEMPERED_GLASS;
pub use glint::{COUNTED_FLAKES, GLINT_FIELD};
pub use mapped::{BUMP_MAPPED, NORMAL_MAPPED};
pub use paint::METALLIC_PAINT;
pub use surface::SURFACE_POINT;
pub use textured::{BEVELED_TILES, BRICK_WALL, PERTURBED_POINT, POLISHED_MARBLE, WALLPAPER};
pub use wear::{SCRATCHES, VARIATIONS};
