//! The program behind `cargo xtask web`, `no-std`, `bits` and `firmware`.

mod bits;
mod cli;
mod failure;
mod firmware;
mod no_std;
mod report;
mod toolchain;
mod web;

use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;

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
    let root = std::fs::canonicalize(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")))?;
    let root = root.as_path();
    match command {
        Command::Web(wanted) => web::run(&wanted, root),
        Command::Live => web::in_browsers(root),
        Command::NoStd => no_std::probe(root).map(|line| say(&line)),
        Command::Firmware(wanted) => {
            let drawn = if wanted.ship { firmware::ship } else { firmware::check };
            drawn(root).map(|line| say(&line))
        }
        Command::Bits(wanted) => {
            let table = if wanted.ship { bits::ship } else { bits::table };
            table(root).map(|table| say(&table))
        }
        Command::SameBits => bits::gate(root),
    }
}
