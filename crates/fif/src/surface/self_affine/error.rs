//! Why data of a self-affine surface are refused.

use core::fmt;

/// The refusal of a [`Torus`](crate::Torus), a [`Folded`](crate::Folded) or a [`RoughFolded`](crate::RoughFolded) surface. Axes are 0 and 1; knots, cells and
/// nodes are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SelfAffineError {
    /// The number of nodes along a side of a torus is no power of two between 2 and 2¹⁵.
    Side {
        /// The number of nodes along a side.
        side: usize,
    },
    /// The matrix of a torus makes fewer than two replicas, `|det M| < 2`.
    Determinant {
        /// The determinant.
        determinant: i64,
    },
    /// An axis of a folded surface has fewer than three knots, so nothing is folded.
    TooFewKnots {
        /// The axis.
        axis: usize,
        /// The number of its knots.
        knots: usize,
    },
    /// A knot is NaN or infinite, or not greater than the one before by more than the rounding of the domain.
    NotIncreasing {
        /// The axis.
        axis: usize,
        /// The knot.
        knot: usize,
        /// Its place.
        value: f64,
    },
    /// A list is not as long as there are nodes.
    Length {
        /// The list.
        parameter: &'static str,
        /// The length that fits.
        expected: usize,
        /// Its length.
        got: usize,
    },
    /// The vertical factor is NaN or too large for slopes to converge: `|s| ‖M‖₂ ≥ 1` on a torus, no smaller than the share
    /// of the narrowest cell on a folded grid.
    Factor {
        /// The vertical factor `s`.
        factor: f64,
        /// The least magnitude that is too large.
        most: f64,
    },
    /// The vertical factor at a node is NaN or no smaller than 1 in magnitude, so values do not converge.
    NodeFactor {
        /// The node.
        node: [usize; 2],
        /// The vertical factor there.
        factor: f64,
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

impl fmt::Display for SelfAffineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Side { side } => write!(f, "`side` must be a power of two from 2 to 32768, got {side}"),
            Self::Determinant { determinant } => {
                write!(f, "`matrix` must have a determinant of magnitude 2 at least, got {determinant}")
            }
            Self::TooFewKnots { axis, knots } => {
                write!(f, "`{}` must have 3 knots at least, got {knots}", ["x", "y"][axis & 1])
            }
            Self::NotIncreasing { axis, knot, value } => {
                let axis = ["x", "y"][axis & 1];
                write!(f, "`{axis}[{knot}]` must be finite and beyond the knot before, got {value}")
            }
            Self::Length { parameter, expected, got } => {
                write!(f, "`{parameter}` must have {expected} elements, got {got}")
            }
            Self::Factor { factor, most } => {
                write!(f, "`factor` must be under {most} in magnitude, got {factor}")
            }
            Self::NodeFactor { node: [i, j], factor } => {
                write!(f, "`factors` must be under 1 in magnitude, got {factor} at node ({i}, {j})")
            }
            Self::NotFinite { node: [i, j], value } => {
                write!(f, "`z` and `d` must be finite, got {value} at node ({i}, {j})")
            }
            Self::TooLarge { magnitude } => {
                write!(f, "`z` and `d` must leave room for bounds, got a magnitude of {magnitude}")
            }
        }
    }
}

impl core::error::Error for SelfAffineError {}

/// The greatest magnitudes of heights and of both slopes, when there are as many as nodes and all are finite; `columns` nodes
/// make a row.
pub(crate) fn magnitudes(
    expected: usize,
    columns: usize,
    z: &[f64],
    d: &[[f64; 2]],
) -> Result<[f64; 3], SelfAffineError> {
    for (parameter, got) in [("z", z.len()), ("d", d.len())] {
        if got != expected {
            return Err(SelfAffineError::Length { parameter, expected, got });
        }
    }
    let mut magnitudes = [0.0_f64; 3];
    for (index, (&z, &[x, y])) in z.iter().zip(d).enumerate() {
        for (most, value) in magnitudes.iter_mut().zip([z, x, y]) {
            if !value.is_finite() {
                let node = [index / columns.max(1), index % columns.max(1)];
                return Err(SelfAffineError::NotFinite { node, value });
            }
            *most = most.max(value.abs());
        }
    }
    Ok(magnitudes)
}
