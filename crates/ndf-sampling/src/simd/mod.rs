//! Float registers of any number of lanes, and elementary functions in them.

pub(crate) mod closed_form;
pub(crate) mod dispatch;
pub(crate) mod elementary;
pub(crate) mod lanes;
pub(crate) mod records;
#[cfg(feature = "simd")]
pub(crate) mod register_pair;
#[cfg(feature = "simd")]
pub(crate) mod registers;
#[cfg(feature = "alloc")]
pub(crate) mod transpose;
