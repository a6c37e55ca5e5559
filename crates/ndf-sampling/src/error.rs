//! The error of all constructors.

use core::fmt;

use asperity_core::{Short, error_enum};

error_enum! {
    /// Error of every constructor of this crate: an invalid parameter, its value and the rule.
    ///
    /// ```
    /// use asperity_ndf_sampling::{Ggx, NdfError};
    ///
    /// let error = Ggx::new(0.3, -1.0).unwrap_err();
    /// assert_eq!(error.to_string(), "`alpha_y` must be between 1e-6 and 1e6, got -1");
    /// assert!(matches!(error, NdfError::OutOfRange { parameter: "alpha_y", value: -1.0, .. }));
    /// ```
    pub enum NdfError {
        /// A parameter is outside its range or NaN.
        OutOfRange { parameter: &'static str, value: f32, min: f32, max: f32 } =>
            "`{parameter}` must be between {} and {}, got {}", Short(min), Short(max), Short(value);
        /// A parameter violates another rule.
        Invalid { parameter: &'static str, value: f32, rule: &'static str } =>
            "`{parameter}` must be {rule}, got {}", Short(value);
        /// A size, or the length of a list, is outside its range.
        Size { parameter: &'static str, value: usize, min: usize, max: usize } =>
            "`{parameter}` must be {}, got {value}", Sizes(min, max);
        /// The length of a list does not match another parameter.
        Length { parameter: &'static str, expected: usize, got: usize } =>
            "`{parameter}` must have {expected} elements, got {got}";
        /// An element of a list violates its rule.
        Element { parameter: &'static str, index: usize, value: f32, rule: &'static str } =>
            "`{parameter}[{index}]` must be {rule}, got {}", Short(value);
        /// A density is 0 everywhere above the horizon, or a list has no normal there.
        NoWeight { parameter: &'static str } =>
            "`{parameter}` must have weight above the horizon, got none";
        /// An NDF depends on the azimuth.
        NotRadial { parameter: &'static str } =>
            "`{parameter}` must depend on the tilt alone, got an NDF that depends on the azimuth";
        /// The ends of an interval are not finite or not increasing.
        Ends { low: f32, high: f32 } =>
            "`low` and `high` must be finite and increasing, got {} and {}", Short(low), Short(high);
        /// A covariance `[xx, xy, yy]` is not finite, not positive definite or out of range.
        Covariance { value: [f32; 3] } =>
            "`covariance` must be positive definite and at most 1e18, got {value:?}";
        /// The CDF of a packed table does not increase from 0 to 1 at this node.
        Cdf { index: usize } => "`packed` must have a CDF that increases from 0 to 1, got another at node {index}";
        /// An array does not begin with the number of the format of packed maps.
        Format { value: f32 } => "not a packed map: bad magic number {value}";
        /// A number of the header of a packed map has these bits, which are not a valid size.
        Header { index: usize, value: u32 } => "header number {index} must be a valid size, got {value}";
    }
}

/// The rule of densities in a list.
pub(crate) const IS_DENSITY: &str = "finite and not negative";

/// Returns `value` if it is in the range; the error contains `parameter`.
pub(crate) fn in_range(parameter: &'static str, value: f32, [min, max]: [f32; 2]) -> Result<f32, NdfError> {
    if (min..=max).contains(&value) {
        Ok(value)
    } else {
        Err(NdfError::OutOfRange { parameter, value, min, max })
    }
}

/// The maximum side of a square table.
const MAX_SIDE: usize = 4096;

/// Checks that a square table may have `size · size` entries and that `len` matches.
pub(crate) const fn square(size: usize, len: Option<usize>) -> Result<(), NdfError> {
    match (size, len) {
        (1..=MAX_SIDE, Some(got)) if got != size * size => {
            Err(NdfError::Length { parameter: "entries", expected: size * size, got })
        }
        (1..=MAX_SIDE, _) => Ok(()),
        _ => Err(NdfError::Size { parameter: "size", value: size, min: 1, max: MAX_SIDE }),
    }
}

/// A range of sizes, for messages.
struct Sizes(usize, usize);

impl fmt::Display for Sizes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self(min, usize::MAX) => write!(f, "at least {min}"),
            Self(min, max) => write!(f, "between {min} and {max}"),
        }
    }
}
