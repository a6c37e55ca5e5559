//! Table L: tangent frames by lookup of two Gaussian numbers.

#[cfg(feature = "alloc")]
pub(crate) mod accuracy;
pub(crate) mod batch;
pub(crate) mod chart;
pub(crate) mod error;
pub(crate) mod layout;
pub(crate) mod spacing;
pub(crate) mod table;

#[cfg(feature = "alloc")]
pub use accuracy::{Deviation, TableAccuracy};
pub use chart::Chart;
pub use error::NormalLutError;
pub use layout::{TableEntry, TableLayout};
pub use spacing::Spacing;
#[cfg(feature = "alloc")]
pub use table::NormalLut;
pub use table::{NormalLutIn, NormalLutRef};

pub use crate::numeric::binary16::{MAX_HALF, from_half, to_half};
