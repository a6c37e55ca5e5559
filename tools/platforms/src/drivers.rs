//! The program that has wgpu and naga, run on the drivers that there are.

use std::path::Path;
use std::process::Command;

use crate::cargo::cargo;

/// Folder of the program that has wgpu and naga.
pub(crate) const PROGRAM: &str = "tests/gpu";

/// The variable that names manifests of further Vulkan drivers, and that of Chromium's driver in software on Debian.
const DRIVERS: &str = "VK_ADD_DRIVER_FILES";
const SWIFTSHADER: &str = "/usr/lib/chromium/vk_swiftshader_icd.json";

/// Variable of a folder whose lack Mesa complains of.
const RUNTIME: &str = "XDG_RUNTIME_DIR";

/// The program in `tests/gpu` with a command, and with the drivers in software that are installed.
pub(crate) fn program(root: &Path, command: &str) -> Command {
    let mut run = cargo(&root.join(PROGRAM), "run --quiet --release --locked --");
    run.arg(command);
    with_drivers(&mut run);
    run
}

/// Names the drivers in software that are installed.
pub(crate) fn with_drivers(run: &mut Command) {
    if std::env::var_os(DRIVERS).is_none() && Path::new(SWIFTSHADER).is_file() {
        run.env(DRIVERS, SWIFTSHADER);
    }
    if std::env::var_os(RUNTIME).is_none() {
        run.env(RUNTIME, std::env::temp_dir());
    }
}
