//! Error for parameters outside their range.

use core::fmt;

/// Error for a parameter outside its range or NaN.
///
/// ```
/// use asperity_ndf_sampling::Ggx;
///
/// let error = Ggx::new(0.3, -1.0).unwrap_err();
/// assert_eq!(error.to_string(), "`alpha_y` must be between 1e-6 and 1e6, got -1");
/// assert_eq!((error.parameter, error.value), ("alpha_y", -1.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RangeError {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// Smallest allowed value.
    pub least: f32,
    /// Largest allowed value.
    pub most: f32,
    /// The invalid value.
    pub value: f32,
}

impl RangeError {
    /// Returns `value` if it is in the range; the error contains `parameter`.
    pub(crate) fn check(parameter: &'static str, value: f32, [least, most]: [f32; 2]) -> Result<f32, Self> {
        if (least..=most).contains(&value) { Ok(value) } else { Err(Self { parameter, least, most, value }) }
    }
}

impl fmt::Display for RangeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { parameter, least, most, value } = self;
        let [least, most, value] = [least, most, value].map(|&x| Short(x));
        write!(f, "`{parameter}` must be between {least} and {most}, got {value}")
    }
}

impl core::error::Error for RangeError {}

/// Formats a float in scientific notation when it is very small or large.
struct Short(f32);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let x = self.0;
        if x.is_finite() && x != 0.0 && !(1e-3..1e5).contains(&x.abs()) {
            write!(f, "{x:e}")
        } else {
            write!(f, "{x}")
        }
    }
}
