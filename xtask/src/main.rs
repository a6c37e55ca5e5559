//! Development tasks: see `cargo xtask --help`.

mod cargo;
mod check;
mod cli;
mod drivers;
mod failure;
mod metadata;
mod report;
mod shaders;

use std::ffi::OsString;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;

use check::{ci, fuzz, tidy};
use cli::{Cli, Command};
use failure::Result;
use report::say;

fn main() -> ExitCode {
    match perform(Cli::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn perform(command: Command) -> Result<()> {
    // The parent of this package's folder is the workspace.
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("no workspace")?;
    match command {
        Command::Gallery(given) => program("asperity-gallery", &given.words),
        Command::Tables(given) => program("asperity-tables", &given.words),
        Command::Peers(given) => {
            let mut peers = cargo::cargo(&root.join("tools/peers"), "run --release --locked");
            if std::env::var_os("FASTNOISE2_LIB_DIR").is_some() {
                peers.args(["--features", "fastnoise2"]);
            }
            cargo::run(peers.arg("--").args(given.words))
        }
        Command::Bench(wanted) => {
            let mut bench =
                cargo::cargo(root, &format!("bench --package {}", ci::CRATES.join(" --package ")));
            if !wanted.only.is_empty() {
                bench.args(["--", &wanted.only.join("|")]);
            }
            cargo::run(&mut bench)
        }
        Command::Shaders(wanted) => shaders::run(&wanted, root),
        Command::Tidy => {
            let report = tidy::report()?;
            report.lines.iter().for_each(|line| say(line));
            report.verdict().map(|()| say("tidy"))
        }
        Command::Ci(wanted) => ci::run_checks(&wanted, root),
        Command::Fuzz(wanted) => fuzz::fuzz(&wanted, root),
        Command::NoStd(given) => platforms("no-std", &given.words),
        Command::Firmware(given) => platforms("firmware", &given.words),
        Command::Bits(given) => platforms("bits", &given.words),
        Command::Web(given) => platforms("web", &given.words),
    }
}

/// Runs a command of `asperity-platforms`, which builds for other targets.
fn platforms(name: &str, words: &[OsString]) -> Result<()> {
    let folder = std::env::current_dir()?;
    cargo::run(cargo::cargo(&folder, "run --quiet --package asperity-platforms --").arg(name).args(words))
}

/// Builds and runs a program of this workspace in the current folder.
fn program(package: &str, words: &[OsString]) -> Result<()> {
    cargo::run(
        cargo::cargo(&std::env::current_dir()?, "run --profile tools --package")
            .arg(package)
            .arg("--")
            .args(words),
    )
}

#[cfg(test)]
mod tests {
    use std::fs;

    use clap::CommandFactory;

    use super::*;

    #[test]
    fn help_lists_every_command() {
        let help = Cli::command().render_help().to_string();
        for command in [
            "gallery", "tables", "peers", "bench", "shaders", "web", "tidy", "ci", "fuzz", "no-std",
            "firmware", "bits",
        ] {
            assert!(help.contains(&format!("\n  {command} ")), "{command} is missing in:\n{help}");
        }
        Cli::command().debug_assert();
    }

    #[test]
    fn documented_commands_parse() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let guides = fs::read_dir(root.join("docs/guide")).unwrap().map(|entry| entry.unwrap().path());
        let mut commands = 0;
        for path in guides.chain(["README.md", "CONTRIBUTING.md"].map(|page| root.join(page))) {
            let page = fs::read_to_string(&path).unwrap();
            for line in page.lines().filter_map(|line| line.strip_prefix("cargo xtask ")) {
                let words = line.split('#').next().unwrap().split_whitespace();
                let parsed = Cli::try_parse_from(["xtask"].into_iter().chain(words));
                assert!(parsed.is_ok(), "{}: {line}: {}", path.display(), parsed.unwrap_err());
                commands += 1;
            }
        }
        assert!(commands >= 4);
    }

    #[test]
    fn ci_lists_its_checks_when_none_matches() {
        let cli = Cli::try_parse_from(["xtask", "ci", "--only", "nowhere"]).unwrap();
        let error = perform(cli.command).unwrap_err().to_string();
        assert!(error.starts_with("no check matches `nowhere` (available: format, tidy, "), "{error}");
    }
}
