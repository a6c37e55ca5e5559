//! Runs the cargo that runs this program.

use std::{
    ffi::OsString,
    path::Path,
    process::{Command, Stdio},
};

use crate::failure::Failure;

/// Returns the cargo that runs this program.
pub(crate) fn cargo_program() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Returns a cargo command in a folder, from space-separated arguments.
pub(crate) fn cargo(folder: &Path, words: &str) -> Command {
    let mut command = Command::new(cargo_program());
    command.args(words.split(' ')).current_dir(folder).stdin(Stdio::null());
    command
}

/// Runs a command to completion.
pub(crate) fn run(command: &mut Command) -> Result<(), Failure> {
    let cause = match command.status() {
        Ok(status) if status.success() => return Ok(()),
        Ok(_) => "failed".to_owned(),
        Err(error) => format!("cannot run: {error}"),
    };
    let program = Path::new(command.get_program()).file_stem().unwrap_or_default();
    let words = std::iter::once(program).chain(command.get_args()).map(|word| word.to_string_lossy());
    Err(format!("`{}` {cause}", words.collect::<Vec<_>>().join(" ")).into())
}
