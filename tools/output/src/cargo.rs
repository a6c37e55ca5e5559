//! Runs programs of this repository with cargo, and finds drivers for `tests/gpu`.

use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

/// Folder of the program that uses wgpu and naga.
pub const SHADERS: &str = "tests/gpu";

/// Variable with manifests of additional Vulkan drivers, and the path of Chromium's software driver
/// on Debian.
const DRIVERS: &str = "VK_ADD_DRIVER_FILES";
const SWIFTSHADER: &str = "/usr/lib/chromium/vk_swiftshader_icd.json";

/// Variable of a folder whose absence makes Mesa print a warning.
const RUNTIME: &str = "XDG_RUNTIME_DIR";

/// Returns the cargo that runs this program.
#[must_use]
pub fn cargo_program() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Returns a cargo command in a folder, from space-separated arguments.
#[must_use]
pub fn cargo(folder: &Path, words: &str) -> Command {
    let mut command = Command::new(cargo_program());
    command.args(words.split(' ')).current_dir(folder).stdin(Stdio::null());
    command
}

/// Runs a command to completion.
///
/// # Errors
///
/// Returns the command in one line if it fails or cannot run.
pub fn run(command: &mut Command) -> io::Result<()> {
    let cause = match command.status() {
        Ok(status) if status.success() => return Ok(()),
        Ok(_) => "failed".to_owned(),
        Err(error) => format!("cannot run: {error}"),
    };
    let program = Path::new(command.get_program()).file_stem().unwrap_or_default();
    let words = std::iter::once(program).chain(command.get_args()).map(|word| word.to_string_lossy());
    Err(io::Error::other(format!("`{}` {cause}", words.collect::<Vec<_>>().join(" "))))
}

/// Returns a command of the program in [`SHADERS`], with the installed software drivers.
#[must_use]
pub fn shaders(root: &Path, command: &str) -> Command {
    let mut run = cargo(&root.join(SHADERS), "run --quiet --release --locked --");
    run.arg(command);
    if std::env::var_os(DRIVERS).is_none() && Path::new(SWIFTSHADER).is_file() {
        run.env(DRIVERS, SWIFTSHADER);
    }
    if std::env::var_os(RUNTIME).is_none() {
        run.env(RUNTIME, std::env::temp_dir());
    }
    run
}
