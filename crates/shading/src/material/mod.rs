//! The materials of a car, after Nilsson 2008: carpet, metallic paint, tempered glass, and variations for any surface.

mod bump_mapped;
mod carpet;
mod fbm;
mod form;
mod glass;
mod hash;
mod interface;
mod paint;
mod plain;
mod segment;
mod surface_point;
mod textured;
mod wear;

pub use bump_mapped::BumpMapped;
pub use carpet::{
    Carpet, CarpetParameters, CarpetSurface, DarkAreas, DiffuseThreads, Fibre, Fibres, FibresParameters,
    Seam, SeamPattern, Seams, SpecularThreads, linear_seam, rim_light,
};
pub use form::Form;
pub use glass::{
    GlassBody, GlassSurface, GlassWaves, TemperedGlass, TemperedGlassParameters, wave_gradient, wave_height,
};
pub use interface::Material;
pub use paint::{
    Elimination, Facet, FlakePatch, GlintField, GlintFlake, MetallicPaint, MetallicPaintParameters,
    OrangePeel, PaintFlakes, PaintSurface, PassiveFlakes, Sparkle, Sparkles, boosted, brighter_normal,
    brighter_reflection, flake_patch, flake_patch_printed, flake_tilt_printed, sparkle_width,
};
pub use surface_point::SurfacePoint;
pub use textured::{BevelledTiles, BrickWall, Perturbed, PolishedMarble, Wallpaper};
pub use wear::{
    Blemishes, Dents, ScratchedSurface, Scratches, ScratchesParameters, Variations, VariationsParameters,
    VariedSurface, varied,
};
