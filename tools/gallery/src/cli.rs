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
    /// Draw only figures whose name contains NAME; may be repeated.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// List the figures and exit.
    #[arg(long)]
    pub(crate) list: bool,
    /// Quality preset; --size and --spp override it.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) quality: Quality,
    /// Side of a square panel in pixels [default: 384; draft 192, book 1024].
    #[arg(long, value_parser = clap::value_parser!(u32).range(16..=4096))]
    pub(crate) size: Option<u32>,
    /// Samples per pixel; some figures use a multiple, path-traced scenes as many as they need
    /// [default: 4; draft 1, book 32].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) spp: Option<u32>,
    /// Random seed.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u32,
    /// Redraw existing figures.
    #[arg(long)]
    pub(crate) force: bool,
    /// Output directory.
    #[arg(long, value_name = "DIR", default_value = "target/asperity")]
    pub(crate) out: PathBuf,
    /// Number of threads [default: all cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) jobs: Option<u16>,
}
