//! Why numbers were refused as a normal map.

use core::fmt;

use glam::{Vec2, Vec3};

/// Why numbers are no normal map with levels.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SlopePyramidError {
    /// The width or the height is 0.
    Empty {
        /// The width.
        width: usize,
        /// The height.
        height: usize,
    },
    /// There are more than 2²⁶ texels.
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
    /// The slice for the levels has another length than they need.
    LevelsMismatch {
        /// The length that they need.
        needed: usize,
        /// Its length.
        len: usize,
    },
    /// A value is not finite or beyond 10⁶.
    Value {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: Vec2,
    },
    /// A normal is below the horizon or no number.
    Normal {
        /// Which texel, `row · width + column`.
        index: usize,
        /// Its value.
        value: Vec3,
    },
}

impl fmt::Display for SlopePyramidError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty { width, height } => write!(f, "normal map must have texels, got {width} × {height}"),
            Self::TooLarge { width, height } => {
                write!(f, "normal map must have at most {MAX_TEXELS} texels, got {width} × {height}")
            }
            Self::SizeMismatch { width, height, len } => {
                write!(f, "normal map of {width} × {height} needs as many texels, got {len}")
            }
            Self::LevelsMismatch { needed, len } => {
                write!(f, "levels need {needed} lobes, got {len}")
            }
            Self::Value { index, value } => {
                write!(f, "texel {index} must be at most {FARTHEST:e} in each coordinate, got {value}")
            }
            Self::Normal { index, value } => {
                write!(f, "texel {index} must be a normal above the horizon, got {value}")
            }
        }
    }
}

impl core::error::Error for SlopePyramidError {}

/// The most texels of a map.
const MAX_TEXELS: usize = 1 << 26;

/// The largest coordinate: squares of it, and sums over a map, stay far within `f32`.
const FARTHEST: f32 = 1e6;

/// The number of texels of a map of this size.
pub(super) const fn texel_count(width: usize, height: usize) -> Result<usize, SlopePyramidError> {
    match width.checked_mul(height) {
        Some(0) => Err(SlopePyramidError::Empty { width, height }),
        Some(texels) if texels <= MAX_TEXELS => Ok(texels),
        _ => Err(SlopePyramidError::TooLarge { width, height }),
    }
}

/// Refuses another number of texels than there should be, and the first value that is none.
pub(super) fn check_values(width: usize, height: usize, values: &[Vec2]) -> Result<(), SlopePyramidError> {
    if values.len() != texel_count(width, height)? {
        return Err(SlopePyramidError::SizeMismatch { width, height, len: values.len() });
    }
    for (index, &value) in values.iter().enumerate() {
        if !(value.x.abs() <= FARTHEST && value.y.abs() <= FARTHEST) {
            return Err(SlopePyramidError::Value { index, value });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::string::ToString;

    #[test]
    fn refusals_name_the_culprit() {
        let refused = |width, height, values: &[Vec2]| check_values(width, height, values).unwrap_err();
        assert_eq!(refused(0, 4, &[]).to_string(), "normal map must have texels, got 0 × 4");
        assert_eq!(
            refused(2, 2, &[Vec2::ONE; 3]).to_string(),
            "normal map of 2 × 2 needs as many texels, got 3"
        );
        assert_eq!(
            refused(1, 2, &[Vec2::ONE, Vec2::new(0.0, f32::NAN)]).to_string(),
            "texel 1 must be at most 1e6 in each coordinate, got [0, NaN]"
        );
        assert!(matches!(refused(usize::MAX, 2, &[]), SlopePyramidError::TooLarge { .. }));
    }
}
