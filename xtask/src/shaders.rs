//! `cargo xtask shaders`: every function of the shaders in every language, its errors on the
//! adapters that there are, and its cost.

use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::cargo;
use crate::cli::Shaders;
use crate::drivers::{PROGRAM, program, with_drivers};
use crate::failure::Failure;
use crate::report::say;

/// Folder of the exported files and of the reports.
const REPORTS: &str = "target/asperity/shaders";

/// Runs what was asked for.
pub(crate) fn run(wanted: &Shaders, root: &Path) -> Result<(), Failure> {
    if wanted.costs {
        let mut costs = program(root, "costs");
        costs.args(wanted.adapter.iter().flat_map(|name| ["--adapter", name]));
        return cargo::run(costs.arg("--out").arg(folder(&root.join(REPORTS))?.join("costs.md")));
    }
    let only: Vec<&str> = wanted.part.iter().flat_map(|part| ["--only", part]).collect();
    if wanted.check || wanted.adapter.is_some() {
        let mut parity = program(root, "parity");
        parity.args(&only).args(wanted.adapter.iter().flat_map(|name| ["--adapter", name]));
        if wanted.check {
            let mut export = program(root, "export");
            export.args(&only).arg("--check").arg("--out").arg(std::path::absolute(&wanted.out)?);
            cargo::run(&mut export)?;
        }
        if wanted.part.is_none() {
            parity.arg("--out").arg(folder(&root.join(REPORTS))?.join("parity.md"));
        }
        return cargo::run(&mut parity);
    }
    let mut export = program(root, "export");
    // The program runs in its own folder.
    export.args(&only).arg("--out").arg(folder(&wanted.out)?);
    export.args(wanted.dialect.iter().flat_map(|name| ["--dialect", name]));
    cargo::run(&mut export)
}

/// The weekly check: bounds on every adapter, validators, and the examples' pictures. Prints one
/// line for each tool that ran or is missing.
pub(crate) fn on_drivers(root: &Path) -> Result<(), Failure> {
    let mut export = program(root, "export");
    export.arg("--out").arg(folder(&root.join(REPORTS))?);
    let pictures = folder(&root.join("target/asperity/examples"))?;
    let example = |name: &str| {
        let mut example = cargo::cargo(&root.join(PROGRAM), "run --quiet --release --locked --example");
        example.arg(name).arg("--").arg(&pictures);
        with_drivers(&mut example);
        example
    };
    let any: fn(&str) -> bool = |line| !line.is_empty();
    let (parity, heights, teapot) = (program(root, "parity"), example("heights"), example("teapot"));
    let mut driver = true;
    for (mut command, is_line, draws) in [
        (parity, is_machine as fn(&str) -> bool, false),
        (export, any, false),
        (heights, any, true),
        (teapot, any, true),
    ] {
        if draws && !driver {
            continue;
        }
        let output = command.stderr(Stdio::inherit()).output()?;
        let said = String::from_utf8_lossy(&output.stdout);
        if !output.status.success() {
            return Err(format!("the shaders are not what they should be:\n{said}").into());
        }
        driver &= !said.contains("no driver is tried");
        said.lines().filter(|line| is_line(line)).for_each(|line| say(&format!("  {line}")));
    }
    Ok(())
}

/// Whether a line names the adapters, as the head of the table of parity, or reports that none
/// exists.
fn is_machine(line: &str) -> bool {
    line.starts_with("| function |") || !line.starts_with('|') && !line.is_empty()
}

fn folder(path: &Path) -> Result<PathBuf, Failure> {
    std::fs::create_dir_all(path).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
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
