//! Rays: first hits on height fields and on any surface.

#[cfg(feature = "alloc")]
pub(crate) mod batch;
pub(crate) mod box_descent;
pub(crate) mod interval_newton;
#[cfg(feature = "alloc")]
pub(crate) mod newton;
#[cfg(feature = "alloc")]
pub(crate) mod pyramid;
pub(crate) mod quadtree;
#[cfg(feature = "alloc")]
pub(crate) mod range_descent;
pub(crate) mod ray;
