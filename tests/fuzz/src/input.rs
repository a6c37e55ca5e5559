//! Input from outside, as the builder reads it.

#[path = "../../../tools/asperity/src/input/density.rs"]
#[allow(dead_code, reason = "the builder's own, of which the parsers are called")]
pub(crate) mod density;
#[path = "../../../tools/asperity/src/input/fif_system.rs"]
#[allow(dead_code, reason = "the builder's own, of which the parsers are called")]
pub(crate) mod fif_system;
#[path = "../../../tools/asperity/src/input/images.rs"]
pub(crate) mod images;
#[path = "../../../tools/asperity/src/input/words.rs"]
pub(crate) mod words;
