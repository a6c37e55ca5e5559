//! Why an image was refused as an environment.

use core::fmt;

use glam::Vec3;

/// Why numbers are no image of an environment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// The width or the height is 0.
    Empty {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
    },
    /// There are more than 2²⁸ texels.
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
    /// The table for samples has another length than it needs.
    TableMismatch {
        /// The length that it needs.
        needed: usize,
        /// Its length.
        len: usize,
    },
    /// A channel of a texel is NaN or above 10³⁰.
    NotFinite {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: Vec3,
    },
    /// A channel of a texel is negative.
    Negative {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: Vec3,
    },
}

impl fmt::Display for EnvironmentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty { width, height } => write!(f, "image must have texels, got {width} × {height}"),
            Self::TooLarge { width, height } => {
                write!(f, "image must have at most {MAX_TEXELS} texels, got {width} × {height}")
            }
            Self::SizeMismatch { width, height, len } => {
                write!(f, "image of {width} × {height} needs as many texels, got {len}")
            }
            Self::TableMismatch { needed, len } => write!(f, "table needs {needed} numbers, got {len}"),
            Self::NotFinite { index, value } => {
                write!(f, "texel {index} must be at most {BRIGHTEST:e} in each channel, got {value}")
            }
            Self::Negative { index, value } => write!(f, "texel {index} must not be negative, got {value}"),
        }
    }
}

impl core::error::Error for EnvironmentError {}

/// The most texels of an image.
const MAX_TEXELS: usize = 1 << 28;

/// The brightest channel: sums over the greatest image stay far within `f32`.
const BRIGHTEST: f32 = 1e30;

/// The number of texels of an image of this size.
pub(super) const fn texel_count(width: usize, height: usize) -> Result<usize, EnvironmentError> {
    match width.checked_mul(height) {
        Some(0) => Err(EnvironmentError::Empty { width, height }),
        Some(texels) if texels <= MAX_TEXELS => Ok(texels),
        _ => Err(EnvironmentError::TooLarge { width, height }),
    }
}

/// Refuses a texel that is no radiance.
pub(super) fn check_texel(index: usize, value: Vec3) -> Result<(), EnvironmentError> {
    if value.to_array().into_iter().any(|c| c < 0.0) {
        Err(EnvironmentError::Negative { index, value })
    } else if value.to_array().into_iter().all(|c| c <= BRIGHTEST) {
        Ok(())
    } else {
        Err(EnvironmentError::NotFinite { index, value })
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::string::ToString;

    #[test]
    fn refusals_name_the_culprit() {
        let words = |error: EnvironmentError| error.to_string();
        assert_eq!(words(texel_count(0, 4).unwrap_err()), "image must have texels, got 0 × 4");
        assert!(matches!(texel_count(usize::MAX, 2), Err(EnvironmentError::TooLarge { .. })));
        assert_eq!(
            words(check_texel(3, Vec3::new(0.0, -0.5, 1.0)).unwrap_err()),
            "texel 3 must not be negative, got [0, -0.5, 1]"
        );
        assert_eq!(
            words(check_texel(7, Vec3::new(0.0, f32::NAN, 1.0)).unwrap_err()),
            "texel 7 must be at most 1e30 in each channel, got [0, NaN, 1]"
        );
        assert!(
            check_texel(0, Vec3::splat(f32::INFINITY)).is_err() && check_texel(0, Vec3::splat(2e30)).is_err()
        );
        assert_eq!(check_texel(0, Vec3::splat(-0.0)), Ok(()));
    }
}
