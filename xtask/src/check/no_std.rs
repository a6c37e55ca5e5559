//! `cargo xtask no-std`: a program without std, without an allocator, that calls every crate.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use super::cargo::cargo_program;
use crate::failure::Failure;

/// Builds and, where the platform allows it, links and runs the probe in `tests/no-std`.
pub(crate) fn probe(root: &Path) -> Result<String, Failure> {
    let folder = root.join("tests/no-std");
    let cargo = |failed: &str, arguments: &[&str]| -> Result<(), Failure> {
        let status = Command::new(cargo_program())
            .args(arguments)
            .current_dir(&folder)
            .env_remove("CARGO_TARGET_DIR")
            .env_remove("RUSTFLAGS")
            .status()?;
        if status.success() { Ok(()) } else { Err(format!("the no_std probe does not {failed}").into()) }
    };
    // A library that links std anywhere below it fails here with a duplicate panic handler, on every platform.
    cargo("check without std", &["check", "--quiet", "--locked", "--release", "--lib"])?;
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Ok("the no_std probe checks without std".into());
    }
    // A static program with its own entry point and no allocator: whatever is not there cannot be called.
    let build =
        ["rustc", "--quiet", "--locked", "--release", "--bin", "probe", "--features", "program", "--"];
    let link =
        ["link-arg=-nostartfiles", "link-arg=-nostdlib", "link-arg=-static", "relocation-model=static"];
    let link: Vec<&str> = link.iter().flat_map(|flag| ["-C", flag]).collect();
    cargo("link without std", &[&build[..], &link].concat())?;
    let program: PathBuf = folder.join("target/release/probe");
    let code = Command::new(&program).status()?.code();
    match code {
        Some(0) => Ok(format!(
            "the no_std probe links without std or allocator, and its calls into all four crates agree ({} bytes)",
            std::fs::metadata(&program)?.len()
        )),
        code => {
            Err(format!("the no_std probe ended with {code:?}: its exit code names the crate that disagrees")
                .into())
        }
    }
}
