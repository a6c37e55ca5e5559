//! The functions of the shaders beside those of the crates: an interpreter that needs no driver, and cases for it and for
//! drivers.

pub mod case;
pub mod cases;

pub use asperity_wgsl as interpreter;
