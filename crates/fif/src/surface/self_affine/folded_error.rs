//! Why data of a folded surface are refused.

use core::fmt;

/// Why a [`FoldedSurface`](crate::FoldedSurface) was refused. Axes are 0 and 1, knots, cells and nodes are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FoldedError {
    /// An axis has fewer than three knots, so nothing is folded.
    TooFewKnots {
        /// The axis.
        axis: usize,
        /// The number of its knots.
        count: usize,
    },
    /// A knot is NaN or infinite, or not greater than the one before by more than the rounding of the domain.
    NotIncreasing {
        /// The axis.
        axis: usize,
        /// The knot.
        knot: usize,
        /// Where it is.
        value: f64,
    },
    /// The lists of heights or of gradients are not as long as the product of the numbers of knots.
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
    /// The factor is NaN or not smaller in magnitude than the share of the narrowest cell: slopes do not converge.
    NotContractive {
        /// The vertical factor `s`.
        factor: f64,
        /// The axis of the narrowest cell.
        axis: usize,
        /// The narrowest cell.
        cell: usize,
        /// Its width over that of the domain.
        ratio: f64,
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

impl fmt::Display for FoldedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooFewKnots { axis, count } => {
                write!(f, "axis {axis} has {count} knots, three at least are needed")
            }
            Self::NotIncreasing { axis, knot, value } => {
                write!(f, "knot {knot} of axis {axis} at {value} is not finite and beyond the one before")
            }
            Self::Length { expected, heights, gradients } => {
                write!(f, "{expected} heights and gradients are needed, {heights} and {gradients} are given")
            }
            Self::Storage { expected, found } => {
                write!(f, "{expected} places for nodes are needed, the storage has {found}")
            }
            Self::NotContractive { factor, axis, cell, ratio } => write!(
                f,
                "the vertical factor {factor} is not under {ratio} in magnitude, the share of cell {cell} of axis {axis}"
            ),
            Self::NotFinite { node: [i, j], value } => write!(f, "node ({i}, {j}) has the value {value}"),
            Self::TooLarge { magnitude } => {
                write!(f, "heights or slopes of magnitude {magnitude} leave no room for bounds")
            }
        }
    }
}

impl core::error::Error for FoldedError {}
