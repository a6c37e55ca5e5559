//! Materials of scenes: the crate's materials in meters, and surfaces of figures.

mod bumped;
pub mod cobbles;
pub mod field;
pub mod pattern;
mod projected;
mod shader;

pub use bumped::{Facets, Printed, SharedNdf, share_beyond, sky};
pub use projected::Projected;
pub use shader::{InMetres, Layers, Shaded, chalk, glazed};
