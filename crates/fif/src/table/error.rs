//! Why there is no table for a system.

use core::fmt;

/// The refusal of a table: the vertical factors are so near to one that a bounded number of composites misses the
/// tolerance. [`System::evaluate`](crate::System::evaluate) serves every system.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TableError {
    /// The largest `|α_j|`.
    pub alpha: f64,
    /// Composites that one evaluation may take.
    pub steps: u32,
    /// The error that they would leave.
    pub bound: f64,
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { alpha, steps, bound } = self;
        write!(
            f,
            "`alpha` must leave less than the tolerance after {steps} composites, got {alpha}, which leaves {bound:e}"
        )
    }
}

impl core::error::Error for TableError {}
