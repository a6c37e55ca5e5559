//! The shaders on whatever drivers there are.

use std::{path::PathBuf, process::ExitCode};

use clap::{Parser, Subcommand};

mod compute;
mod device;
mod means;
mod parity;
mod picture;
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
        /// File for the table.
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// The mean radiance over a surface by the exact rule, at five zooms and half vectors, over the density.
    Means {
        /// Adapters whose names contain this; all without it.
        #[arg(long)]
        adapter: Option<String>,
    },
    /// The teapot and a plane to the horizon at four zooms, by the shader and by the crates beside each other.
    Pictures {
        /// Adapters whose names contain this; all without it.
        #[arg(long)]
        adapter: Option<String>,
        /// Side of a picture in pixels.
        #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=4096))]
        size: u32,
        /// Folder for the pictures.
        #[arg(long, default_value = "target/pictures")]
        out: PathBuf,
    },
}

fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Parity { adapter, only, out } => {
            parity::run(adapter.as_deref(), only.as_deref(), out.as_deref())
        }
        Command::Means { adapter } => means::run(adapter.as_deref()),
        Command::Pictures { adapter, size, out } => picture::run(adapter.as_deref(), size, &out),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
