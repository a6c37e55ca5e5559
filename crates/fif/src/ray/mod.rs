//! Rays: first hits on height fields and on any surface.

pub(crate) mod box_descent;
pub(crate) mod cells;
pub(crate) mod height_field;
pub(crate) mod intersect;
pub(crate) mod interval_newton;
#[cfg(feature = "alloc")]
pub(crate) mod newton;
#[cfg(all(feature = "alloc", feature = "simd"))]
pub(crate) mod packet;
pub(crate) mod quadtree;
#[cfg(feature = "alloc")]
pub(crate) mod range_descent;
pub(crate) mod ray;
#[cfg(feature = "alloc")]
pub(crate) mod tabulated;
#[cfg(feature = "alloc")]
pub(crate) mod tracer;
pub(crate) mod way;
