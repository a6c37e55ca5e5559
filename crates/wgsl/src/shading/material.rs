//! Materials: reflectance times cosine at a point, filtered over a pixel.
//!
//! Each material has a function `material_scattered(material, point, wo, wi)` of its structure, the
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

pub use carpet::{CARPET, CarpetUniform, FIBRES, SEAMS};
pub use glass::{TEMPERED_GLASS, TemperedGlassUniform};
pub use glint::{COUNTED_FLAKES, CountedFlakesUniform, GLINT_FIELD, GlintFieldUniform};
pub use mapped::{BUMP_MAPPED, BumpMappedUniform, NORMAL_MAPPED, NormalMappedUniform};
pub use paint::{COATED_FLAKES, FLAKE_PATCH, METALLIC_PAINT, MetallicPaintUniform};
pub use surface::{FBM, GLOSSY, LATTICE_KEY, SEGMENTS, SURFACE_POINT};
pub use textured::{
    BEVELLED_TILES, BRICK_WALL, BevelledTilesUniform, BrickWallUniform, PERTURBED_POINT, POLISHED_MARBLE,
    PolishedMarbleUniform, TEXTURED_SLOPES, WALLPAPER, WallpaperUniform,
};
pub use wear::{BLEMISHES, DENTS, SCRATCHES, ScratchesUniform, VARIATIONS, VariationsUniform};
