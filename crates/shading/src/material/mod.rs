//! Car materials after Nilsson 2008: carpet, metallic paint, tempered glass, and wear for any
//! surface.

mod bump_mapped;
mod carpet;
mod fbm;
mod glass;
mod glossy;
mod interface;
mod metallic_roughness;
mod normal_mapped;
mod paint;
mod plain;
mod segment;
mod surface_point;
mod textured;
mod wear;

pub use bump_mapped::BumpMapped;
pub use carpet::{
    Carpet, CarpetParameters, DarkAreas, DiffuseThreads, Fiber, Fibers, FibersParameters, Seam, SeamPattern,
    Seams, SpecularThreads, linear_seam, rim_light,
};
pub(crate) use fbm::{SizedFbm, half_mean};
pub use glass::{GlassBody, GlassWaves, TemperedGlass, TemperedGlassParameters, wave_gradient, wave_height};
pub use interface::Material;
pub use metallic_roughness::MetallicRoughness;
pub use normal_mapped::NormalMapped;
pub use paint::{
    Elimination, FlakePatch, GlintField, GlintFlake, MetallicPaint, MetallicPaintParameters, OrangePeel,
    PaintFlakes, PassiveFlakes, Sparkle, Sparkles, brighter_normal, brighter_reflection, flake_patch,
    sparkle_width,
};
pub(crate) use segment::Segments;
pub use surface_point::SurfacePoint;
pub use textured::{BeveledTiles, BrickWall, Perturbed, PolishedMarble, Wallpaper};
pub use wear::{Blemishes, Dents, Scratches, ScratchesParameters, Variations, VariationsParameters, varied};
