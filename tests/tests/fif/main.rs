//! Fractal interpolation: properties, references, rays and pinned values.

mod golden;
mod properties;
mod rays;
mod reference;
