//! Roughness: which values of `alpha_x` and `alpha_y` a microfacet density accepts.

use core::fmt;

/// The smallest roughness: below it `1/(π α²)` and its products leave the range of `f32`.
pub const MIN_ALPHA: f32 = 1e-6;

/// The largest roughness: above it normals at the horizon leave the range of `f32`.
pub const MAX_ALPHA: f32 = 1e6;

/// Why a pair of roughnesses was refused; `parameter` is `"alpha_x"` or `"alpha_y"`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RoughnessError {
    /// The roughness is NaN or infinite.
    NotFinite {
        /// Which roughness.
        parameter: &'static str,
        /// Its value.
        value: f32,
    },
    /// The roughness is zero or negative.
    NotPositive {
        /// Which roughness.
        parameter: &'static str,
        /// Its value.
        value: f32,
    },
    /// The roughness is outside [`MIN_ALPHA`], [`MAX_ALPHA`].
    OutOfRange {
        /// Which roughness.
        parameter: &'static str,
        /// Its value.
        value: f32,
    },
}

impl fmt::Display for RoughnessError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { parameter, value } => write!(f, "{parameter} must be finite, got {value}"),
            Self::NotPositive { parameter, value } => write!(f, "{parameter} must be positive, got {value}"),
            Self::OutOfRange { parameter, value } => {
                write!(f, "{parameter} must be between {MIN_ALPHA:e} and {MAX_ALPHA:e}, got {value:e}")
            }
        }
    }
}

impl core::error::Error for RoughnessError {}

/// `value` if it is a roughness; the error names `parameter`.
fn check(parameter: &'static str, value: f32) -> Result<f32, RoughnessError> {
    if !value.is_finite() {
        Err(RoughnessError::NotFinite { parameter, value })
    } else if value <= 0.0 {
        Err(RoughnessError::NotPositive { parameter, value })
    } else if !(MIN_ALPHA..=MAX_ALPHA).contains(&value) {
        Err(RoughnessError::OutOfRange { parameter, value })
    } else {
        Ok(value)
    }
}

/// Both roughnesses, checked.
pub(crate) fn check_both(alpha_x: f32, alpha_y: f32) -> Result<[f32; 2], RoughnessError> {
    Ok([check("alpha_x", alpha_x)?, check("alpha_y", alpha_y)?])
}

/// The nearest valid roughness; NaN becomes 1, dull rather than a mirror.
pub(crate) fn clamp(value: f32) -> f32 {
    if value.is_nan() { 1.0 } else { value.clamp(MIN_ALPHA, MAX_ALPHA) }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::string::ToString;

    #[test]
    fn refusals_name_the_culprit_and_its_value() {
        for (x, y, text) in [
            (f32::NAN, 0.5, "alpha_x must be finite, got NaN"),
            (0.5, f32::INFINITY, "alpha_y must be finite, got inf"),
            (0.0, 0.5, "alpha_x must be positive, got 0"),
            (0.5, -0.25, "alpha_y must be positive, got -0.25"),
            (1e-7, 0.5, "alpha_x must be between 1e-6 and 1e6, got 1e-7"),
        ] {
            assert_eq!(check_both(x, y).unwrap_err().to_string(), text);
        }
        assert_eq!(check_both(MIN_ALPHA, MAX_ALPHA), Ok([MIN_ALPHA, MAX_ALPHA]));
    }

    #[test]
    fn clamp_repairs_every_value() {
        for (dirty, clean) in
            [(f32::NAN, 1.0), (f32::INFINITY, MAX_ALPHA), (-1.0, MIN_ALPHA), (0.0, MIN_ALPHA), (0.3, 0.3)]
        {
            assert_eq!(clamp(dirty), clean, "{dirty}");
        }
    }
}
