//! Metallic paint, after Nilsson 2008, §4.3: orange peel, passive flakes, sparkles, and counted
//! flakes.

mod flake_patch;
mod glint;
mod orange_peel;
mod paint;
mod passive_flakes;
mod sparkle;

pub use flake_patch::{FlakePatch, flake_patch};
pub use glint::{GlintField, GlintFlake};
pub use orange_peel::OrangePeel;
pub use paint::{MetallicPaint, MetallicPaintParameters, PaintFlakes};
pub use passive_flakes::PassiveFlakes;
pub use sparkle::{Elimination, Sparkle, Sparkles, brighter_normal, brighter_reflection, sparkle_width};
