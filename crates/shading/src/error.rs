//! The error of all constructors.

use core::fmt;

use asperity_core::{Short, error_enum};
use glam::Vec3;

error_enum! {
    /// Error of every constructor of this crate: an invalid parameter, its value and the rule.
    ///
    /// ```
    /// use asperity_shading::{Carpet, CarpetParameters, ShadingError};
    ///
    /// let error = Carpet::new(CarpetParameters { seams_amplitude: 1.5, ..Default::default() }).unwrap_err();
    /// assert_eq!(error.to_string(), "`seams_amplitude` must be between 0 and 1, got 1.5");
    /// assert!(matches!(error, ShadingError::OutOfRange { parameter: "seams_amplitude", value: 1.5, .. }));
    /// ```
    pub enum ShadingError {
        /// A number is outside its closed range or NaN.
        OutOfRange { parameter: &'static str, value: f32, min: f32, max: f32 } =>
            "`{parameter}` must be {}, got {}", Range(min, max), Short(value);
        /// A number is not finite and positive.
        NotPositive { parameter: &'static str, value: f32 } =>
            "`{parameter}` must be finite and positive, got {}", Short(value);
        /// An index of refraction is neither 0 nor at least 1.
        Ior { parameter: &'static str, value: f32 } =>
            "`{parameter}` must be 0, or finite and at least 1, got {}", Short(value);
        /// A direction is zero or not finite; the third component of a direction in the plane is 0.
        Direction { parameter: &'static str, value: Vec3 } =>
            "`{parameter}` must be a finite, non-zero vector, got {value}";
        /// A size is outside its range.
        Size { parameter: &'static str, value: usize, min: usize, max: usize } =>
            "`{parameter}` must be between {min} and {max}, got {value}";
        /// The length of a slice does not match another parameter.
        Length { parameter: &'static str, expected: usize, got: usize } =>
            "`{parameter}` must have {expected} elements, got {got}";
        /// A texel `row · width + column` violates its rule; the third component of a slope is 0.
        Element { parameter: &'static str, index: usize, value: Vec3, rule: &'static str } =>
            "`{parameter}[{index}]` must be {rule}, got {value}";
    }
}

impl ShadingError {
    /// The name of the parameter.
    #[must_use]
    pub const fn parameter(&self) -> &'static str {
        match self {
            Self::OutOfRange { parameter, .. }
            | Self::NotPositive { parameter, .. }
            | Self::Ior { parameter, .. }
            | Self::Direction { parameter, .. }
            | Self::Size { parameter, .. }
            | Self::Length { parameter, .. }
            | Self::Element { parameter, .. } => parameter,
        }
    }
}

/// A range of numbers, for messages.
struct Range(f32, f32);

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self(min, f32::MAX) => write!(f, "finite and at least {}", Short(min)),
            Self(min, max) => write!(f, "between {} and {}", Short(min), Short(max)),
        }
    }
}
