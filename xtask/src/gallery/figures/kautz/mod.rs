//! Figures of Kautz, Heidrich and Seidel 2001.

pub(super) mod isotropic;
pub(super) mod ndf;
pub(super) mod pipeline;
pub(super) mod sphere;
pub(super) mod teapot;
