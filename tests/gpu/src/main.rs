//! The shaders on whatever drivers there are.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod device;
mod parity;
mod resources;

/// The shaders of Asperity on drivers.
#[derive(Parser)]
#[command(name = "asperity-gpu")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Every function beside the crate's on each adapter: equal bits, or the largest error beside its bound.
    Parity {
        /// Adapters whose names contain this; all without it.
        #[arg(long)]
        adapter: Option<String>,
        /// Functions whose names contain this; all without it.
        #[arg(long)]
        only: Option<String>,
    },
}

fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Parity { adapter, only } => parity::run(adapter.as_deref(), only.as_deref()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
