//! The command line of `filter`.

use std::path::PathBuf;

use clap::Args;

use crate::input::words::{Words, one_of};

/// Examples and notes of `asperity filter --help`.
pub const EXAMPLES: &str = "Examples:
  asperity filter helmet.glb --out filtered.glb
  asperity filter helmet.glb --out filtered.glb --report
  asperity filter scene/scene.gltf --out filtered/scene.gltf --format zstd
  asperity filter brushed.glb --out filtered.glb --anisotropy
  asperity filter helmet.glb --out filtered.glb --png levels

Each mip level of a normal map loses variance of slopes. The command adds this variance to the roughness of the level, as a new
texture with explicit mip levels. Everything else in the file keeps its bytes. Loaders without KTX2 show the model unfiltered.
A .gltf in another directory gets copies of the files it refers to.";

/// Options of `filter`.
#[derive(Clone, Debug, Args)]
pub struct Filter {
    /// The model: .glb or .gltf.
    #[arg(value_name = "MODEL")]
    pub model: PathBuf,
    /// The filtered model, with the extension of the input.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Encoding of the new textures; `uastc` is the default of a program with the feature `basis`.
    #[arg(long, value_parser = one_of(FORMATS), default_value = if cfg!(feature = "basis") { "uastc" } else { "zstd" })]
    pub format: FilteredFormat,
    /// Store the direction of the variance too, as an anisotropy (KHR_materials_anisotropy).
    #[arg(long)]
    pub anisotropy: bool,
    /// Also write every mip level as a PNG file to this directory, with a list `levels.json`.
    #[arg(long, value_name = "DIR")]
    pub png: Option<PathBuf>,
    /// Print the roughness of every mip level, and the error of the highlight before and after.
    #[arg(long)]
    pub report: bool,
}

const FORMATS: &Words<FilteredFormat> = &[
    ("uastc", "KTX2 with UASTC blocks, as in KHR_texture_basisu", FilteredFormat::Uastc),
    (
        "zstd",
        "KTX2 with uncompressed RGBA; smaller error, not allowed by KHR_texture_basisu, read by three.js",
        FilteredFormat::Zstd,
    ),
];

/// The encodings of `filter`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilteredFormat {
    Uastc,
    Zstd,
}
