//! Metallic paint, after Nilsson 2008, §4.3: orange peel, passive flakes, sparkles, and counted
//! flakes.

mod flake_patch;
mod glint;
mod orange_peel;
mod paint;
mod passive_flakes;
mod sparkle;

pub use glint::{GlintField, GlintFlake};
pub use orange_peel::OrangePeel;
pub use paint::{MetallicPaint, MetallicPaintParameters, PaintFlakes};
pub use sparkle::Elimination;
