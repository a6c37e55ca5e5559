//! Fully shaded surfaces, through a telephoto lens and up to the horizon.
//!
//! The tests measure them, and the gallery shows the measurements.

mod horizon;
mod materials;
mod pixel;
mod subject;
mod telephoto;
mod textures;

pub use horizon::{Horizon, Seen, errors, grain};
pub use materials::{fibers_alone, fractal_bumps, materials};
pub use subject::{Sky, Subject};
pub use telephoto::{Frame, Mean, Patch, largest_pop};
pub use textures::textures;
