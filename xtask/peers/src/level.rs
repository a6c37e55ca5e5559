//! The SIMD levels that code is written for.

use std::fmt;

/// A set of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    /// No explicit SIMD: what the compiler makes of plain code for the target's baseline.
    Scalar,
    /// Named as the processor's makers name it, in lower case.
    Simd(&'static str),
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scalar => "scalar",
            Self::Simd(name) => name,
        })
    }
}
