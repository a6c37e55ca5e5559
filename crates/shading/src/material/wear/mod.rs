//! Wear of any material: color variation, dents and scratches.

mod blemish;
mod dent;
mod scratch;
mod variations;

pub use blemish::Blemishes;
pub use dent::{Dents, DentsParameters};
pub use scratch::{Scratches, ScratchesParameters};
pub use variations::{Variations, VariationsParameters};
