//! `cargo xtask bench`: the crates' own benches, or our noises beside those of other libraries.

mod chart;
mod machine;
mod table;
mod times;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};

use serde::Serialize;

use crate::check::cargo::cargo_program;
use crate::check::ci::CRATES;
use crate::cli::Bench;
use crate::failure::{Failure, Interrupted};
use crate::output::Output;
use crate::progress;
use machine::Machine;
use times::Times;

/// The variable that names the folder of FastNoise2's static library.
const LIBRARY: &str = "FASTNOISE2_LIB_DIR";

/// Folder of the checked-in copy.
const SHIPPED: &str = "docs/bench";

/// The file that keeps all that was measured.
#[derive(Serialize)]
struct Record<'a> {
    machine: &'a Machine,
    times: &'a Times,
}

/// Runs what was asked for.
pub(crate) fn run(wanted: &Bench, root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    if wanted.peers { peers(wanted, root, interrupted) } else { own(&wanted.only, root, interrupted) }
}

/// The criterion benches of the crates.
fn own(only: &[String], root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    let mut command = Command::new(cargo_program());
    command.arg("bench").current_dir(root);
    for name in CRATES {
        command.args(["--package", name]);
    }
    if !only.is_empty() {
        command.args(["--", &only.join("|")]);
    }
    let status = command.stdin(Stdio::null()).status()?;
    if interrupted.load(Ordering::Relaxed) {
        return Err(Interrupted.into());
    }
    if status.success() { Ok(()) } else { Err("the benches did not run to their end".into()) }
}

fn peers(wanted: &Bench, root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    let library = library(std::env::var_os(LIBRARY).map(PathBuf::from))?;
    if library.is_none() {
        let hint = format!("FastNoise2 is not measured: {LIBRARY} is not set (see xtask/peers/README.md)");
        if wanted.ship {
            return Err(format!("{hint}; the checked-in table has to show the fastest peer").into());
        }
        progress::say(&hint);
    }
    // Before the long part, so that a folder that cannot be written to is known at once.
    let output = Output::new(&wanted.out)?;
    let times = measure(wanted, root, library.is_some(), interrupted)?;
    let machine = Machine::here(library.as_deref());
    let (text, chart) = (table::markdown(&machine, &times, "peers.svg"), chart::svg(&times)?);
    let record = serde_json::to_vec(&Record { machine: &machine, times: &times })?;
    progress::say(&table::ratios(&times));
    let mut places = vec![output];
    if wanted.ship {
        places.push(Output::new(root.join(SHIPPED))?);
    }
    for (index, place) in places.iter().enumerate() {
        place.write("peers.svg", chart.as_bytes())?;
        place.write("peers.md", text.as_bytes())?;
        if index == 0 {
            place.write("peers.json", &record)?;
        }
        let folder = std::path::absolute(place.folder())?;
        progress::say(&format!("the table: {}", folder.join("peers.md").display()));
        progress::say(&format!("the chart: {}", folder.join("peers.svg").display()));
    }
    Ok(())
}

/// Builds and runs `xtask/peers`.
fn measure(
    wanted: &Bench,
    root: &Path,
    fastnoise2: bool,
    interrupted: &AtomicBool,
) -> Result<Times, Failure> {
    let mut command = Command::new(cargo_program());
    command.args(["run", "--release", "--locked"]).current_dir(root.join("xtask/peers"));
    if fastnoise2 {
        command.args(["--features", "fastnoise2"]);
    }
    command.args(["--", "--rounds", &wanted.rounds.to_string(), "--step", &wanted.step.to_string()]);
    for name in &wanted.only {
        command.args(["--only", name]);
    }
    let output = command.stdin(Stdio::null()).stderr(Stdio::inherit()).output()?;
    if interrupted.load(Ordering::Relaxed) {
        return Err(Interrupted.into());
    }
    if !output.status.success() {
        return Err("the peers were not measured; what stands above says why".into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// The static library in the folder that was named, if one was.
fn library(folder: Option<PathBuf>) -> Result<Option<PathBuf>, Failure> {
    let Some(folder) = folder else { return Ok(None) };
    let found =
        ["libFastNoise.a", "FastNoise.lib"].map(|name| folder.join(name)).into_iter().find(|p| p.is_file());
    found.map(Some).ok_or_else(|| {
        format!(
            "{LIBRARY} is {}, but there is no libFastNoise.a in it; xtask/peers/README.md says how to build it",
            folder.display()
        )
        .into()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_without_the_library_is_named() {
        let scratch = tempfile::tempdir().unwrap();
        assert_eq!(library(None).unwrap(), None);
        let error = library(Some(scratch.path().into())).unwrap_err().to_string();
        assert!(error.contains(LIBRARY) && error.contains("README"), "{error}");
        std::fs::write(scratch.path().join("libFastNoise.a"), b"").unwrap();
        assert!(library(Some(scratch.path().into())).unwrap().is_some());
    }
}
