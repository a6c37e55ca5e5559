//! The command line: what can be asked, in the words of `--help`.

use std::{ffi::OsString, path::PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand};

/// Development tasks: the gallery, the generated tables, benches and every check.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version, disable_help_subcommand = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Draw the figures and write their page: `cargo xtask gallery --help`.
    #[command(disable_help_flag = true)]
    Gallery(Forwarded),
    /// Write the tables that the crates ship into the source tree, or compare them: `cargo xtask tables --help`.
    #[command(disable_help_flag = true)]
    Tables(Forwarded),
    /// Run the crates' benches.
    #[command(after_help = "Examples:
  cargo xtask bench
  cargo xtask bench --only perlin
  cargo bench --package asperity-noise -- 3-d/perlin

The benches of noise have every kind at every SIMD level and take a quarter of an hour to build; the last
example builds one kind alone, in two minutes.")]
    Bench(Bench),
    /// Time our noises next to other libraries and write the table: `cargo xtask peers --help`.
    #[command(disable_help_flag = true)]
    Peers(Forwarded),
    /// Write the functions of the shaders in every shading language, or compare them with the crates on adapters.
    #[command(after_help = "Examples:
  cargo xtask shaders
  cargo xtask shaders --part noise/kinds/gaussian --dialect glsl-es-300 --out my-shaders
  cargo xtask shaders --check
  cargo xtask shaders --adapter llvmpipe --part ndf/density

Every function has a folder with its shader in every language and the words of its bindings. The folder `parts` has modules for Bevy.
docs/guide/shaders.md shows the use in wgpu, Bevy, three.js, Godot, Unity and Metal.

Drivers in software are Debian's mesa-vulkan-drivers, and SwiftShader, which comes with Chromium; validators are those of
spirv-tools and glslang-tools. Missing tools are reported. The program is built in tests/gpu, which takes minutes the first time.")]
    Shaders(Shaders),
    /// Check dependency edges, the order of rooms, circles of files, and the heads of all files.
    Tidy,
    /// Run every gate that stands before `main`.
    Ci(Ci),
    /// Attack every constructor, evaluation and reader with what a fuzzer makes up.
    #[command(after_help = "Examples:
  cargo xtask fuzz
  cargo xtask fuzz --only gltf --seconds 600
  cargo xtask fuzz --runs 10000000 --seconds 3600 --ship

The attacks are in tests/fuzz; libFuzzer is C++ and is built with them. What breaks a promise is kept in tests/fuzz/target/findings.")]
    Fuzz(Fuzz),
    /// Build the interactive web page: `cargo xtask web --help`.
    #[command(disable_help_flag = true)]
    Web(Forwarded),
    /// Link the crates without std and without an allocator, and call them.
    #[command(disable_help_flag = true)]
    NoStd(Forwarded),
    /// Compare every crate's values on every platform at hand, emulated ones included, with the golden bits: `cargo xtask bits --help`.
    #[command(disable_help_flag = true)]
    Bits(Forwarded),
    /// Draw a picture from tables in flash on an emulated Cortex-M4 and compare it: `cargo xtask firmware --help`.
    #[command(disable_help_flag = true)]
    Firmware(Forwarded),
}

/// Options of another program, handed on as they are.
#[derive(Debug, Args)]
pub(crate) struct Forwarded {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    pub(crate) words: Vec<OsString>,
}

#[derive(Debug, Args)]
pub(crate) struct Ci {
    /// Run only the gates whose name contains NAME; may be given again.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// Run the weekly gates too, which take minutes: feature sets, shaders on drivers, the live page, firmware,
    /// bits of every platform, packages in an empty workspace, fuzz targets.
    #[arg(long, conflicts_with = "only")]
    pub(crate) weekly: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Fuzz {
    /// Run only the attacks whose name contains NAME; may be given again.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// Seconds of every attack.
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) seconds: u32,
    /// The most executions of every attack.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: Option<u32>,
    /// Write the table to target/asperity/fuzz.md.
    #[arg(long, conflicts_with = "only")]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Bench {
    /// Run only the benches whose name contains NAME; may be given again.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
}

/// Languages that shaders are written in.
const DIALECTS: [&str; 7] = ["wgsl", "glsl-450", "glsl-es-300", "glsl-es-310", "hlsl", "msl", "spirv"];

#[derive(Debug, Args)]
pub(crate) struct Shaders {
    /// Only functions whose names, or those of the parts they need, contain NAME.
    #[arg(long, value_name = "NAME")]
    pub(crate) part: Option<String>,
    /// Write this language only; may be given again.
    #[arg(long, value_parser = PossibleValuesParser::new(DIALECTS), conflicts_with_all = ["check", "adapter"])]
    pub(crate) dialect: Vec<String>,
    /// Say which files are missing or stale, and compare every function with the crate's, interpreted and on each adapter.
    #[arg(long)]
    pub(crate) check: bool,
    /// Count the operations of every function, octave and pixel, and time frames on each adapter, into target/asperity/shaders/costs.md.
    #[arg(long, conflicts_with_all = ["part", "dialect", "check"])]
    pub(crate) costs: bool,
    /// Compare, or time, on adapters whose name contains NAME.
    #[arg(long, value_name = "NAME")]
    pub(crate) adapter: Option<String>,
    /// Folder of the shaders.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/shaders")]
    pub(crate) out: PathBuf,
}
