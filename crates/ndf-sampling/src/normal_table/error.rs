//! Refusals of square tables.

use asperity_core::error_enum;

/// The longest side of a square table.
const MAX_SIZE: usize = 4096;

error_enum! {
    /// Refusal of a square table.
    #[derive(Eq)]
    pub enum NormalTableError {
        /// The size is 0 or above 4096.
        Size { value: usize } => "size must be between 1 and {MAX_SIZE}, got {value}";
        /// The slice has not `size · size` entries.
        Entries { expected: usize, got: usize } => "entries must be {expected}, got {got}";
    }
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
