//! The shaders on all available drivers.

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

use asperity::cli::shader::Language;
use picture::Subject;

/// Test and export the shaders of Asperity on GPU drivers.
#[derive(Parser)]
#[command(name = "asperity-gpu")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Compare every function with the crates, interpreted and on each adapter: equal bits, or the
    /// largest error and its bound.
    Parity {
        /// Adapters whose names contain this text [default: all].
        #[arg(long)]
        adapter: Option<String>,
        /// Functions whose names, or names of required parts, contain this text [default: all].
        #[arg(long, visible_alias = "part")]
        only: Option<String>,
        /// Output file for the table.
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// Export every function with an entry point in every shading language, with the words of its
    /// bindings, and every part as a module for Bevy. Installed validators check the files.
    Export {
        /// Functions whose names, or names of required parts, contain this text [default: all].
        #[arg(long, visible_alias = "part")]
        only: Option<String>,
        /// Languages [default: all].
        #[arg(long, value_enum)]
        dialect: Vec<Language>,
        /// Output folder.
        #[arg(long, default_value = "target/shaders")]
        out: PathBuf,
        /// Report missing or stale files in the folder without writing.
        #[arg(long)]
        check: bool,
    },
    /// Measure the mean radiance over a surface at five zooms, relative to the far field: with the
    /// exact rule, with visible normals, and with every bounce of metal and glass.
    Means {
        /// Adapters whose names contain this text [default: all].
        #[arg(long)]
        adapter: Option<String>,
    },
    /// Report operations of every function, octave and pixel, and milliseconds per frame on each
    /// adapter.
    Costs {
        /// Adapters whose names contain this text [default: all].
        #[arg(long)]
        adapter: Option<String>,
        /// Side of a frame in pixels.
        #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=4096))]
        size: u32,
        /// Output file for the page.
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// Compare the live page's images of the teapot with the crates: `*.rgba` in a folder, each
    /// with its camera in a file `*.json`.
    Page {
        /// The folder.
        folder: PathBuf,
    },
    /// Render the teapot and a plane up to the horizon at four zooms, and the materials, by the
    /// shaders and by the crates side by side.
    Pictures {
        /// Adapters whose names contain this text [default: all].
        #[arg(long)]
        adapter: Option<String>,
        /// Use only the adapter that is probably the fastest.
        #[arg(long)]
        fastest: bool,
        /// Render only this image.
        #[arg(long, value_enum)]
        only: Option<Subject>,
        /// Side of an image in pixels.
        #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=4096))]
        size: u32,
        /// Output folder.
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

/// Writes a file atomically, and creates its folder if necessary.
fn write(path: &Path, data: &[u8]) -> Result<(), String> {
    let (folder, name) = (path.parent().unwrap_or(Path::new("")), path.file_name().unwrap_or_default());
    let written = Output::new(folder).and_then(|folder| folder.write(&name.to_string_lossy(), data));
    written.map_err(|error| error.to_string())
}

/// Returns cases whose names, or names of required parts, contain a text, or all cases.
fn chosen(only: Option<String>) -> Result<Vec<Case>, String> {
    let mut cases = cases::all();
    let Some(text) = only else { return Ok(cases) };
    cases.retain(|case| {
        let parts = asperity_wgsl::ordered(&case.parts);
        case.name.contains(&text) || parts.iter().any(|part| part.name().contains(&text))
    });
    if cases.is_empty() { Err(format!("no function or part matches `{text}`")) } else { Ok(cases) }
}
