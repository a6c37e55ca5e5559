//! `cargo xtask web`: builds the live page from the crates as a WebAssembly module and from their
//! shaders.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::cli::Web;
use crate::failure::Failure;
use crate::report::say;
use crate::toolchain::{Toolchain, output, rust_lld};
use asperity_output::cargo::{self, cargo, shaders};

const TARGET: &str = "wasm32-unknown-unknown";
const LINKER: &str = "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER";
/// Folder of the page's workspace.
const FOLDER: &str = "web";
const TARGETS: &str = "target/module";

/// Builds the page, and serves it if requested.
pub(crate) fn run(wanted: &Web, root: &Path) -> Result<(), Failure> {
    let out = folder(&wanted.out)?;
    let module = module(root)?;
    say("building the page's shaders in both languages");
    let mut build = builder(root, "build");
    cargo::run(build.arg("--wasm").arg(module).arg("--out").arg(&out))?;
    let Some(port) = wanted.serve else { return Ok(()) };
    let mut serve = builder(root, "serve");
    cargo::run(serve.arg(out.join("hosted")).arg("--port").arg(port.to_string()))?;
    Ok(())
}

/// CI check: builds the page and checks its size. In headless Chromium the page renders with both
/// GPU interfaces, matches the crates and tolerates invalid input. The code snippets of the page
/// run. Gallery drawings look the same alone and in the pages. Prints one line per result or
/// missing tool.
pub(crate) fn in_browsers(root: &Path) -> Result<(), Failure> {
    let tell = |line: &str| say(&format!("  {line}"));
    cargo::run(&mut cargo(&root.join(FOLDER), "test --quiet --locked"))?;
    let module = match module(root) {
        Ok(module) => module,
        Err(why) => {
            tell(&format!("skipped: {why}"));
            return Ok(());
        }
    };
    let out = root.join("target/asperity/web");
    told(builder(root, "build").arg("--wasm").arg(module).arg("--out").arg(&out))?.lines().for_each(tell);
    let browser = root.join(FOLDER).join("browser");
    let installed = browser.join("node_modules").is_dir()
        || output(Command::new("npm").args(["ci", "--no-audit", "--no-fund"]).current_dir(&browser))
            .is_some();
    if !installed || output(Command::new("node").arg("--version")).is_none() {
        tell("skipped: node or the packages of web/browser/package.json are missing, and `npm ci` failed");
        return Ok(());
    }
    let screens = out.join("screens");
    let node = |script: &str| {
        let mut node = Command::new("node");
        node.arg(browser.join(script));
        node
    };
    let checked = told(node("check.mjs").arg(&out).arg(&screens))?;
    checked.lines().last().into_iter().for_each(tell);
    if checked.starts_with("skipped") {
        return Ok(());
    }
    let snippets = out.join("snippets.rs");
    told(node("snippets.mjs").arg(&out).arg(&snippets))?.lines().for_each(tell);
    let run = "run --quiet --locked --package asperity-web-snippets --message-format short";
    told(cargo(&root.join(FOLDER), run).env("ASPERITY_SNIPPETS", &snippets))?;
    told(node("others.mjs").arg(&out).arg(&screens))?.lines().for_each(tell);
    told(shaders(root, "page").arg(&screens))?.lines().for_each(tell);
    let gallery = root.join("target/asperity/drawings");
    // Minimal renders; drawings keep their size. Means over zooms take as long as all others
    // together, so the rest omit them.
    let mut draw = cargo(root, "run --quiet --profile tools --package asperity-gallery --");
    draw.args(["--quality", "draft", "--size", "32", "--spp", "1", "--out"]).arg(&gallery);
    for figures in ["asperity-mean-radiance", "cochran", "ndf", "noise"] {
        draw.args(["--only", figures]);
    }
    told(&mut draw)?;
    told(node("drawings.mjs").arg(gallery.join("gallery")))?.lines().for_each(tell);
    let wgsl = root.join("target/asperity/wgsl");
    told(shaders(root, "export").args(["--dialect", "wgsl", "--out"]).arg(&wgsl))?;
    told(node("tint.mjs").arg(&wgsl))?.lines().for_each(tell);
    Ok(())
}

/// Returns the output of a command, or an error with its output.
fn told(command: &mut Command) -> Result<String, Failure> {
    let output = command.stderr(Stdio::inherit()).output()?;
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        Ok(said)
    } else {
        Err(format!("the live page or a gallery drawing failed its check:\n{said}").into())
    }
}

/// Builds the crates' module with a toolchain for the target.
fn module(root: &Path) -> Result<PathBuf, Failure> {
    let linker = rust_lld();
    let Some(toolchain) = Toolchain::of(TARGET, linker.is_some()) else {
        return Err(format!(
            "no toolchain has the libraries for {TARGET} (install with `rustup target add {TARGET}`)"
        )
        .into());
    };
    say("building the crates as a WebAssembly module (some minutes the first time)");
    let folder = root.join(FOLDER);
    let mut build = toolchain.build(&folder, TARGET, "core,alloc");
    build
        .args(["--package", "asperity-web-tables", "--lib", "--target-dir", TARGETS])
        // Panic messages contain file names. Remapped, the page does not depend on the build
        // folder.
        .env(
            "CARGO_ENCODED_RUSTFLAGS",
            format!("-Ctarget-feature=+simd128\u{1f}--remap-path-prefix={}=", root.display()),
        )
        // Optimized for size in one codegen unit, unlike builds of the page builder.
        .env("CARGO_PROFILE_RELEASE_LTO", "true")
        .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "1")
        .env("CARGO_PROFILE_RELEASE_STRIP", "true")
        .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "s");
    if let Some(linker) = linker.as_ref().filter(|_| toolchain.builds_core) {
        build.env(LINKER, linker);
    }
    cargo::run(&mut build)?;
    Ok(folder.join(TARGETS).join(TARGET).join("release/asperity_web_tables.wasm"))
}

/// Returns a command of the page builder.
fn builder(root: &Path, command: impl AsRef<OsStr>) -> Command {
    let mut run = cargo(&root.join(FOLDER), "run --quiet --locked --package asperity-web --");
    run.arg(command);
    run
}

fn folder(path: &Path) -> Result<PathBuf, Failure> {
    std::fs::create_dir_all(path).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok(std::path::absolute(path)?)
}
