//! Authored normal maps, filtered by their slopes: the resolved part is a mean, the rest is
//! roughness.

mod bilinear;
mod levels;
mod slope_lobes;
mod slope_moments;
mod slope_pyramid;

pub use slope_lobes::{SlopeLobe, SlopeLobes};
pub use slope_moments::SlopeMoments;
pub use slope_pyramid::SlopePyramid;
