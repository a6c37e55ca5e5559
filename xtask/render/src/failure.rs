//! Errors that stop a picture.

use std::error::Error;

/// Any error that stops a picture; its `Display` is one line for the user.
pub type Failure = Box<dyn Error + Send + Sync>;

/// The user pressed Ctrl-C.
#[derive(Debug)]
pub struct Interrupted;

impl std::fmt::Display for Interrupted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("interrupted; nothing half-written was left, run the same command to go on")
    }
}

impl Error for Interrupted {}
