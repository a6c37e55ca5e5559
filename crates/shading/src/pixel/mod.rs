//! Pixels on a surface: their width, their two axes, and the octaves that they resolve.

mod ellipse;
mod footprint;
mod frequency_clamp;
pub(crate) mod principal_axis;
mod specular_antialiasing;

pub use ellipse::{PixelEllipse, Tap};
pub use footprint::Footprint;
pub use frequency_clamp::FrequencyClamp;
pub use specular_antialiasing::SpecularAntialiasing;
