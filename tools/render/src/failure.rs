//! Errors that stop a picture.

use std::error::Error;
use std::sync::atomic::{AtomicBool, Ordering};

/// Any error that stops a picture; its `Display` is one line for the user.
pub type Failure = Box<dyn Error + Send + Sync>;

/// The user pressed Ctrl-C.
#[derive(Debug, thiserror::Error)]
#[error("interrupted; nothing half-written was left, run the same command to go on")]
pub struct Interrupted;

impl Interrupted {
    /// An error once the flag is up that Ctrl-C raises; long loops ask once a row.
    pub fn check(flag: &AtomicBool) -> Result<(), Self> {
        if flag.load(Ordering::Relaxed) { Err(Self) } else { Ok(()) }
    }
}
