//! The command line, in the words of `--help`.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Builds the crates for other machines: without std, emulated, embedded, in browsers.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version, disable_help_subcommand = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Write the live page: bumps, noise, fractal functions and materials under one's hands, in one file.
    #[command(after_help = "Examples:
  cargo xtask web
  cargo xtask web --serve 8000

index.html opens from the disk; the folder `hosted` is for a web server. Nothing is asked of any network.")]
    Web(Web),
    /// Link the crates without std and without an allocator, and call them.
    NoStd,
    /// Compute every crate's values on every platform at hand, emulated ones too, and compare their bits with the golden ones.
    #[command(after_help = "Examples:
  cargo xtask bits
  cargo xtask bits --ship

x86-64 at every SIMD level and, built without std, AArch64, big-endian PowerPC, WebAssembly with and without SIMD128, and a Cortex-M4
on bare metal. Emulators are Debian's qemu-user and qemu-system-arm; linkers are gcc-aarch64-linux-gnu, gcc-powerpc64-linux-gnu and lld;
WebAssembly runs in node. The table says what is missing.")]
    Bits(Bits),
    /// Draw a picture from tables in flash on an emulated Cortex-M4 and compare it with this machine's, or say what is missing for that.
    Firmware(Firmware),
    /// Check the pages in browsers.
    #[command(hide = true)]
    Live,
    /// Compare the bits of the platforms that take little time.
    #[command(hide = true)]
    SameBits,
}

#[derive(Debug, Args)]
pub(crate) struct Bits {
    /// Make this machine's values golden if every platform has them.
    #[arg(long)]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Firmware {
    /// Write the firmware's table and picture, and print code size, constants and stack of each function.
    #[arg(long)]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Web {
    /// Serve the page on this port of 127.0.0.1, any that is free if none is named, until Ctrl-C.
    #[arg(long, value_name = "PORT", num_args = 0..=1, default_missing_value = "0")]
    pub(crate) serve: Option<u16>,
    /// Folder of the page.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/web")]
    pub(crate) out: PathBuf,
}
