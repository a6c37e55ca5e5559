//! Fuzz over a surface: sheen of cloth and dust.

mod charlie;
mod charlie_albedo;
mod zeltner;

pub use charlie::CharlieSheen;
pub use zeltner::ZeltnerFuzz;
