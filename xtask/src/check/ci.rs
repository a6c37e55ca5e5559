//! `cargo xtask ci`: every gate that stands between a change and `main`.

use std::{
    path::Path,
    process::Command,
    sync::atomic::{AtomicBool, Ordering},
    time::Instant,
};

use cargo_metadata::MetadataCommand;

use super::{
    bare_metal,
    cargo::{cargo, cargo_program, cargo_with},
    no_std, tidy,
};
use crate::{
    failure::{Failure, Interrupted},
    progress, tables,
};

pub(crate) const CRATES: [&str; 4] =
    ["asperity-noise", "asperity-ndf-sampling", "asperity-fif", "asperity-shading"];

/// The feature sets that `cargo test --workspace` does not have: there every feature of a crate is on, and `libm` wins.
const SETS: [(&str, &[&str]); 4] = [
    // The noise's bits must not depend on lanes either; the other crates own tables where they may allocate.
    ("asperity-noise", &["std", "std,simd", "libm", "libm,alloc,simd"]),
    ("asperity-ndf-sampling", &["std,alloc,simd", "libm,alloc,simd", "libm"]),
    ("asperity-fif", &["std,alloc,simd", "libm,alloc,simd", "libm"]),
    ("asperity-shading", &["std,alloc", "libm,alloc", "libm"]),
];

/// The least of features with which a crate is linted: one backend, and the traits of `approx` without std.
const LEAST: [&str; 2] = ["std", "libm,approx"];

/// Tests and benches that are built many times and run once are not optimised.
const QUICK: [(&str, &str); 1] = [("CARGO_PROFILE_TEST_OPT_LEVEL", "0")];

type Gate = (&'static str, fn(&Path) -> Result<(), Failure>);

const GATES: [Gate; 10] = [
    ("format", |root| cargo(root, &["fmt", "--all", "--check"])),
    ("tidy", |_| tidy()),
    ("generated tables", tables::check),
    ("clippy", clippy),
    ("no float backend is one clear error", neither_backend),
    ("docs", |root| {
        let arguments = ["doc", "--workspace", "--no-deps", "--document-private-items", "--quiet"];
        cargo_with(root, &arguments, &[("RUSTDOCFLAGS", "-D warnings")])
    }),
    ("tests under each feature set", tests),
    ("examples and benches", examples_and_benches),
    ("no_std probe", |root| no_std::probe(root).map(|line| progress::say(&format!("  {line}")))),
    ("bare-metal probe", |root| bare_metal::probe(root).map(|line| progress::say(&format!("  {line}")))),
];

/// Runs the gates whose names contain one of `only`, or all, in order, and stops at the first that fails.
pub(crate) fn run(only: &[String], root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    let wanted = |name: &str| only.is_empty() || only.iter().any(|part| name.contains(part.as_str()));
    if !GATES.iter().any(|(name, _)| wanted(name)) {
        return Err(format!(
            "no gate's name contains it; gates are {}",
            GATES.map(|(name, _)| name).join(", ")
        )
        .into());
    }
    let all = Instant::now();
    for (name, gate) in GATES.into_iter().filter(|(name, _)| wanted(name)) {
        if interrupted.load(Ordering::Relaxed) {
            return Err(Interrupted.into());
        }
        let start = Instant::now();
        gate(root).map_err(|error| format!("gate `{name}`: {error}"))?;
        progress::say(&format!("ok {name:<38} {:6.1} s", start.elapsed().as_secs_f64()));
    }
    progress::say(&format!("every gate passed in {:.1} s", all.elapsed().as_secs_f64()));
    Ok(())
}

fn tidy() -> Result<(), Failure> {
    let offences = tidy::report()?.offences;
    if offences.is_empty() { Ok(()) } else { Err(offences.join("\n").into()) }
}

fn clippy(root: &Path) -> Result<(), Failure> {
    cargo(root, &["clippy", "--workspace", "--all-targets", "--quiet", "--", "-D", "warnings"])?;
    for name in CRATES {
        for features in LEAST {
            let features = ["clippy", "--package", name, "--no-default-features", "--features", features];
            cargo(root, &[&features[..], &["--quiet", "--", "-D", "warnings"]].concat())?;
        }
    }
    Ok(())
}

fn neither_backend(root: &Path) -> Result<(), Failure> {
    for name in CRATES {
        let output = Command::new(cargo_program())
            .args(["check", "--quiet", "--package", name, "--no-default-features"])
            .current_dir(root)
            .output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.success() || !said.contains("needs a float backend") {
            return Err(format!("{name} without `std` or `libm` must fail and name both").into());
        }
    }
    Ok(())
}

/// Unit and golden tests under each set; examples in docs run with all features in the workspace's tests, and here with
/// those that a user has by default.
fn tests(root: &Path) -> Result<(), Failure> {
    for (name, sets) in SETS {
        for set in sets {
            let features = ["--no-default-features", "--features", set];
            cargo_with(
                root,
                &[&["test", "--quiet", "--package", name, "--tests"], &features[..]].concat(),
                &QUICK,
            )?;
        }
        cargo_with(root, &["test", "--quiet", "--package", name, "--doc"], &QUICK)?;
    }
    Ok(())
}

/// Every example runs, and every bench measures once.
fn examples_and_benches(root: &Path) -> Result<(), Failure> {
    let metadata = MetadataCommand::new().no_deps().other_options(vec!["--locked".into()]).exec()?;
    for package in metadata.packages.iter().filter(|package| CRATES.contains(&package.name.as_str())) {
        cargo_with(root, &["test", "--quiet", "--package", &package.name, "--benches"], &QUICK)?;
        for target in package.targets.iter().filter(|target| target.is_example()) {
            let run = [
                "run",
                "--quiet",
                "--profile",
                "test",
                "--package",
                &package.name,
                "--example",
                &target.name,
            ];
            cargo(root, &run)?;
        }
    }
    Ok(())
}
