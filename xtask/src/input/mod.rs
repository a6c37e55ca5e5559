//! Input from outside: densities of normals and fractal interpolation functions.

pub(crate) mod density;
pub(crate) mod fif_system;
