//! Input parsing of the command line tool.

#[path = "../../../tools/asperity/src/input/density.rs"]
#[allow(dead_code, reason = "part of the tool; only the parsers are called")]
pub(crate) mod density;
#[path = "../../../tools/asperity/src/input/fif_system.rs"]
#[allow(dead_code, reason = "part of the tool; only the parsers are called")]
pub(crate) mod fif_system;
#[path = "../../../tools/asperity/src/input/images.rs"]
pub(crate) mod images;
#[path = "../../../tools/asperity/src/input/words.rs"]
pub(crate) mod words;
