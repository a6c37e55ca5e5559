//! `cargo xtask ci`: every gate that stands between a change and `main`.

use std::{path::Path, sync::atomic::AtomicBool, time::Instant};

use cargo_metadata::{MetadataCommand, Package};

use super::{bare_metal, dependencies, firmware, no_std, packages, tidy, wasm};
use crate::cargo::{cargo, run};
use crate::failure::{Failure, Interrupted};
use crate::{progress, shaders, tables, web};

/// The crates that compute.
pub(crate) const CRATES: [&str; 4] =
    ["asperity-noise", "asperity-ndf-sampling", "asperity-fif", "asperity-shading"];

/// The crate of shaders, whose examples run too.
const SHADERS: &str = "asperity-shaders";

/// The feature sets that `cargo test --workspace` does not have: there every feature of a crate is on, and `libm` wins.
const SETS: [(&str, &[&str]); 5] = [
    // The noise's bits must not depend on lanes either; the other crates own tables where they may allocate.
    ("asperity-noise", &["std", "std,simd", "libm", "libm,check,simd"]),
    ("asperity-ndf-sampling", &["std,alloc,simd", "libm,check,simd", "libm"]),
    ("asperity-fif", &["std,alloc,simd", "libm,alloc,simd", "libm"]),
    ("asperity-shading", &["std,alloc,simd", "libm,check", "libm"]),
    ("asperity-shaders", &["std", "libm"]),
];

/// The least of features with which a crate is linted: one backend, and the traits of `approx` and `serde` without std.
const LEAST: [&str; 2] = ["std", "libm,approx,serde"];

type Gate = (&'static str, fn(&Path) -> Result<(), Failure>);

const GATES: [Gate; 17] = [
    ("format", |root| run(&mut cargo(root, "fmt --all --check"))),
    ("tidy", |_| tidy::report()?.verdict()),
    ("dependencies", dependencies::dependencies),
    ("generated tables", tables::check),
    ("clippy", clippy),
    ("no float backend is one clear error", neither_backend),
    ("docs", |root| {
        let mut docs = cargo(root, "doc --workspace --no-deps --document-private-items --quiet");
        run(docs.env("RUSTDOCFLAGS", "-D warnings"))
    }),
    ("tests under each feature set", tests),
    ("examples and benches", examples_and_benches),
    ("no_std probe", |root| no_std::probe(root).map(|line| progress::say(&format!("  {line}")))),
    ("oldest glam", packages::oldest_glam),
    ("packages", packages::packages),
    ("wasm probe", |root| wasm::probe(root).map(|line| progress::say(&format!("  {line}")))),
    ("shaders on drivers", shaders::on_drivers),
    ("live page", web::in_browsers),
    ("bare-metal probe", |root| bare_metal::probe(root).map(|line| progress::say(&format!("  {line}")))),
    ("firmware", |root| firmware::check(root).map(|line| progress::say(&format!("  {line}")))),
];

/// Runs the gates whose names contain one of `only`, or all, in order, and stops at the first that fails.
pub(crate) fn gates(only: &[String], root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    let wanted = |name: &str| only.is_empty() || only.iter().any(|part| name.contains(part.as_str()));
    if !GATES.iter().any(|(name, _)| wanted(name)) {
        let names = GATES.map(|(name, _)| name).join(", ");
        return Err(format!("no gate's name contains `{}`; gates are {names}", only.join("` or `")).into());
    }
    let all = Instant::now();
    for (name, gate) in GATES.into_iter().filter(|(name, _)| wanted(name)) {
        Interrupted::check(interrupted)?;
        let start = Instant::now();
        gate(root).map_err(|error| format!("gate `{name}`: {error}"))?;
        progress::say(&format!("ok {name:<38} {:6.1} s", start.elapsed().as_secs_f64()));
    }
    progress::say(&format!("every gate passed in {:.1} s", all.elapsed().as_secs_f64()));
    Ok(())
}

fn clippy(root: &Path) -> Result<(), Failure> {
    let lint = |of: &str| run(&mut cargo(root, &format!("clippy {of} --quiet -- -D warnings")));
    lint("--workspace --all-targets")?;
    CRATES.iter().flat_map(|name| LEAST.map(|features| (name, features))).try_for_each(
        |(name, features)| lint(&format!("--package {name} --no-default-features --features {features}")),
    )?;
    lint("--package asperity-shaders --no-default-features --features libm")
}

fn neither_backend(root: &Path) -> Result<(), Failure> {
    for name in CRATES {
        let output =
            cargo(root, &format!("check --quiet --package {name} --no-default-features")).output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.success() || !said.contains("needs a float backend") {
            return Err(format!("{name} without `std` or `libm` must fail and name both").into());
        }
    }
    Ok(())
}

/// Tests and benches that are built many times and run once are not optimised, as a user's first build.
fn test(root: &Path, name: &str, of: &str) -> Result<(), Failure> {
    let mut test = cargo(root, &format!("test --quiet --package {name} {of}"));
    test.env("CARGO_PROFILE_TEST_OPT_LEVEL", "0").env("CARGO_PROFILE_TEST_DEBUG_ASSERTIONS", "true");
    run(&mut test)
}

/// Unit and golden tests under each set; examples in docs run with all features in the workspace's tests, and here with
/// those that a user has by default.
fn tests(root: &Path) -> Result<(), Failure> {
    for (name, sets) in SETS {
        for set in sets {
            test(root, name, &format!("--tests --no-default-features --features {set}"))?;
        }
        test(root, name, "--doc")?;
    }
    Ok(())
}

/// Every example runs, and every bench measures once.
fn examples_and_benches(root: &Path) -> Result<(), Failure> {
    let metadata = MetadataCommand::new().no_deps().other_options(vec!["--locked".into()]).exec()?;
    let runs =
        |package: &&Package| CRATES.contains(&package.name.as_str()) || package.name.as_str() == SHADERS;
    for package in metadata.packages.iter().filter(runs) {
        let name = &package.name;
        if package.targets.iter().any(cargo_metadata::Target::is_bench) {
            test(root, name, "--benches")?;
        }
        for example in package.targets.iter().filter(|target| target.is_example()) {
            let example = &example.name;
            run(&mut cargo(
                root,
                &format!("run --quiet --profile test --package {name} --example {example}"),
            ))?;
        }
    }
    Ok(())
}
