//! The command line of `cargo xtask`.

use std::{ffi::OsString, path::PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand};

/// Development tasks: gallery, generated tables, benchmarks, checks.
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
    /// Write the generated tables of the crates, or compare them: `cargo xtask tables --help`.
    #[command(disable_help_flag = true)]
    Tables(Forwarded),
    /// Run the benchmarks of the crates.
    #[command(after_help = "Examples:
  cargo xtask bench
  cargo xtask bench --only perlin
  cargo bench --package asperity-noise -- 3-d/perlin

The noise benchmarks cover every kind at every SIMD level.")]
    Bench(Bench),
    /// Benchmark noise against other libraries: `cargo xtask peers --help`.
    #[command(disable_help_flag = true)]
    Peers(Forwarded),
    /// Export the shaders in every shading language, or compare them with the Rust crates on each
    /// adapter.
    #[command(after_help = "Examples:
  cargo xtask shaders
  cargo xtask shaders --part noise/kinds/gaussian --dialect glsl-es-300 --out my-shaders
  cargo xtask shaders --check
  cargo xtask shaders --adapter llvmpipe --part ndf/density

Each function has a directory with its shader in every language and the words of its bindings; `parts` has modules for Bevy. See
docs/guide/shaders.md for wgpu, Bevy, three.js, Godot, Unity and Metal.

Software drivers: Debian's mesa-vulkan-drivers, SwiftShader (part of Chromium). Validators: spirv-tools, glslang-tools. Missing tools are
reported. The first build of tests/gpu takes minutes.")]
    Shaders(Shaders),
    /// Check dependencies between packages, the order of modules, import cycles, and the wording of
    /// pages.
    Tidy,
    /// Run all CI checks.
    Ci(Ci),
    /// Run the fuzz targets.
    #[command(after_help = "Examples:
  cargo xtask fuzz
  cargo xtask fuzz --only gltf --seconds 600
  cargo xtask fuzz --runs 10000000 --seconds 3600 --ship

The targets are in tests/fuzz; libFuzzer needs a C++ compiler. Findings are written to tests/fuzz/target/findings.")]
    Fuzz(Fuzz),
    /// Build the interactive web page: `cargo xtask web --help`.
    #[command(disable_help_flag = true)]
    Web(Forwarded),
    /// Link and run the crates without std and without an allocator.
    #[command(disable_help_flag = true)]
    NoStd(Forwarded),
    /// Compare the values of all crates on every available platform with the golden bits: `cargo
    /// xtask bits --help`.
    #[command(disable_help_flag = true)]
    Bits(Forwarded),
    /// Render on an emulated Cortex-M4 and compare with the host: `cargo xtask firmware --help`.
    #[command(disable_help_flag = true)]
    Firmware(Forwarded),
}

/// Arguments passed to another program.
#[derive(Debug, Args)]
pub(crate) struct Forwarded {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    pub(crate) words: Vec<OsString>,
}

#[derive(Debug, Args)]
pub(crate) struct Ci {
    /// Run only checks whose name contains NAME; may be repeated.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// Also run the weekly checks, which take minutes: slow tests, feature sets, shaders on
    /// drivers, the live page, firmware, bits of every platform, packages in an empty workspace,
    /// fuzz targets.
    #[arg(long, conflicts_with = "only")]
    pub(crate) weekly: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Fuzz {
    /// Run only targets whose name contains NAME; may be repeated.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// Seconds per target.
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) seconds: u32,
    /// Maximum executions per target.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: Option<u32>,
    /// Write the table to target/asperity/fuzz.md.
    #[arg(long, conflicts_with = "only")]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Bench {
    /// Run only benchmarks whose name contains NAME; may be repeated.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
}

/// Shading languages.
const DIALECTS: [&str; 7] = ["wgsl", "glsl-450", "glsl-es-300", "glsl-es-310", "hlsl", "msl", "spirv"];

#[derive(Debug, Args)]
pub(crate) struct Shaders {
    /// Only functions whose name, or the name of a part they need, contains NAME.
    #[arg(long, value_name = "NAME")]
    pub(crate) part: Option<String>,
    /// Export this language only; may be repeated.
    #[arg(long, value_parser = PossibleValuesParser::new(DIALECTS), conflicts_with_all = ["check", "adapter"])]
    pub(crate) dialect: Vec<String>,
    /// List missing and stale files, and compare every function with the Rust crates, interpreted
    /// and on each adapter.
    #[arg(long)]
    pub(crate) check: bool,
    /// Count operations of every function and time frames on each adapter; writes
    /// target/asperity/shaders/costs.md.
    #[arg(long, conflicts_with_all = ["part", "dialect", "check"])]
    pub(crate) costs: bool,
    /// Only adapters whose name contains NAME.
    #[arg(long, value_name = "NAME")]
    pub(crate) adapter: Option<String>,
    /// Output directory.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/shaders")]
    pub(crate) out: PathBuf,
}
