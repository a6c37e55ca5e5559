//! Refusals of images and functions that are no densities of normals.

use core::fmt;

/// The most texels a map may have; it then takes 220 MB.
pub const MAX_TEXELS: usize = 1 << 24;

/// Refusal of an image or a function that is no density of normals.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NdfMapError {
    /// The map has no texels, or more than [`MAX_TEXELS`].
    Size {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
    },
    /// The slice has not `width · height` texels.
    Texels {
        /// Number that it needs.
        expected: usize,
        /// Number that it has.
        got: usize,
    },
    /// A texel is NaN, infinite or negative.
    Texel {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: f32,
    },
    /// No texel inside the disk has weight.
    Black {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
    },
}

impl fmt::Display for NdfMapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { width, height } => {
                write!(f, "size must be 1 to {MAX_TEXELS} texels, got {width} × {height}")
            }
            Self::Texels { expected, got } => write!(f, "texels must be {expected}, got {got}"),
            Self::Texel { index, value } => {
                write!(f, "texel {index} must be finite and not negative, got {value}")
            }
            Self::Black { width, height } => {
                write!(f, "texels inside the disk must have weight, got {width} × {height} black ones")
            }
        }
    }
}

impl core::error::Error for NdfMapError {}
