//! Refusals of arrays whose lengths differ.

use core::{error::Error, fmt};

/// Why a batch was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BatchError {
    /// An array is not as long as the first one.
    LengthMismatch {
        /// Which array, counted from 0 through the inputs and then the outputs.
        array: usize,
        /// The first array's length.
        expected: usize,
        /// Its length.
        found: usize,
    },
}

impl BatchError {
    /// Whether all arrays have one length.
    pub(crate) fn check(inputs: &[&[f32]], outputs: &[&mut [f32]]) -> Result<(), Self> {
        let expected = inputs.first().map_or(0, |input| input.len());
        let lengths = inputs.iter().map(|input| input.len()).chain(outputs.iter().map(|output| output.len()));
        for (array, found) in lengths.enumerate() {
            if found != expected {
                return Err(Self::LengthMismatch { array, expected, found });
            }
        }
        Ok(())
    }
}

impl fmt::Display for BatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LengthMismatch { array, expected, found } => {
                write!(f, "array {array} must have the {expected} elements of the first, got {found}")
            }
        }
    }
}

impl Error for BatchError {}
