//! Error for square tables.

use asperity_core::error_enum;

/// The maximum side of a square table.
const MAX_SIZE: usize = 4096;

error_enum! {
    /// Error for an invalid square table.
    #[derive(Eq)]
    pub enum NormalLutError {
        /// The size is 0 or above 4096.
        Size { value: usize } => "`size` must be between 1 and {MAX_SIZE}, got {value}";
        /// The length of the slice is not `size · size`.
        Entries { expected: usize, got: usize } => "`entries` must have {expected} elements, got {got}";
    }
}

impl NormalLutError {
    /// Checks that a table may have `size · size` entries and that `len` matches.
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
