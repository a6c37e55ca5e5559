//! The cargo that runs this program, run by it.

use std::{
    ffi::OsString,
    path::Path,
    process::{Command, Stdio},
};

use crate::failure::Failure;

/// The cargo that runs this program.
pub(crate) fn cargo_program() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Runs cargo on the workspace.
pub(crate) fn cargo(root: &Path, arguments: &[&str]) -> Result<(), Failure> {
    cargo_with(root, arguments, &[])
}

/// Runs cargo on the workspace with more in its environment.
pub(crate) fn cargo_with(
    root: &Path,
    arguments: &[&str],
    environment: &[(&str, &str)],
) -> Result<(), Failure> {
    let status = Command::new(cargo_program())
        .args(arguments)
        .current_dir(root)
        .envs(environment.iter().copied())
        .stdin(Stdio::null())
        .status()?;
    if status.success() { Ok(()) } else { Err(format!("`cargo {}` failed", arguments.join(" ")).into()) }
}
