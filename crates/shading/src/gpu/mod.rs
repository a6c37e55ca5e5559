//! Materials and textures as uniforms of shaders.
//!
//! The shaders are in the crate `asperity-wgsl`. The feature `bytemuck` implements `Pod` for the
//! structs. Their declarations in WGSL are generated from the same definitions.
//!
//! A material with sums of octaves also returns those, for the uniform of sums that the materials
//! of a module share. Its struct has their indices.
//!
//! ```
//! use asperity_noise::gpu::FbmUniform3d;
//! use asperity_shading::{Carpet, CarpetParameters};
//!
//! let carpet = Carpet::new(CarpetParameters::default())?;
//! let sums = FbmUniform3d::array(&carpet.gpu_sums());
//! let uniform = carpet.gpu(0);
//! assert_eq!(sums[uniform.threads.sum as usize].spectrum.max_octaves, uniform.threads.octaves);
//! # Ok::<(), asperity_shading::ShadingError>(())
//! ```

mod carpet;
mod glass;
mod mapped;
mod paint;
mod reflectance;
mod surface;
mod texture;
mod textured;
mod wear;

pub use carpet::{CarpetUniform, FibersUniform};
pub use glass::TemperedGlassUniform;
pub use mapped::{BumpMappedUniform, FrequencyClampUniform, NormalMappedUniform, SlopePyramidUniform};
pub use paint::{CountedFlakesUniform, GlintFieldUniform, MetallicPaintUniform};
pub use reflectance::{CoatUniform, OpenPbrUniform, StandardMaterialUniform};
pub use surface::{SegmentsUniform, SizedFbmUniform};
pub use texture::{
    BevelUniform, BrickUniform, GasUniform, MarbleUniform, PerturbedTextureUniform, StarWallpaperUniform,
};
pub use textured::{BeveledTilesUniform, BrickWallUniform, PolishedMarbleUniform, WallpaperUniform};
pub use wear::{ScratchesUniform, VariationsUniform};
