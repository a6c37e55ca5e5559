//! Input from outside: densities of normals and fractal interpolation functions.

pub mod density;
pub mod fif_system;
pub mod images;
pub mod words;
