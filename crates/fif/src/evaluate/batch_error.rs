//! Why a batch of points is refused.

use core::fmt;

/// The refusal of a batch: a list is not as long as the points are many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BatchError {
    /// The list.
    pub parameter: &'static str,
    /// The length that fits.
    pub expected: usize,
    /// Its length.
    pub got: usize,
}

impl BatchError {
    pub(crate) fn check(parameter: &'static str, expected: usize, got: usize) -> Result<(), Self> {
        if expected == got { Ok(()) } else { Err(Self { parameter, expected, got }) }
    }
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` must have {} elements, got {}", self.parameter, self.expected, self.got)
    }
}

impl core::error::Error for BatchError {}
