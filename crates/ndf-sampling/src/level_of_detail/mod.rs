//! Conditional NDFs, given the part of a bump map that a pixel resolves.

#[cfg(feature = "alloc")]
pub(crate) mod build;
pub(crate) mod conditional;
pub(crate) mod conditional_ndf;
pub(crate) mod offset_beckmann;
pub(crate) mod table;
pub(crate) mod visible_facets;
