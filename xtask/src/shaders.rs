//! `cargo xtask shaders`: every function of the shaders in every language, beside the crates on the adapters that there are, and its cost.

use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::atomic::AtomicBool;

use crate::cargo;
use crate::cli::Shaders;
use crate::drivers::program;
use crate::failure::{Failure, Interrupted};
use crate::output::Output;
use crate::progress;

/// Runs what was asked for.
pub(crate) fn run(wanted: &Shaders, root: &Path, interrupted: &AtomicBool) -> Result<(), Failure> {
    if wanted.costs {
        let mut costs = program(root, "costs");
        costs.args(wanted.adapter.iter().flat_map(|name| ["--adapter", name]));
        let ran = cargo::run(costs.arg("--out").arg(root.join("docs/shaders/costs.md")));
        Interrupted::check(interrupted)?;
        return ran;
    }
    let only: Vec<&str> = wanted.part.iter().flat_map(|part| ["--only", part]).collect();
    if wanted.check || wanted.adapter.is_some() {
        let mut parity = program(root, "parity");
        parity.args(&only).args(wanted.adapter.iter().flat_map(|name| ["--adapter", name]));
        let ran = cargo::run(&mut parity);
        Interrupted::check(interrupted)?;
        return ran;
    }
    let mut export = program(root, "export");
    // The program runs in a folder of its own.
    export.args(&only).arg("--out").arg(folder(&wanted.out)?);
    export.args(wanted.dialect.iter().flat_map(|name| ["--dialect", name]));
    let ran = cargo::run(&mut export);
    Interrupted::check(interrupted)?;
    ran
}

/// The gate: every bound on every adapter, and every file read by the validators; one line each of what there is, or lacks.
pub(crate) fn on_drivers(root: &Path) -> Result<(), Failure> {
    let mut export = program(root, "export");
    export.arg("--out").arg(folder(&root.join("target/asperity/shaders"))?);
    for (mut command, is_line) in
        [(program(root, "parity"), is_machine as fn(&str) -> bool), (export, |line| !line.is_empty())]
    {
        let output = command.stderr(Stdio::inherit()).output()?;
        let said = String::from_utf8_lossy(&output.stdout);
        if !output.status.success() {
            return Err(format!("the shaders are not what they should be:\n{said}").into());
        }
        said.lines().filter(|line| is_line(line)).for_each(|line| progress::say(&format!("  {line}")));
    }
    Ok(())
}

/// Whether a line of the table of parity is its head, which names the adapters, or says that there is none.
fn is_machine(line: &str) -> bool {
    line.starts_with("| function |") || !line.starts_with('|') && !line.is_empty()
}

fn folder(path: &Path) -> Result<PathBuf, Failure> {
    Output::new(path)?;
    Ok(std::path::absolute(path)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_the_table_its_head_is_told_and_that_there_is_no_driver() {
        let said = [
            "no driver is tried: no adapter was found",
            "| function | quantity |",
            "|---|---|",
            "| a | b |",
            "",
        ];
        assert_eq!(said.map(is_machine), [true, true, false, false, false]);
    }
}
