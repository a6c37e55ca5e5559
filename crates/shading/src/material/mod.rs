//! The materials of a car, after Nilsson 2008: carpet, metallic paint, tempered glass, and variations for any surface.

mod blemish;
mod carpet;
mod dark_area;
mod dent;
mod fbm;
mod fibre;
mod flake_patch;
mod form;
mod glass;
mod glint;
mod orange_peel;
mod paint;
mod parameter;
mod passive_flakes;
mod rim;
mod scratch;
mod seam;
mod segment;
mod sparkle;
mod surface_point;
mod thread;
mod variations;

pub use blemish::{Blemishes, varied};
pub use carpet::{Carpet, CarpetParameters, CarpetSurface};
pub use dark_area::DarkAreas;
pub use dent::Dents;
pub use fibre::{Fibre, Fibres, FibresParameters};
pub use flake_patch::{FlakePatch, flake_patch, flake_patch_printed, flake_tilt_printed};
pub use form::Form;
pub use glass::{
    GlassSurface, GlassWaves, TemperedGlass, TemperedGlassParameters, wave_gradient, wave_height,
};
pub use glint::{GlintField, GlintFlake};
pub use orange_peel::OrangePeel;
pub use paint::{Facet, MetallicPaint, MetallicPaintParameters, PaintSurface};
pub use parameter::ParameterError;
pub use passive_flakes::PassiveFlakes;
pub use rim::rim_light;
pub use scratch::{ScratchedSurface, Scratches, ScratchesParameters};
pub use seam::{Seam, SeamPattern, Seams, linear_seam};
pub use sparkle::{
    Elimination, Sparkle, Sparkles, boosted, brighter_normal, brighter_reflection, sparkle_width,
};
pub use surface_point::SurfacePoint;
pub use thread::{DiffuseThreads, SpecularThreads};
pub use variations::{Variations, VariationsParameters, VariedSurface};
