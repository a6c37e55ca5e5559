//! Existing normal maps: their texels, their density, and detail added to them.

pub(crate) mod detail;
#[cfg(feature = "alloc")]
pub(crate) mod estimate;
pub(crate) mod format;
