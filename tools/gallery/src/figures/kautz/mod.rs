//! Figures of Kautz, Heidrich and Seidel 2001.

pub(super) mod ndf;
pub(super) mod objects;
