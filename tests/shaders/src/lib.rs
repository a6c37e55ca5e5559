//! The functions of the shaders beside those of the crates: cases for an interpreter, and for drivers.

pub mod case;
pub mod cases;
