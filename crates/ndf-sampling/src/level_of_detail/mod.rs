//! Conditional densities of normals, given the part of a bump map that a pixel resolves.

pub(crate) mod conditional;
pub(crate) mod conditional_ndf;
pub(crate) mod offset_beckmann;
#[cfg(feature = "alloc")]
pub(crate) mod table;
pub(crate) mod table_ref;

pub use crate::coordinates::{GaussianSplit, MAX_SHARE};
pub use conditional::conditional_density;
pub use conditional_ndf::ConditionalNdf;
pub use offset_beckmann::{OffsetBeckmann, OffsetBeckmannError};
#[cfg(feature = "alloc")]
pub use table::{ConditionalAccuracy, ConditionalTable};
pub use table_ref::ConditionalTableRef;
