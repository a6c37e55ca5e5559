//! Normal maps made by hand, filtered by their slopes: what a pixel resolves of them is a mean, and the rest is roughness.

mod bilinear;
mod levels;
mod slope_lobes;
mod slope_moments;
#[cfg(feature = "alloc")]
mod slope_pyramid;
mod slope_pyramid_ref;

pub use slope_lobes::{SlopeLobe, SlopeLobes};
pub use slope_moments::SlopeMoments;
#[cfg(feature = "alloc")]
pub use slope_pyramid::SlopePyramid;
pub use slope_pyramid_ref::SlopePyramidRef;
