//! The shaders on whatever drivers there are.

use std::{
    path::{Path, PathBuf},
    process::ExitCode,
};

use asperity_output::Output;
use asperity_shader_tests::{case::Case, cases};
use clap::{Parser, Subcommand};

mod compute;
mod costs;
mod device;
mod dialect;
mod entry;
mod export;
mod means;
mod parity;
mod picture;
mod resources;

use dialect::Dialect;
use picture::Subject;

/// The shaders of Asperity on drivers.
#[derive(Parser)]
#[command(name = "asperity-gpu")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Every function beside the crate's, interpreted and on each adapter: equal bits, or the largest error beside its bound.
    Parity {
        /// Adapters whose names contain this; all without it.
        #[arg(long)]
        adapter: Option<String>,
        /// Functions whose names, or those of the parts they need, contain this; all without it.
        #[arg(long, visible_alias = "part")]
        only: Option<String>,
        /// File for the table.
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// Every function with an entry point in every shading language, read by the validators that are installed, with the words of its
    /// bindings, and every part as a module for Bevy.
    Export {
        /// Functions whose names, or those of the parts they need, contain this; all without it.
        #[arg(long, visible_alias = "part")]
        only: Option<String>,
        /// Languages; all without it.
        #[arg(long, value_enum)]
        dialect: Vec<Dialect>,
        /// Folder for the shaders.
        #[arg(long, default_value = "target/shaders")]
        out: PathBuf,
        /// Say what is missing or stale in the folder, and write nothing.
        #[arg(long)]
        check: bool,
    },
    /// The mean radiance over a surface by the exact rule, at five zooms and half vectors, over the density.
    Means {
        /// Adapters whose names contain this; all without it.
        #[arg(long)]
        adapter: Option<String>,
    },
    /// Operations of every function, octave and pixel, and milliseconds of a frame on each adapter.
    Costs {
        /// Adapters whose names contain this; all without it.
        #[arg(long)]
        adapter: Option<String>,
        /// Side of a frame in pixels.
        #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=4096))]
        size: u32,
        /// File for the page.
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// The live page's pictures of the teapot beside the crates': `*.rgba` in a folder, each with its camera in a file `*.json`.
    Page {
        /// The folder.
        folder: PathBuf,
    },
    /// The teapot and a plane to the horizon at four zooms, and the materials, by the shader and by the crates beside each other.
    Pictures {
        /// Adapters whose names contain this; all without it.
        #[arg(long)]
        adapter: Option<String>,
        /// Of all adapters the one that is likely the fastest.
        #[arg(long)]
        fastest: bool,
        /// This picture alone.
        #[arg(long, value_enum)]
        only: Option<Subject>,
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
            chosen(only).and_then(|cases| parity::run(&cases, adapter.as_deref(), out.as_deref()))
        }
        Command::Export { only, dialect, out, check } => {
            chosen(only).and_then(|cases| export::run(&cases, &dialect, &out, check))
        }
        Command::Costs { adapter, size, out } => costs::run(adapter.as_deref(), size, out.as_deref()),
        Command::Means { adapter } => means::run(adapter.as_deref()),
        Command::Page { folder } => picture::page::run(&folder),
        Command::Pictures { adapter, fastest, only, size, out } => {
            picture::run(adapter.as_deref(), fastest, only, size, &out)
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes a file whole or not at all, and its folder if need be.
fn write(path: &Path, data: &[u8]) -> Result<(), String> {
    let (folder, name) = (path.parent().unwrap_or(Path::new("")), path.file_name().unwrap_or_default());
    let written = Output::new(folder).and_then(|folder| folder.write(&name.to_string_lossy(), data));
    written.map_err(|error| error.to_string())
}

/// Cases whose names, or those of the parts they need, contain a text; all without it.
fn chosen(only: Option<String>) -> Result<Vec<Case>, String> {
    let mut cases = cases::all();
    let Some(text) = only else { return Ok(cases) };
    cases.retain(|case| {
        let parts = asperity_shaders::ordered(&case.parts);
        case.name.contains(&text) || parts.iter().any(|part| part.name().contains(&text))
    });
    if cases.is_empty() { Err(format!("no function has or needs `{text}`")) } else { Ok(cases) }
}
