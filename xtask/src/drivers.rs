//! Runs the program that uses wgpu and naga on the available drivers.

use std::path::Path;
use std::process::Command;

use crate::cargo::cargo;

/// Folder of the program that uses wgpu and naga.
pub(crate) const PROGRAM: &str = "tests/gpu";

/// Variable with manifests of additional Vulkan drivers, and the path of Chromium's software driver
/// on Debian.
const DRIVERS: &str = "VK_ADD_DRIVER_FILES";
const SWIFTSHADER: &str = "/usr/lib/chromium/vk_swiftshader_icd.json";

/// Variable of a folder whose absence makes Mesa print a warning.
const RUNTIME: &str = "XDG_RUNTIME_DIR";

/// Returns a command of the program in `tests/gpu`, with the installed software drivers.
pub(crate) fn program(root: &Path, command: &str) -> Command {
    let mut run = cargo(&root.join(PROGRAM), "run --quiet --release --locked --");
    run.arg(command);
    with_drivers(&mut run);
    run
}

/// Adds the installed software drivers.
pub(crate) fn with_drivers(run: &mut Command) {
    if std::env::var_os(DRIVERS).is_none() && Path::new(SWIFTSHADER).is_file() {
        run.env(DRIVERS, SWIFTSHADER);
    }
    if std::env::var_os(RUNTIME).is_none() {
        run.env(RUNTIME, std::env::temp_dir());
    }
}
