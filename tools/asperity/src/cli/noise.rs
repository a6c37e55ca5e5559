//! Options of `noise`.

use std::path::PathBuf;

use asperity_noise::{CellularOutput, Metric};
use clap::Args;

use crate::cli::value::{finite, positive, share, whole};
use crate::input::words::{Words, one_of};

/// Options of `noise`.
#[derive(Debug, Args)]
pub struct Noise {
    /// Kind of noise.
    #[arg(long, value_parser = one_of(KINDS), default_value = "perlin")]
    pub kind: NoiseKind,
    /// Sum of the octaves.
    #[arg(long, value_parser = one_of(SUMS), default_value = "fbm")]
    pub sum: Sum,
    /// Number of octaves, up to 16.
    #[arg(long, default_value_t = 6, value_parser = whole(1, 16))]
    pub octaves: u32,
    /// Ratio of the frequencies of consecutive octaves.
    #[arg(long, default_value_t = 2.0, value_parser = positive)]
    pub lacunarity: f32,
    /// Ratio of the amplitudes of consecutive octaves, in (0, 1].
    #[arg(long, default_value_t = 0.5, value_parser = share)]
    pub gain: f32,
    /// Output of cellular noise [default: f1].
    #[arg(long, value_parser = one_of(OUTPUTS))]
    pub output: Option<CellularOutput>,
    /// Metric of cellular noise [default: euclidean].
    #[arg(long, value_parser = one_of(METRICS))]
    pub metric: Option<Metric>,
    /// Displace every point by this many lattice cells times fBm of the same kind.
    #[arg(long, value_name = "CELLS", allow_negative_numbers = true, value_parser = finite)]
    pub warp: Option<f32>,
    /// Lattice cells of the first octave along the width.
    #[arg(long, default_value_t = 8, value_parser = whole(1, 65_536))]
    pub cells: u32,
    /// Width and height in samples, as `512` or `512x256`.
    #[arg(long, value_name = "SIZE", default_value = "512", value_parser = sides)]
    pub size: [u32; 2],
    /// Make the field periodic.
    #[arg(long)]
    pub tileable: bool,
    /// Random seed.
    #[arg(long, default_value_t = 1, value_parser = whole(0, u32::MAX))]
    pub seed: u32,
    /// Also write the gradient, per lattice cell; .exr or .npy.
    #[arg(long)]
    pub gradient: bool,
    /// Values of black and white of a .png [default: minimum and maximum].
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true, value_parser = interval)]
    pub range: Option<[f32; 2]>,
    /// Output file: .png (16-bit gray), .exr or .npy (32-bit floats).
    #[arg(long, value_name = "FILE", default_value = "noise.png")]
    pub out: PathBuf,
}

/// Kinds of noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseKind {
    Gaussian,
    Perlin,
    Simplex,
    Value,
    Sparse,
    Cellular,
    White,
}

/// Sums of octaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sum {
    Fbm,
    Turbulence,
    Billow,
    Ridged,
}

/// Kinds that are continuous.
pub(super) const HEIGHTS: &Words<NoiseKind> = KINDS.split_at(KINDS.len() - 1).0;

const KINDS: &Words<NoiseKind> = &[
    ("gaussian", "Exactly Gaussian value-gradient noise", NoiseKind::Gaussian),
    ("perlin", "Perlin noise (2002)", NoiseKind::Perlin),
    ("simplex", "Simplex noise; tileable with a multiple of 3 cells, as a slice of 3-D", NoiseKind::Simplex),
    ("value", "Value noise", NoiseKind::Value),
    ("sparse", "Sparse convolution noise", NoiseKind::Sparse),
    ("cellular", "Cellular (Worley) noise", NoiseKind::Cellular),
    ("white", "White noise, constant in each cell", NoiseKind::White),
];

const SUMS: &Words<Sum> = &[
    ("fbm", "Σ a n", Sum::Fbm),
    ("turbulence", "Σ a |n|", Sum::Turbulence),
    ("billow", "Σ a (2 |n| − 1): round hills with sharp valleys", Sum::Billow),
    ("ridged", "Σ a (1 − |n|)²: sharp ridges", Sum::Ridged),
];

const OUTPUTS: &Words<CellularOutput> = &[
    ("f1", "Distance to the nearest feature point", CellularOutput::F1),
    ("f2", "Distance to the second nearest", CellularOutput::F2),
    ("f2-f1", "F2 − F1, 0 on the borders of the regions", CellularOutput::F2MinusF1),
    ("cell", "A random number of the nearest feature point", CellularOutput::Cell),
];

const METRICS: &Words<Metric> = &[
    ("euclidean", "Round cells", Metric::Euclidean),
    ("manhattan", "Diamonds", Metric::Manhattan),
    ("chebyshev", "Squares", Metric::Chebyshev),
];

fn interval(text: &str) -> Result<[f32; 2], &'static str> {
    let ends = text.split_once(',').map(|(low, high)| [low, high].map(finite));
    match ends {
        Some([Ok(low), Ok(high)]) if low < high => Ok([low, high]),
        _ => Err("must be two numbers in ascending order, such as -1,1"),
    }
}

/// Width and height; one number is both.
fn sides(text: &str) -> Result<[u32; 2], &'static str> {
    let side = |text: &str| text.parse().ok().filter(|n| (1..=65_536).contains(n));
    let (width, height) = text.split_once(['x', '×']).unwrap_or((text, text));
    side(width)
        .zip(side(height))
        .map(Into::into)
        .ok_or("must be one or two integers from 1 to 65536, such as 512x256")
}
