//! Errors that stop a command: any error whose `Display` is one line for the user.

use std::{error::Error, fmt};

/// Any error that stops a command; its `Display` is one line for the user.
pub(crate) type Failure = Box<dyn Error + Send + Sync>;

/// The user pressed Ctrl-C.
#[derive(Debug)]
pub(crate) struct Interrupted;

impl fmt::Display for Interrupted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("interrupted; nothing half-written was left, run the same command to go on")
    }
}

impl Error for Interrupted {}
