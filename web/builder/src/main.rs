//! Builds the live page.

mod assemble;
mod glsl;
mod programs;
mod scripts;
mod serve;
mod shaders;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(about = "Build and serve the live page")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Build the page as a single file and as a folder.
    Build {
        /// The WebAssembly module.
        #[arg(long)]
        wasm: PathBuf,
        /// Output folder.
        #[arg(long)]
        out: PathBuf,
    },
    /// Serve a folder on 127.0.0.1 until interrupted.
    Serve {
        /// The folder.
        folder: PathBuf,
        /// Port; 0 selects a free port.
        #[arg(long, default_value_t = 0)]
        port: u16,
    },
}

fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Build { wasm, out } => assemble::build(&wasm, &out),
        Command::Serve { folder, port } => serve::serve(&folder, port),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
