//! Existing normal maps: their texels, their density, and detail added to them.

pub(crate) mod detail;
#[cfg(feature = "alloc")]
pub(crate) mod estimate;
pub(crate) mod format;

pub use detail::{NoiseChain, detailed, detailed_normal};
#[cfg(feature = "alloc")]
pub use estimate::{EstimateError, NdfEstimator, estimate_ndf};
pub use format::{Blue, NormalMapFormat, TangentSpace, Zero};
