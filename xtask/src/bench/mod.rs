//! `cargo xtask bench`: the crates' own benches, the growth of their cost, or our noises beside those of other libraries.

mod chart;
mod growth;
mod machine;
mod table;
mod times;

use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::atomic::AtomicBool;

use serde_json::json;

use crate::cargo::{self, cargo};
use crate::check::ci::CRATES;
use crate::cli::Bench;
use crate::failure::{Failure, Interrupted};
use crate::output::Output;
use crate::progress;
use times::Times;

/// The variable that names the folder of FastNoise2's static library.
const LIBRARY: &str = "FASTNOISE2_LIB_DIR";

/// Folder of the checked-in copy.
const SHIPPED: &str = "docs/bench";

/// Runs what was asked for.
pub(crate) fn run(wanted: &Bench, root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    if wanted.peers {
        peers(wanted, root, interrupted)
    } else if wanted.growth {
        growth(wanted, root, interrupted)
    } else {
        own(&wanted.only, root, interrupted)
    }
}

/// Runs the benches of growth and writes their page.
fn growth(wanted: &Bench, root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    let output = Output::new(&wanted.out)?;
    let folder = root.join("target/criterion");
    // What an earlier run measured would be taken for this one's.
    for entry in std::fs::read_dir(&folder).into_iter().flatten().filter_map(Result::ok) {
        if entry.file_name().to_string_lossy().starts_with(growth::GROUP) {
            std::fs::remove_dir_all(entry.path())?;
        }
    }
    let mut command = cargo(root, &format!("bench --bench growth --package {}", CRATES.join(" --package ")));
    command.args(["--", "--noplot", "--warm-up-time", "0.2", "--measurement-time", "0.8"]).args(&wanted.only);
    // Criterion's folder is wherever cargo's is, if nobody says so.
    let ran = cargo::run(command.env("CRITERION_HOME", &folder));
    Interrupted::check(interrupted)?;
    ran?;
    let curves = growth::read(&folder)?;
    let machine = machine::facts(None);
    let machine = &machine[..machine.len() - 1];
    let shipped = wanted.ship.then(|| Output::new(root.join(SHIPPED))).transpose()?;
    for folder in std::iter::once(output).chain(shipped) {
        for name in growth::crates(&curves) {
            folder.write(&format!("growth-{name}.svg"), growth::svg(name, &curves)?.as_bytes())?;
        }
        folder.write("README.md", growth::markdown(machine, &curves).as_bytes())?;
        progress::say(&format!("the page: {}", folder.place("README.md")));
    }
    Ok(())
}

/// The criterion benches of the crates.
fn own(only: &[String], root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    let mut command = cargo(root, &format!("bench --package {}", CRATES.join(" --package ")));
    if !only.is_empty() {
        command.args(["--", &only.join("|")]);
    }
    let ran = cargo::run(&mut command);
    Interrupted::check(interrupted)?;
    ran
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
    let machine = machine::facts(library.as_deref());
    let (text, chart) = (table::markdown(&machine, &times, "peers.svg"), chart::svg(&times)?);
    output.write("peers.json", &serde_json::to_vec(&json!({ "machine": machine, "times": times }))?)?;
    progress::say(&table::ratios(&times));
    let shipped = wanted.ship.then(|| Output::new(root.join(SHIPPED))).transpose()?;
    for folder in std::iter::once(output).chain(shipped) {
        folder.write("peers.svg", chart.as_bytes())?;
        folder.write("peers.md", text.as_bytes())?;
        progress::say(&format!("the table: {}", folder.place("peers.md")));
        progress::say(&format!("the chart: {}", folder.place("peers.svg")));
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
    let mut command = cargo(&root.join("xtask/peers"), "run --release --locked");
    if fastnoise2 {
        command.args(["--features", "fastnoise2"]);
    }
    command.args(["--", "--rounds", &wanted.rounds.to_string(), "--step", &wanted.step.to_string()]);
    command.args(wanted.only.iter().flat_map(|name| ["--only", name]));
    let output = command.stderr(Stdio::inherit()).output()?;
    Interrupted::check(interrupted)?;
    if !output.status.success() {
        return Err("the peers were not measured; what stands above says why".into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// The static library in the folder that was named, if one was.
fn library(folder: Option<PathBuf>) -> Result<Option<PathBuf>, Failure> {
    let Some(folder) = folder else { return Ok(None) };
    let files = ["libFastNoise.a", "FastNoise.lib"].map(|name| folder.join(name));
    let found = files.into_iter().find(|file| file.is_file()).ok_or_else(|| {
        let folder = folder.display();
        format!("{LIBRARY} is {folder}, but no libFastNoise.a is in it; xtask/peers/README.md says how to build it")
    });
    Ok(Some(found?))
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
