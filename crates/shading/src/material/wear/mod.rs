//! Wear of any material: color variation, dents and scratches.

mod blemish;
mod dent;
mod scratch;
mod variations;

pub use blemish::{Blemishes, varied};
pub use dent::Dents;
pub use scratch::{Scratches, ScratchesParameters};
pub use variations::{Variations, VariationsParameters};
