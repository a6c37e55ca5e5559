//! Refusals of images and functions that are no densities of normals.

use core::fmt;

/// The most texels a map may have; it then takes 220 MB.
pub const MAX_TEXELS: usize = 1 << 24;

/// Why an image or a function is not a density of normals.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NdfMapError {
    /// The width or the height is 0.
    Empty {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
    },
    /// There are more than [`MAX_TEXELS`] texels.
    TooLarge {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
    },
    /// The slice has not `width · height` texels.
    SizeMismatch {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
        /// The slice's length.
        len: usize,
    },
    /// A texel is NaN or infinite.
    NotFinite {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: f32,
    },
    /// A texel is negative.
    Negative {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: f32,
    },
    /// No texel inside the disk has weight.
    AllBlack {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
    },
}

impl fmt::Display for NdfMapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty { width, height } => write!(f, "map must have texels, got {width} × {height}"),
            Self::TooLarge { width, height } => {
                write!(f, "map must have at most {MAX_TEXELS} texels, got {width} × {height}")
            }
            Self::SizeMismatch { width, height, len } => {
                write!(f, "map of {width} × {height} needs as many texels, got {len}")
            }
            Self::NotFinite { index, value } => write!(f, "texel {index} must be finite, got {value}"),
            Self::Negative { index, value } => write!(f, "texel {index} must not be negative, got {value}"),
            Self::AllBlack { width, height } => {
                write!(f, "map of {width} × {height} is black wherever it shows normals")
            }
        }
    }
}

impl core::error::Error for NdfMapError {}
