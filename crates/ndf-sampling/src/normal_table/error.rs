//! Refusals of square tables.

use core::fmt;

/// The longest side of a square table.
pub(crate) const MAX_SIZE: usize = 4096;

/// Refusal of a square table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NormalTableError {
    /// The size is 0 or above 4096.
    Size {
        /// Its value.
        value: usize,
    },
    /// The slice has not `size · size` entries.
    Entries {
        /// Number that it needs.
        expected: usize,
        /// Number that it has.
        got: usize,
    },
}

impl NormalTableError {
    /// Whether a table may have `size · size` entries and has `len`.
    pub(crate) const fn check(size: usize, len: Option<usize>) -> Result<(), Self> {
        match (size, len) {
            (1..=MAX_SIZE, Some(got)) if got != size * size => {
                Err(Self::Entries { expected: size * size, got })
            }
            (1..=MAX_SIZE, _) => Ok(()),
            _ => Err(Self::Size { value: size }),
        }
    }
}

impl fmt::Display for NormalTableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { value } => write!(f, "size must be between 1 and {MAX_SIZE}, got {value}"),
            Self::Entries { expected, got } => write!(f, "entries must be {expected}, got {got}"),
        }
    }
}

impl core::error::Error for NormalTableError {}
