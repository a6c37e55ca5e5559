//! Input from outside, as the builder reads it.

#[path = "../../../xtask/src/input/density.rs"]
#[allow(dead_code, reason = "the builder's own, of which the parsers are called")]
pub(crate) mod density;
#[path = "../../../xtask/src/input/fif_system.rs"]
#[allow(dead_code, reason = "the builder's own, of which the parsers are called")]
pub(crate) mod fif_system;
