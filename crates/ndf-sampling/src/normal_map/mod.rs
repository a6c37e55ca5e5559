//! Formats of existing normal maps.
//!
//! [`NormalMapFormat`] decodes texels. [`estimate_ndf`](crate::estimate_ndf) and
//! [`add_detail`](crate::add_detail) use the decoded normals.

pub(crate) mod detail;
#[cfg(feature = "alloc")]
pub(crate) mod estimate;
pub(crate) mod format;

pub use format::{Blue, NormalMapFormat, TangentSpace, Zero};
