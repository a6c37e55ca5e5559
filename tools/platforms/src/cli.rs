//! The command line of `cargo xtask web`, `no-std`, `bits` and `firmware`.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Builds the crates for other platforms: without std, emulated, embedded, browsers.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version, disable_help_subcommand = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Build the interactive web demo (single HTML file).
    #[command(after_help = "Examples:
  cargo xtask web
  cargo xtask web --serve 8000

index.html works from the file system; the directory `hosted` is for a web server. No network access.")]
    Web(Web),
    /// Link and run the crates without std and without an allocator.
    NoStd,
    /// Compare the values of all crates on every available platform with the golden bits.
    #[command(after_help = "Examples:
  cargo xtask bits
  cargo xtask bits --ship

Platforms: x86-64 at every SIMD level; without std AArch64, big-endian PowerPC, WebAssembly with and without SIMD128, Cortex-M4.
Tools: Debian's qemu-user, qemu-system-arm, gcc-aarch64-linux-gnu, gcc-powerpc64-linux-gnu, lld, nodejs. Missing tools are reported.")]
    Bits(Bits),
    /// Render a picture from tables in flash on an emulated Cortex-M4 and compare it with the host.
    Firmware(Firmware),
    /// Test the live page in browsers.
    #[command(hide = true)]
    Live,
    /// Compare the bits of the platforms that are quick to build.
    #[command(hide = true)]
    SameBits,
}

#[derive(Debug, Args)]
pub(crate) struct Bits {
    /// Make the host's values golden if all platforms agree.
    #[arg(long)]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Firmware {
    /// Write the firmware's table and picture, and print code size, constants and stack of each
    /// function.
    #[arg(long)]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Web {
    /// Serve the page on this port of 127.0.0.1 until Ctrl-C; without a number, on a free port.
    #[arg(long, value_name = "PORT", num_args = 0..=1, default_missing_value = "0")]
    pub(crate) serve: Option<u16>,
    /// Output directory.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/web")]
    pub(crate) out: PathBuf,
}
