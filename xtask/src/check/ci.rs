//! `cargo xtask ci`: every gate that stands between a change and `main`.

use std::{
    path::Path,
    process::Command,
    sync::atomic::{AtomicBool, Ordering},
    time::Instant,
};

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

/// The float backends that a crate must build and pass its tests with; `alloc` joins where a crate has it.
const BACKENDS: [&str; 3] = ["std", "libm", "std,libm"];

/// Tests and benches that are built many times and run once are not optimised, and have no debug information.
const QUICK: [(&str, &str); 2] = [("CARGO_PROFILE_TEST_OPT_LEVEL", "0"), ("CARGO_PROFILE_TEST_DEBUG", "0")];

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

/// Runs the gates in order and stops at the first that fails.
pub(crate) fn run(root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    let all = Instant::now();
    for (name, gate) in GATES {
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
        for backend in BACKENDS {
            let features = ["clippy", "--package", name, "--no-default-features", "--features", backend];
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

fn tests(root: &Path) -> Result<(), Failure> {
    for name in CRATES {
        for backend in BACKENDS {
            // The noise's bits must not depend on lanes either; the other crates own tables where they may allocate.
            let more: &[&str] = match name {
                "asperity-noise" => &["", ",simd"],
                "asperity-ndf-sampling" | "asperity-fif" => &[",alloc,simd"],
                _ => &[",alloc"],
            };
            for more in more {
                let set = format!("{backend}{more}");
                let test =
                    ["test", "--quiet", "--package", name, "--no-default-features", "--features", &set];
                cargo_with(root, &test, &QUICK)?;
            }
        }
        if name != "asperity-noise" {
            let bare = ["test", "--quiet", "--package", name, "--no-default-features", "--features", "libm"];
            cargo_with(root, &bare, &QUICK)?;
        }
    }
    Ok(())
}

fn examples_and_benches(root: &Path) -> Result<(), Failure> {
    for name in CRATES {
        let test = ["test", "--quiet", "--package", name, "--benches", "--examples"];
        cargo_with(root, &test, &QUICK)?;
    }
    Ok(())
}
