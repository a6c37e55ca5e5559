//! Refusals of arrays that are no packed maps.

use core::fmt;

use crate::map::packed::record::HEADER;

/// Why an array is no packed map.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PackedMapError {
    /// The array is shorter than a header.
    NoHeader {
        /// Its length.
        len: usize,
    },
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
    /// The array is not as long as its header says.
    Length {
        /// How long it should be.
        expected: u64,
        /// How long it is.
        len: usize,
    },
}

impl fmt::Display for PackedMapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoHeader { len } => write!(f, "packed map must have {HEADER} numbers at least, got {len}"),
            Self::Format { value } => write!(f, "packed map must begin with its format, got {value}"),
            Self::Header { index, value } => {
                write!(f, "number {index} of a packed map must be a size, got {value}")
            }
            Self::Length { expected, len } => {
                write!(f, "packed map must have the {expected} numbers that its header says, got {len}")
            }
        }
    }
}

impl core::error::Error for PackedMapError {}
