//! Table L: tangent frames by lookup of two Gaussian numbers.

#[cfg(feature = "alloc")]
pub(crate) mod accuracy;
pub(crate) mod batch;
pub(crate) mod chart;
pub(crate) mod layout;
pub(crate) mod spacing;
pub(crate) mod table;

#[cfg(feature = "alloc")]
pub use accuracy::{Deviation, TableAccuracy};
pub use chart::Chart;
pub use layout::{TableEntry, TableLayout};
pub use spacing::Spacing;
