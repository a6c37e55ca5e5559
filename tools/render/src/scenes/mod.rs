//! Scenes: arranged objects, and cameras.

mod portrait;
mod sets;
mod swatch;

pub use portrait::{RenderRequest, peak};
pub use sets::{Behind, PLAIN, Set, View, backdrop, ground};
pub use swatch::Form;
