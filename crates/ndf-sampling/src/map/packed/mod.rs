//! A map of normals in one borrowed array of `f32`.

pub(crate) mod block;
pub(crate) mod calls;
pub(crate) mod cdf;
pub(crate) mod density;
pub(crate) mod grid;
pub(crate) mod inverse_cdf;
pub(crate) mod layout;
pub(crate) mod leaf;
#[cfg(feature = "alloc")]
pub(crate) mod most;
#[cfg(feature = "alloc")]
pub(crate) mod ndf_map;
#[cfg(feature = "alloc")]
pub(crate) mod pack;
pub(crate) mod packed_map;
#[cfg(feature = "alloc")]
pub(crate) mod quantiles;
pub(crate) mod search;
pub(crate) mod uniform;
