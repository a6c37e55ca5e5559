//! `cargo xtask no-std`: a program without std and allocator that calls every crate.

use std::{path::Path, process::Command};

use crate::failure::Failure;
use crate::toolchain::Toolchain;
use asperity_output::cargo::{cargo, run};

/// A Cortex-M0, which has no atomic pointers: `alloc::sync` does not exist there.
const WITHOUT_ATOMIC_POINTERS: &str = "thumbv6m-none-eabi";

/// Builds the probe in `tests/no-std`, links and runs it where the platform permits, then checks it
/// for a small target.
pub(crate) fn probe(root: &Path) -> Result<String, Failure> {
    Ok(format!("{}; {}", linked(root)?, without_atomic_pointers(root)?))
}

fn linked(root: &Path) -> Result<String, Failure> {
    let folder = root.join("tests/no-std");
    let build = |words: &str| {
        run(cargo(&folder, words).env_remove("CARGO_TARGET_DIR").env_remove("RUSTFLAGS"))
            .map_err(|error| format!("the no_std probe: {error}"))
    };
    // A library that links std fails here with a duplicate panic handler, on every platform.
    build("check --quiet --locked --release --lib")?;
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Ok("the no_std probe compiles without std".into());
    }
    // A static program with a custom entry point and without allocator: missing symbols cannot be
    // called.
    build(
        "rustc --quiet --locked --release --bin probe --features program -- -C link-arg=-nostartfiles \
         -C link-arg=-nostdlib -C link-arg=-static -C relocation-model=static",
    )?;
    let program = folder.join("target/release/probe");
    match Command::new(&program).status()?.code() {
        Some(0) => Ok(format!(
            "the no_std probe links without std and allocator, and all five crates return the expected values ({} bytes)",
            std::fs::metadata(&program)?.len()
        )),
        code => {
            Err(format!("the no_std probe failed with {code:?} (the exit code identifies the crate)").into())
        }
    }
}

/// Checks every crate with `alloc` for a target without atomic pointers, if a toolchain supports
/// it.
fn without_atomic_pointers(root: &Path) -> Result<String, Failure> {
    let target = WITHOUT_ATOMIC_POINTERS;
    // A check does not link.
    let Some(toolchain) = Toolchain::of(target, true) else {
        return Ok(format!(
            "skipped {target}: no toolchain has its libraries or sources (install with `rustup target add {target}`)"
        ));
    };
    let mut check = toolchain.check(&root.join("tests/no-std"), target, "core,alloc");
    run(check.args(["--lib", "--features", "alloc"])).map_err(|error| format!("{target}: {error}"))?;
    Ok(format!("every crate compiles with `libm` and `alloc` for {target}, which has no atomic pointers"))
}
