//! Errors that stop a picture.

use std::error::Error;
use std::sync::atomic::{AtomicBool, Ordering};

/// Any error that stops a picture; its `Display` is one line for the user.
pub type Failure = Box<dyn Error + Send + Sync>;

/// The user pressed Ctrl-C.
#[derive(Debug)]
pub struct Interrupted;

impl Interrupted {
    /// An error once the flag is up that Ctrl-C raises; long loops ask once a row.
    pub fn check(flag: &AtomicBool) -> Result<(), Self> {
        if flag.load(Ordering::Relaxed) { Err(Self) } else { Ok(()) }
    }
}

impl std::fmt::Display for Interrupted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("interrupted; nothing half-written was left, run the same command to go on")
    }
}

impl Error for Interrupted {}
