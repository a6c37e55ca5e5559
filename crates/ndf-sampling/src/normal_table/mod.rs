//! Table L: tangent frames by look-up of two Gaussian numbers.

#[cfg(feature = "alloc")]
pub(crate) mod accuracy;
pub(crate) mod batch;
pub(crate) mod chart;
pub(crate) mod layout;
pub(crate) mod spacing;
#[cfg(feature = "alloc")]
pub(crate) mod table;
pub(crate) mod table_ref;
