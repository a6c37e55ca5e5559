//! Refusals of arrays that are no packed maps.

use core::fmt;

/// Refusal of an array that is no packed map.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PackedMapError {
    /// The first number is not that of this format.
    Format {
        /// Its value.
        value: f32,
    },
    /// A number of the header is no size.
    Header {
        /// Which one.
        index: usize,
        /// Its bits.
        value: u32,
    },
    /// The array has no header, or is not as long as its header says.
    Length {
        /// Length that it should have.
        expected: u64,
        /// Length that it has.
        got: usize,
    },
}

impl fmt::Display for PackedMapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Format { value } => write!(f, "number 0 must be the format of packed maps, got {value}"),
            Self::Header { index, value } => write!(f, "number {index} must be a size, got {value}"),
            Self::Length { expected, got } => write!(f, "array must have {expected} numbers, got {got}"),
        }
    }
}

impl core::error::Error for PackedMapError {}
