//! `cargo xtask bare-metal`: the golden bits of noise on an emulated Cortex-M4, or what is missing for that.

use std::{ffi::OsString, path::Path, process::Command};

use super::cargo::{cargo_program, run};
use crate::failure::Failure;

const TARGET: &str = "thumbv7em-none-eabihf";
const EMULATOR: &str = "qemu-system-arm";
/// Arm's board MPS2 with the image AN386, a Cortex-M4 with a unit for single precision.
const MACHINE: &str =
    "-cpu cortex-m4 -machine mps2-an386 -nographic -semihosting-config enable=on,target=native -kernel";

/// A cargo and a rustc that can build for the target.
struct Toolchain {
    cargo: OsString,
    rustc: OsString,
    /// Without a core library for the target, but with its sources.
    builds_core: bool,
}

/// Builds the probe in `tests/bare-metal` and runs it in an emulator; says why, where it cannot.
pub(crate) fn probe(root: &Path) -> Result<String, Failure> {
    let Some(toolchain) = toolchain() else {
        return Ok(format!(
            "skipped: no toolchain has a core library for {TARGET}, or its sources and ld.lld; \
             `rustup target add {TARGET}` adds it"
        ));
    };
    if output(Command::new(EMULATOR).arg("--version")).is_none() {
        return Ok(format!("skipped: {EMULATOR} is not installed"));
    }
    let folder = root.join("tests/bare-metal");
    let mut build = Command::new(toolchain.cargo);
    build
        .args(["build", "--quiet", "--locked", "--release", "--target", TARGET])
        .current_dir(&folder)
        .env("RUSTC", toolchain.rustc)
        .env_remove("RUSTUP_TOOLCHAIN")
        .env_remove("CARGO_TARGET_DIR");
    let mut flags = String::from("-C link-arg=-Tlink.x");
    if toolchain.builds_core {
        build.arg("-Zbuild-std=core").env("RUSTC_BOOTSTRAP", "1");
        flags += " -C linker=ld.lld -C linker-flavor=ld.lld";
    }
    run(build.env("RUSTFLAGS", flags)).map_err(|error| format!("the bare-metal probe: {error}"))?;
    let program = folder.join("target").join(TARGET).join("release/golden");
    let output = Command::new(EMULATOR).args(MACHINE.split(' ')).arg(&program).output()?;
    let said = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    if output.status.success() {
        Ok(format!("on an emulated Cortex-M4 {said} ({TARGET})"))
    } else {
        Err(format!("on an emulated Cortex-M4 bits are others:\n{said}").into())
    }
}

/// The toolchain that runs this program, or the system's, whichever can build for the target.
fn toolchain() -> Option<Toolchain> {
    let own = cargo_program();
    let beside = Path::new(&own).with_file_name("rustc").into_os_string();
    let candidates = [(own, beside), ("/usr/bin/cargo".into(), "/usr/bin/rustc".into())];
    let has_linker = output(Command::new("ld.lld").arg("--version")).is_some();
    candidates.into_iter().find_map(|(cargo, rustc)| {
        let print = |what: &str| output(Command::new(&rustc).args(["--print", what, "--target", TARGET]));
        let (libraries, sysroot) = (print("target-libdir")?, print("sysroot")?);
        let has_core = Path::new(&libraries).read_dir().is_ok_and(|mut files| {
            files.any(|file| file.is_ok_and(|f| f.file_name().to_string_lossy().starts_with("libcore")))
        });
        let has_sources = Path::new(&sysroot).join("lib/rustlib/src/rust/library/core").is_dir();
        (has_core || has_sources && has_linker).then_some(Toolchain { cargo, rustc, builds_core: !has_core })
    })
}

/// The output of a command, if it can be run and succeeds.
fn output(command: &mut Command) -> Option<String> {
    let output = command.output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
