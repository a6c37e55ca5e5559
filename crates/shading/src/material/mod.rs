//! The materials of a car, after Nilsson 2008: carpet, metallic paint, tempered glass, and variations for any surface.

mod carpet;
mod dark_area;
mod fbm;
mod form;
mod parameter;
mod rim;
mod seam;
mod surface_point;
mod thread;

pub use carpet::{Carpet, CarpetParameters, CarpetSurface};
pub use dark_area::DarkAreas;
pub use form::Form;
pub use parameter::ParameterError;
pub use rim::rim_light;
pub use seam::{Seam, SeamPattern, Seams};
pub use surface_point::SurfacePoint;
pub use thread::{DiffuseThreads, SpecularThreads};
