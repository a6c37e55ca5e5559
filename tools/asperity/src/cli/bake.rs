//! Options of `bake`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::cli::noise::{HEIGHTS, NoiseKind};
use crate::cli::render::Material;
use crate::cli::value::{assignment, color, fraction, numbers, positive, share, whole};
use crate::input::images::Images;
use crate::input::words::{Words, one_of};

/// Options of `bake`.
#[derive(Debug, Args)]
pub struct Bake {
    /// fBm of this noise as a height field [default: gaussian].
    #[arg(long, group = "surface", value_parser = one_of(HEIGHTS))]
    pub noise: Option<NoiseKind>,
    /// Bumps whose normals have this NDF, as in `tables`; without a height map.
    #[arg(long, group = "surface")]
    pub ndf: Option<String>,
    /// A fractal surface.
    #[arg(long, group = "surface", value_enum)]
    pub fractal: Option<BakedFractal>,
    /// A material of `render` on a flat square.
    #[arg(long, group = "surface", value_enum)]
    pub material: Option<Material>,
    /// Set a parameter of the material; may be repeated. `render --help-material` lists them.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, requires = "material")]
    pub set: Vec<(String, String)>,
    /// Side of the square in meters, for --material.
    #[arg(long, default_value_t = 0.25, value_parser = positive, requires = "material")]
    pub side: f32,
    /// Options for images.
    #[command(flatten)]
    pub images: Images,
    /// Texels along a side, a power of two.
    #[arg(long, default_value_t = 1024, value_parser = whole(64, 65_536))]
    pub size: u32,
    /// Texels along the side of a tile, a power of two; determines peak memory.
    #[arg(long, default_value_t = 1024, value_parser = whole(64, 4096))]
    pub tile: u32,
    /// Samples along the side of a texel, 1 or an even number.
    #[arg(long, default_value_t = 2, value_parser = whole(1, 16))]
    pub samples: u32,
    /// Make the texture tileable, or report why it cannot be.
    #[arg(long)]
    pub tileable: bool,
    /// Lattice cells, or nodes of a fractal surface, along a side [default: 8].
    #[arg(long, value_parser = whole(1, 65_536))]
    pub cells: Option<u32>,
    /// Octaves of noise, up to 16 [default: 6].
    #[arg(long, value_parser = whole(1, 16))]
    pub octaves: Option<u32>,
    /// Ratio of the frequencies of consecutive octaves [default: 2 if tileable, else 2.17].
    #[arg(long, value_parser = positive)]
    pub lacunarity: Option<f32>,
    /// Ratio of the amplitudes of consecutive octaves, in (0, 1] [default: 0.5].
    #[arg(long, value_parser = share)]
    pub gain: Option<f32>,
    /// Vertical scaling of a fractal surface, below 0.447; larger is rougher [default: 0.375].
    #[arg(long, value_parser = share)]
    pub scaling: Option<f32>,
    /// Standard deviation of the heights, in sides of the texture [default: 0.01].
    #[arg(long, value_parser = positive)]
    pub height: Option<f32>,
    /// Maximum distance of occluders, in sides of the texture or of each of its --parts [default:
    /// 0.015625].
    #[arg(long, value_parser = share)]
    pub occlusion: Option<f32>,
    /// Color, sRGB in hexadecimal [default: b4b0a8].
    #[arg(long, value_name = "RRGGBB", value_parser = color)]
    pub tint: Option<u32>,
    /// Color of low parts [default: --tint].
    #[arg(long, value_name = "RRGGBB", value_parser = color)]
    pub low_tint: Option<u32>,
    /// Roughness √α of the surface between its bumps [default: 0.6; 0 with --ndf].
    #[arg(long, value_parser = share)]
    pub roughness: Option<f32>,
    /// Metallic, 0 to 1 [default: 0].
    #[arg(long, value_parser = fraction)]
    pub metallic: Option<f32>,
    /// Random seed.
    #[arg(long, default_value_t = 1, value_parser = whole(0, u32::MAX))]
    pub seed: u32,
    /// Formats, separated by commas.
    #[arg(long, value_delimiter = ',', value_parser = one_of(BAKED_FORMATS), default_value = "png")]
    pub format: Vec<BakedFormat>,
    /// Bake only these tiles, counted from 1 row by row; a run without it writes the textures once
    /// all tiles exist.
    #[arg(long, value_name = "N|N-N", value_parser = numbers)]
    pub tiles: Option<[u32; 2]>,
    /// Split the texture into N × N parts of --size texels, each a set in its own directory,
    /// `u1_v1` at the lower left. --cells, --height and --side refer to the whole.
    #[arg(long, value_name = "N", value_parser = whole(2, 16_384), conflicts_with = "tiles")]
    pub parts: Option<u32>,
    /// Bake only these parts, counted from 1 row by row.
    #[arg(long, value_name = "N|N-N", requires = "parts", value_parser = numbers)]
    pub part: Option<[u32; 2]>,
    /// Write an Open Job Description template (.yaml or .json) with one task per tile or part, and
    /// bake nothing.
    #[arg(long, value_name = "FILE")]
    pub job: Option<PathBuf>,
    /// Output directory.
    #[arg(long, value_name = "DIR", default_value = "baked")]
    pub out: PathBuf,
}

const BAKED_FORMATS: &Words<BakedFormat> = &[
    ("png", "16 bits per channel, with a glTF material", BakedFormat::Png),
    ("exr", "Tiled OpenEXR, half floats, all mip levels", BakedFormat::Exr),
    ("ktx2", "Block-compressed (BC7, BC5, BC4), all mip levels", BakedFormat::Ktx2),
];

/// The formats of `bake`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BakedFormat {
    Png,
    Exr,
    Ktx2,
}

/// The fractal surfaces of `bake`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BakedFractal {
    /// The periodic surface, without grain.
    Periodic,
}
