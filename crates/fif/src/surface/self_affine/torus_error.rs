//! Why data of a torus surface are refused.

use core::fmt;

/// Why a [`TorusSurface`](crate::TorusSurface) was refused. Nodes are counted from 0 along both axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TorusError {
    /// The number of nodes along a side is no power of two between 2 and 2¹⁵.
    NotPowerOfTwo {
        /// The number of nodes along a side.
        side: usize,
    },
    /// The lists of heights or of gradients are not as long as the square of the side.
    Length {
        /// The length that fits.
        expected: usize,
        /// The number of heights.
        heights: usize,
        /// The number of gradients.
        gradients: usize,
    },
    /// The storage cannot hold as many nodes.
    Storage {
        /// The number of nodes.
        expected: usize,
        /// What the storage holds.
        found: usize,
    },
    /// The matrix makes fewer than two replicas, `|det M| < 2`.
    Determinant {
        /// The determinant.
        determinant: i64,
    },
    /// The factor is NaN or `|s| ‖M‖₂ ≥ 1`: the sum of slopes does not converge.
    NotContractive {
        /// The vertical factor `s`.
        factor: f64,
        /// `‖M‖₂`, rounded up.
        norm: f64,
    },
    /// A height or a component of a gradient is NaN or infinite.
    NotFinite {
        /// The node.
        node: [usize; 2],
        /// Its value.
        value: f64,
    },
    /// Heights or gradients are so large that bounds of the surface overflow.
    TooLarge {
        /// The greatest magnitude given.
        magnitude: f64,
    },
}

impl fmt::Display for TorusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotPowerOfTwo { side } => {
                write!(f, "the side of the grid has {side} nodes, not a power of two from 2 to 32768")
            }
            Self::Length { expected, heights, gradients } => {
                write!(f, "{expected} heights and gradients are needed, {heights} and {gradients} are given")
            }
            Self::Storage { expected, found } => {
                write!(f, "{expected} places for nodes are needed, the storage has {found}")
            }
            Self::Determinant { determinant } => {
                write!(f, "the matrix has the determinant {determinant}, its magnitude must be 2 at least")
            }
            Self::NotContractive { factor, norm } => write!(
                f,
                "the vertical factor {factor} is not under 1/{norm} in magnitude, the norm of the matrix"
            ),
            Self::NotFinite { node: [i, j], value } => write!(f, "node ({i}, {j}) has the value {value}"),
            Self::TooLarge { magnitude } => {
                write!(f, "heights or slopes of magnitude {magnitude} leave no room for bounds")
            }
        }
    }
}

impl core::error::Error for TorusError {}
