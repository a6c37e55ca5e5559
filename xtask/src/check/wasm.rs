//! `cargo xtask wasm`: the bits of every crate in a WebAssembly module, or what is missing for that.

use std::{path::Path, process::Command};

use crate::cargo::{cargo, run};
use crate::failure::Failure;
use crate::toolchain::{Toolchain, output, rust_lld};

const TARGET: &str = "wasm32-unknown-unknown";
const LINKER: &str = "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER";
/// Targets of a module, with the folders of their builds.
const MODULES: [(&str, &str, &str); 2] = [
    ("without SIMD128", "", "target/wasm"),
    ("with SIMD128", "-C target-feature=+simd128", "target/wasm128"),
];

/// Builds the probe in `tests/wasm` for this machine and as modules, and compares what they say; says why, where it cannot.
pub(crate) fn probe(root: &Path) -> Result<String, Failure> {
    let linker = rust_lld();
    let Some(toolchain) = Toolchain::of(TARGET, linker.is_some()) else {
        return Ok(format!(
            "skipped: no toolchain has the libraries for {TARGET}; `rustup target add {TARGET}` adds them"
        ));
    };
    if output(Command::new("node").arg("--version")).is_none() {
        return Ok("skipped: node is not installed".into());
    }
    let folder = root.join("tests/wasm");
    let mut here = cargo(&folder, "run --quiet --locked --release");
    let here = output(here.env_remove("CARGO_TARGET_DIR")).ok_or("the probe of wasm does not run here")?;
    if let Some(line) =
        here.lines().find(|line| line.contains("other than golden") || line.contains("refused"))
    {
        return Err(format!("the probe of wasm here: {line}").into());
    }
    for (name, flags, target) in MODULES {
        let mut build = toolchain.build(&folder, TARGET, "core,alloc");
        build.args(["--lib", "--features", "simd", "--target-dir", target]).env("RUSTFLAGS", flags);
        if let Some(linker) = linker.as_ref().filter(|_| toolchain.builds_core) {
            build.env(LINKER, linker);
        }
        run(&mut build).map_err(|error| format!("the probe of wasm {name}: {error}"))?;
        let module = folder.join(target).join(TARGET).join("release/asperity_wasm.wasm");
        let node = Command::new("node").arg(folder.join("run.mjs")).arg(module).output()?;
        let said = String::from_utf8_lossy(&node.stdout);
        if !node.status.success() {
            return Err(format!("wasm {name}: {}", String::from_utf8_lossy(&node.stderr)).into());
        }
        if let Some(difference) = first_difference(&here, &said) {
            return Err(format!("wasm {name}: {difference}").into());
        }
    }
    Ok(format!(
        "{} functions of all four crates have this machine's bits on wasm32, with and without SIMD128, golden ones included",
        here.lines().count()
    ))
}

/// The first line that is not the same in both.
fn first_difference(here: &str, there: &str) -> Option<String> {
    let (mut here, mut there) = (here.lines(), there.lines());
    loop {
        match (here.next(), there.next()) {
            (None, None) => return None,
            (a, b) if a == b => {}
            (a, b) => return Some(format!("`{}`, here `{}`", b.unwrap_or_default(), a.unwrap_or_default())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_differs_or_is_missing_is_found() {
        assert_eq!(first_difference("a 1\nb 2", "a 1\nb 2\n"), None);
        assert_eq!(first_difference("a 1\nb 2", "a 1\nb 3"), Some("`b 3`, here `b 2`".into()));
        assert_eq!(first_difference("a 1\nb 2", "a 1"), Some("``, here `b 2`".into()));
    }
}
