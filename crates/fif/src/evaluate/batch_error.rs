//! Why a batch of points is refused.

use core::fmt;

/// Why a batch was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BatchError {
    /// There are not as many places for values as points.
    LengthMismatch {
        /// The number of points.
        expected: usize,
        /// The number of places.
        found: usize,
    },
}

impl BatchError {
    pub(crate) fn check(expected: usize, found: usize) -> Result<(), Self> {
        if expected == found { Ok(()) } else { Err(Self::LengthMismatch { expected, found }) }
    }
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LengthMismatch { expected, found } => {
                write!(f, "{expected} values are needed, there is room for {found}")
            }
        }
    }
}

impl core::error::Error for BatchError {}
