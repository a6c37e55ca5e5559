//! Rays: first hits on height fields and on any surface.

pub(crate) mod boxes;
pub(crate) mod height_field;
pub(crate) mod intersect;
#[cfg(all(feature = "alloc", feature = "simd"))]
pub(crate) mod packet;
pub(crate) mod ray;
#[cfg(feature = "alloc")]
pub(crate) mod tables;
#[cfg(feature = "alloc")]
pub(crate) mod tabulated;
pub(crate) mod traversal;
