//! Prints messages and writes files of the repository.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use crate::failure::Result;

/// Prints one line to standard output; a closed pipe is not an error.
pub(crate) fn say(line: &str) {
    let _ = writeln!(io::stdout().lock(), "{line}");
}

/// Writes a file of the repository and prints its path.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    fs::write(path, bytes).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    say(&format!("wrote {}", path.display()));
    Ok(())
}
