//! Scenes: objects in their places, and cameras that see them.

mod portrait;
mod sets;
mod swatch;

pub use portrait::{Approach, RenderRequest, peak};
pub use sets::{Set, VASE_PROFILE, View, backdrop, ground};
pub use swatch::Form;
