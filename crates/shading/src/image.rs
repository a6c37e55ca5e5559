//! Images that are refused, and the checks that refuse them.

use core::fmt;

use glam::Vec3;

/// Why numbers are no image: no environment, or no normal map with levels.
///
/// The example needs the feature `alloc`.
///
#[cfg_attr(feature = "alloc", doc = "```")]
#[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
/// use asperity_shading::{EnvironmentMap, ImageError, glam::Vec3};
///
/// let error = EnvironmentMap::new(1, 2, vec![Vec3::ONE, Vec3::NEG_X]).unwrap_err();
/// assert_eq!(error, ImageError::Negative { index: 1, value: Vec3::NEG_X });
/// assert_eq!(error.to_string(), "texel 1 must not be negative, got [-1, 0, 0]");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ImageError {
    /// The width or the height is 0.
    Empty {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
    },
    /// There are too many texels.
    TooLarge {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
        /// The most texels.
        most: usize,
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
    /// The slice for the table of an environment, or for the levels of a normal map, has another length than they need.
    TableMismatch {
        /// The length that they need.
        needed: usize,
        /// Its length.
        len: usize,
    },
    /// A channel or a coordinate of a texel is NaN or too far from 0.
    TooFar {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value; the third component of a slope is 0.
        value: Vec3,
        /// The greatest magnitude.
        most: f32,
    },
    /// A channel of a texel is negative.
    Negative {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: Vec3,
    },
    /// A normal is below the horizon or no number.
    Normal {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: Vec3,
    },
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty { width, height } => write!(f, "image must have texels, got {width} × {height}"),
            Self::TooLarge { width, height, most } => {
                write!(f, "image must have at most {most} texels, got {width} × {height}")
            }
            Self::SizeMismatch { width, height, len } => {
                write!(f, "image of {width} × {height} needs as many texels, got {len}")
            }
            Self::TableMismatch { needed, len } => write!(f, "table needs {needed} entries, got {len}"),
            Self::TooFar { index, value, most } => {
                write!(f, "texel {index} must be at most {most:e} in each component, got {value}")
            }
            Self::Negative { index, value } => write!(f, "texel {index} must not be negative, got {value}"),
            Self::Normal { index, value } => {
                write!(f, "texel {index} must be a normal above the horizon, got {value}")
            }
        }
    }
}

impl core::error::Error for ImageError {}

/// The number of texels of an image of this size, if it is not 0 and at most this.
pub(crate) const fn texel_count(width: usize, height: usize, most: usize) -> Result<usize, ImageError> {
    match width.checked_mul(height) {
        Some(0) => Err(ImageError::Empty { width, height }),
        Some(texels) if texels <= most => Ok(texels),
        _ => Err(ImageError::TooLarge { width, height, most }),
    }
}

/// Refuses another number of texels than there should be, and the first one that has a component farther from 0 than this.
pub(crate) fn check_texels(
    [width, height]: [usize; 2],
    needed: usize,
    texels: impl ExactSizeIterator<Item = Vec3>,
    most: f32,
) -> Result<(), ImageError> {
    if texels.len() != needed {
        return Err(ImageError::SizeMismatch { width, height, len: texels.len() });
    }
    for (index, value) in texels.enumerate() {
        if !value.abs().cmple(Vec3::splat(most)).all() {
            return Err(ImageError::TooFar { index, value, most });
        }
    }
    Ok(())
}
