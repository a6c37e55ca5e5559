//! Materials: BRDFs on bumps, glints, walls, and the car materials of Nilsson 2008, which are carpet,
//! metallic paint, tempered glass, and wear for any surface.

mod bump_mapped;
mod bump_mapped_brdf;
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
pub use bump_mapped_brdf::BumpMappedBrdf;
pub use carpet::{
    Carpet, CarpetParameters, Fiber, Fibers, FibersParameters, Seam, SeamPattern, Seams, SeamsParameters,
};
pub(crate) use fbm::{SizedFbm, half_mean};
pub use glass::{GlassBody, GlassWaves, TemperedGlass, TemperedGlassParameters};
pub use interface::Material;
pub use metallic_roughness::MetallicRoughness;
pub use normal_mapped::NormalMapped;
pub use paint::{
    Elimination, GlintField, GlintFlake, MetallicPaint, MetallicPaintParameters, OrangePeel, PaintFlakes,
};
pub(crate) use segment::Segments;
pub use surface_point::SurfacePoint;
pub use textured::{BeveledTiles, BrickWall, Perturbed, PolishedMarble, Wallpaper};
pub use wear::{
    Blemishes, Dents, DentsParameters, Scratches, ScratchesParameters, Variations, VariationsParameters,
};
