//! `cargo xtask bare-metal`: the golden bits of noise on an emulated Cortex-M4, or what is missing for that.

use std::{path::Path, process::Command};

use crate::cargo::run;
use crate::failure::Failure;
use crate::toolchain::{Toolchain, output};

const TARGET: &str = "thumbv7em-none-eabihf";
const EMULATOR: &str = "qemu-system-arm";
/// Arm's board MPS2 with the image AN386, a Cortex-M4 with a unit for single precision.
const MACHINE: &str =
    "-cpu cortex-m4 -machine mps2-an386 -nographic -semihosting-config enable=on,target=native -kernel";

/// Builds the probe in `tests/bare-metal` and runs it in an emulator; says why, where it cannot.
pub(crate) fn probe(root: &Path) -> Result<String, Failure> {
    let has_linker = output(Command::new("ld.lld").arg("--version")).is_some();
    let Some(toolchain) = Toolchain::of(TARGET, has_linker) else {
        return Ok(format!(
            "skipped: no toolchain has a core library for {TARGET}, or its sources and ld.lld; \
             `rustup target add {TARGET}` adds it"
        ));
    };
    if output(Command::new(EMULATOR).arg("--version")).is_none() {
        return Ok(format!("skipped: {EMULATOR} is not installed"));
    }
    let folder = root.join("tests/bare-metal");
    let mut flags = String::from("-C link-arg=-Tlink.x");
    if toolchain.builds_core {
        flags += " -C linker=ld.lld -C linker-flavor=ld.lld";
    }
    run(toolchain.build(&folder, TARGET, "core").env("RUSTFLAGS", flags))
        .map_err(|error| format!("the bare-metal probe: {error}"))?;
    let program = folder.join("target").join(TARGET).join("release/golden");
    let output = Command::new(EMULATOR).args(MACHINE.split(' ')).arg(&program).output()?;
    let said = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    if output.status.success() {
        Ok(format!("on an emulated Cortex-M4 {said} ({TARGET})"))
    } else {
        Err(format!("on an emulated Cortex-M4 bits are others:\n{said}").into())
    }
}
