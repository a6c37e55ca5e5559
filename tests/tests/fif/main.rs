//! Fractal interpolation: properties, references, rays and pinned values.

mod area;
mod bounds;
mod calculus;
mod certain;
mod errors;
mod exact;
mod fast;
mod fit;
mod folded;
mod golden;
mod hard_rays;
mod jets;
mod narrow;
mod oscillation;
mod properties;
mod rays;
mod recurrent;
mod reference;
mod rough_folded;
mod serialise;
mod surface_rays;
mod surfaces;
mod table_rays;
