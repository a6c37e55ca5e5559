//! Scenes: objects in their places, and cameras that see them.

mod portrait;
mod sets;
mod swatch;

pub use portrait::{RenderRequest, peak};
pub use sets::{Behind, PLAIN, Set, View, backdrop, ground};
pub use swatch::Form;
