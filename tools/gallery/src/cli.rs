//! The command line of the gallery.

use std::path::PathBuf;

use asperity::quality::Quality;
use clap::Parser;

/// Draw the figures and write their page.
#[derive(Debug, Parser)]
#[command(
    name = "cargo xtask gallery",
    bin_name = "cargo xtask gallery",
    version,
    after_help = "Examples:
  cargo xtask gallery
  cargo xtask gallery --only teapot --size 768 --spp 16
  cargo xtask gallery --only car --quality book
  cargo xtask gallery --list"
)]
pub(crate) struct Gallery {
    /// Draw only the figures whose name contains NAME; may be given again.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// List the figures and stop.
    #[arg(long)]
    pub(crate) list: bool,
    /// Fineness of the pictures; --size and --spp set it one by one.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) quality: Quality,
    /// Side of a square panel in pixels [default: 384; of a draft 192, for a book 1024].
    #[arg(long, value_parser = clap::value_parser!(u32).range(16..=4096))]
    pub(crate) size: Option<u32>,
    /// Samples per pixel; some figures take a multiple, still lifes as many as they need [default: 4; of a draft 1, for a book 32].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) spp: Option<u32>,
    /// Seed of every random choice.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u32,
    /// Draw also what is already there.
    #[arg(long)]
    pub(crate) afresh: bool,
    /// Folder of the gallery and its tables.
    #[arg(long, value_name = "DIR", default_value = "target/asperity")]
    pub(crate) out: PathBuf,
    /// Worker threads; all cores if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) jobs: Option<u16>,
}
