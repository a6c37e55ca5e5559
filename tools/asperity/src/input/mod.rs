//! Input from the command line and files: normal densities and fractal interpolation functions.

pub mod density;
pub mod fif_system;
pub mod images;
pub mod words;
