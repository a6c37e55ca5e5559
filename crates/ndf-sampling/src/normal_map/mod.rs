//! Existing normal maps: decode texels, estimate the NDF, and add detail.

pub(crate) mod detail;
#[cfg(feature = "alloc")]
pub(crate) mod estimate;
pub(crate) mod format;

pub use detail::{add_detail, add_detail_normal};
#[cfg(feature = "alloc")]
pub use estimate::{NdfEstimator, estimate_ndf};
pub use format::{Blue, NormalMapFormat, TangentSpace, Zero};
