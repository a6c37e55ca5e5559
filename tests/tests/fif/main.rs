//! Fractal interpolation: properties, references, rays and pinned values.

mod fast;
mod golden;
mod properties;
mod rays;
mod reference;
mod surfaces;
