//! Flakes that mirror the light: single ones up close, counted from afar.

mod axis;
mod counts;
mod field;
mod flakes;

pub use field::GlintField;
pub use flakes::GlintFlake;
