//! Errors that stop a render.

use std::error::Error;
use std::sync::atomic::{AtomicBool, Ordering};

/// Any error that stops a render. Its `Display` is one line for the user.
pub type Failure = Box<dyn Error + Send + Sync>;

/// The user pressed Ctrl-C.
#[derive(Debug, thiserror::Error)]
#[error("interrupted; no partial files remain (run the same command to resume)")]
pub struct Interrupted;

impl Interrupted {
    /// Returns an error once Ctrl-C has set the flag. Long loops check it once per row.
    pub fn check(flag: &AtomicBool) -> Result<(), Self> {
        if flag.load(Ordering::Relaxed) { Err(Self) } else { Ok(()) }
    }
}
