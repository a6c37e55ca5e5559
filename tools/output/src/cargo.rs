//! Programs of the repository that are built and run by cargo, and the drivers that `tests/gpu` finds.

use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

/// Folder of the program that has wgpu and naga.
pub const SHADERS: &str = "tests/gpu";

/// The variable that names manifests of further Vulkan drivers, and that of Chromium's driver in software on Debian.
const DRIVERS: &str = "VK_ADD_DRIVER_FILES";
const SWIFTSHADER: &str = "/usr/lib/chromium/vk_swiftshader_icd.json";

/// Variable of a folder whose lack Mesa complains of.
const RUNTIME: &str = "XDG_RUNTIME_DIR";

/// The cargo that runs this program.
#[must_use]
pub fn cargo_program() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// A command of cargo in a folder: its words with spaces between.
#[must_use]
pub fn cargo(folder: &Path, words: &str) -> Command {
    let mut command = Command::new(cargo_program());
    command.args(words.split(' ')).current_dir(folder).stdin(Stdio::null());
    command
}

/// Runs a command to its end.
///
/// # Errors
/// The command's words, in one line, if it fails or cannot be run.
pub fn run(command: &mut Command) -> io::Result<()> {
    let cause = match command.status() {
        Ok(status) if status.success() => return Ok(()),
        Ok(_) => "failed".to_owned(),
        Err(error) => format!("cannot be run: {error}"),
    };
    let program = Path::new(command.get_program()).file_stem().unwrap_or_default();
    let words = std::iter::once(program).chain(command.get_args()).map(|word| word.to_string_lossy());
    Err(io::Error::other(format!("`{}` {cause}", words.collect::<Vec<_>>().join(" "))))
}

/// The program in [`SHADERS`] with a command, and with the drivers in software that are installed.
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
