//! `cargo xtask ci`: runs all CI checks.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use super::{blocks, dependencies, packages, tidy};
use crate::cargo::{cargo, run};
use crate::cli::Ci;
use crate::failure::Failure;
use crate::metadata;
use crate::report::say;
use crate::shaders;

/// The crates that compute.
pub(crate) const CRATES: [&str; 4] =
    ["asperity-noise", "asperity-ndf-sampling", "asperity-fif", "asperity-shading"];

/// Feature sets not covered by `cargo test --workspace`, which enables every feature of a crate, so
/// that `libm` wins.
const SETS: [(&str, &[&str]); 5] = [
    // The noise crate must give the same bits with and without SIMD. The other crates own tables
    // when they may allocate.
    ("asperity-noise", &["std", "std,simd", "libm", "libm,check,simd"]),
    ("asperity-ndf-sampling", &["std,alloc,simd", "libm,check,simd", "libm"]),
    ("asperity-fif", &["std,alloc,simd", "libm,alloc,simd", "libm"]),
    ("asperity-shading", &["std,alloc,simd", "libm,check", "libm"]),
    ("asperity-wgsl", &["std", "libm"]),
];

/// The minimal features for linting a crate: one backend, and the `approx` and `serde` traits
/// without std.
const LEAST: [&str; 2] = ["std", "libm,approx,serde"];

type Check = (&'static str, fn(&Path) -> Result<(), Failure>);

const CHECKS: [Check; 9] = [
    ("format", |root| run(&mut cargo(root, "fmt --all --check"))),
    ("tidy", |_| tidy::report()?.verdict()),
    ("dependencies", dependencies::dependencies),
    ("clippy", |root| lint(root, "--workspace --all-targets")),
    ("no float backend is one clear error", neither_backend),
    ("docs", |root| {
        let mut docs = cargo(root, "doc --workspace --no-deps --document-private-items --quiet");
        run(docs.env("RUSTDOCFLAGS", "-D warnings"))
    }),
    ("examples", examples),
    ("no_std", |root| {
        let mut check = cargo(&root.join("tests/no-std"), "check --quiet --locked --release --lib");
        run(check.env_remove("CARGO_TARGET_DIR").env_remove("RUSTFLAGS"))
    }),
    ("packages", packages::packages),
];

/// Checks that take minutes. They run weekly, before a release, and by name when a change affects
/// them.
const WEEKLY: [Check; 18] = [
    ("slow tests", |root| run(&mut cargo(root, "test --quiet --workspace -- --ignored"))),
    ("generated tables", |root| {
        run(&mut cargo(root, "test --quiet --workspace --test up_to_date -- --ignored"))
    }),
    ("benches", benches),
    ("examples with default features", blocks::examples),
    ("no_std program", |root| platforms(root, "no-std")),
    ("tests under each feature set", tests),
    ("shaders on drivers", shaders::on_drivers),
    ("live page", |root| platforms(root, "live")),
    ("the same bits", |root| platforms(root, "same-bits")),
    ("firmware", |root| platforms(root, "firmware")),
    ("bits of every platform", |root| platforms(root, "bits")),
    ("minimal features", minimal_features),
    ("pairs of features", pairs_of_features),
    ("oldest packages", packages::oldest_packages),
    ("clean-room packages", packages::clean_room_builds),
    ("fuzz targets", |root| {
        run(cargo(&root.join("tests/fuzz"), "test --quiet --locked --test withstood")
            .env_remove("CARGO_TARGET_DIR"))
    }),
    ("UASTC textures", |root| {
        run(&mut cargo(root, "test --quiet --package asperity --features basis filter::"))?;
        run(cargo(&root.join("tools/uastc"), "test --quiet --locked").env_remove("CARGO_TARGET_DIR"))
    }),
    ("Python package", |root| {
        run(Command::new("sh").arg(root.join("bindings/python/check.sh")).env_remove("CARGO_TARGET_DIR"))
    }),
];

/// Runs the checks whose names contain one of the given texts, or all checks that are not weekly,
/// or all. They run in order, and the first failure stops the run.
pub(crate) fn run_checks(wanted: &Ci, root: &Path) -> Result<(), Failure> {
    let named = |name: &str| wanted.only.iter().any(|part| name.contains(part.as_str()));
    let mut checks: Vec<Check> = CHECKS.into_iter().chain(WEEKLY).collect();
    if !wanted.only.is_empty() {
        checks.retain(|(name, _)| named(name));
    } else if !wanted.weekly {
        checks.truncate(CHECKS.len());
    }
    if checks.is_empty() {
        let names = CHECKS.into_iter().chain(WEEKLY).map(|(name, _)| name).collect::<Vec<_>>().join(", ");
        return Err(format!("no check matches `{}` (available: {names})", wanted.only.join("` or `")).into());
    }
    let all = Instant::now();
    for (name, check) in checks {
        let start = Instant::now();
        check(root).map_err(|error| format!("check `{name}`: {error}"))?;
        say(&format!("ok {name:<38} {:6.1} s", start.elapsed().as_secs_f64()));
    }
    say(&format!("all checks passed in {:.1} s", all.elapsed().as_secs_f64()));
    Ok(())
}

/// Runs a command of `asperity-platforms`, which builds for other targets.
fn platforms(root: &Path, command: &str) -> Result<(), Failure> {
    run(&mut cargo(root, &format!("run --quiet --package asperity-platforms -- {command}")))
}

fn lint(root: &Path, of: &str) -> Result<(), Failure> {
    run(&mut cargo(root, &format!("clippy {of} --quiet -- -D warnings")))
}

/// Lints the crates with the fewest features.
fn minimal_features(root: &Path) -> Result<(), Failure> {
    CRATES.iter().flat_map(|name| LEAST.map(|features| (name, features))).try_for_each(
        |(name, features)| {
            lint(root, &format!("--package {name} --no-default-features --features {features}"))
        },
    )?;
    lint(root, "--package asperity-wgsl --no-default-features --features libm")
}

/// Lints the features of a crate one by one on either backend, and in pairs on one backend, so that
/// no feature needs another that it does not enable.
fn pairs_of_features(root: &Path) -> Result<(), Failure> {
    let mut sets = 0;
    for package in metadata::published(root)? {
        for set in feature_sets(package.features.iter().map(String::as_str)) {
            let of = format!("--package {} --no-default-features --features {set}", package.name);
            run(&mut cargo(root, &format!("clippy {of} --lib --quiet -- -D warnings")))?;
            sets += 1;
        }
    }
    say(&format!("  linted {sets} feature sets"));
    Ok(())
}

/// Returns comma-separated sets of at most two of these features plus a backend.
fn feature_sets<'a>(features: impl Iterator<Item = &'a str>) -> Vec<String> {
    let others: Vec<&str> = features.filter(|name| !["default", "std", "libm"].contains(name)).collect();
    let mut sets = vec![String::from("std"), "libm".into()];
    for (k, one) in others.iter().enumerate() {
        sets.extend(["std", "libm"].map(|backend| format!("{backend},{one}")));
        sets.extend(others[k + 1..].iter().map(|other| format!("libm,{one},{other}")));
    }
    sets
}

fn neither_backend(root: &Path) -> Result<(), Failure> {
    for name in CRATES {
        let output =
            cargo(root, &format!("check --quiet --package {name} --no-default-features")).output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.success() || !said.contains("needs a float backend") {
            return Err(
                format!("{name} without `std` or `libm` must fail with an error that lists both").into()
            );
        }
    }
    Ok(())
}

/// Tests and benches that are built often and run once are not optimized, like a user's first
/// build.
fn test(root: &Path, name: &str, of: &str) -> Result<(), Failure> {
    let mut test = cargo(root, &format!("test --quiet --package {name} {of}"));
    test.env("CARGO_PROFILE_TEST_OPT_LEVEL", "0").env("CARGO_PROFILE_TEST_DEBUG_ASSERTIONS", "true");
    run(&mut test)
}

/// Runs unit and golden tests under each feature set, and all examples under the smallest set, so
/// that an example must declare its required features.
fn tests(root: &Path) -> Result<(), Failure> {
    for (name, sets) in SETS {
        for set in sets {
            test(root, name, &format!("--tests --no-default-features --features {set}"))?;
        }
        for of in ["--doc", "--examples"] {
            test(root, name, &format!("{of} --no-default-features --features libm"))?;
        }
    }
    Ok(())
}

/// Runs one measurement of every bench.
fn benches(root: &Path) -> Result<(), Failure> {
    let packages = metadata::published(root)?;
    let benches =
        packages.iter().flat_map(|package| &package.targets).filter(|target| target.kind == "bench");
    let mut test = cargo(root, "test --quiet --workspace");
    run(test.args(benches.flat_map(|bench| ["--bench", &bench.name])))
}

/// Runs every example, as built by `cargo test --workspace`.
fn examples(root: &Path) -> Result<(), Failure> {
    let mut build = cargo(root, "test --workspace --no-run --message-format json-render-diagnostics");
    let output = build.stderr(Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err("cannot build the examples".into());
    }
    for line in output.stdout.split(|&byte| byte == b'\n').filter(|line| line.starts_with(b"{")) {
        let artifact: serde_json::Value = serde_json::from_slice(line)?;
        if artifact["target"]["kind"][0] == "example"
            && let Some(program) = artifact["executable"].as_str()
        {
            run(Command::new(program).current_dir(root).stdin(Stdio::null()))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feature_sets_are_singles_and_pairs() {
        let sets = feature_sets(["alloc", "default", "libm", "serde", "simd", "std"].into_iter());
        assert_eq!(sets.len(), 2 + 2 * 3 + 3);
        for set in ["std,serde", "libm,alloc,simd", "libm"] {
            assert!(sets.iter().any(|made| made == set), "{set} of {sets:?}");
        }
    }
}
