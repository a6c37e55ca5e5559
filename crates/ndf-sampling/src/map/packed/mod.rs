//! A map of normals in one borrowed array of `f32`.

#[cfg(feature = "alloc")]
pub(crate) mod bins;
pub(crate) mod calls;
pub(crate) mod cdf;
pub(crate) mod error;
pub(crate) mod fetch;
pub(crate) mod grid;
pub(crate) mod inverse_cdf;
pub(crate) mod layout;
#[cfg(feature = "alloc")]
pub(crate) mod pack;
pub(crate) mod packed_map;
pub(crate) mod record;
