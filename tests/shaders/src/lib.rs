//! Shader functions compared with the crates: an interpreter that needs no driver, and cases for
//! the interpreter and for drivers.

pub mod case;
pub mod cases;

pub use asperity_interpreter as interpreter;
