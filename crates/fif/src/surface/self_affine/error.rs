//! Error for invalid data of a self-affine surface.

use asperity_core::error_enum;

error_enum! {
    /// Error for an invalid [`PeriodicSurface`](crate::PeriodicSurface), [`FoldedSurface`](crate::FoldedSurface) or
    /// [`RoughFoldedSurface`](crate::RoughFoldedSurface) surface.
    ///
    /// Axes, knots, cells and nodes are counted from 0.
    pub enum SelfAffineError {
        /// The number of nodes along a side of a torus is not a power of two between 2 and 2¹⁵.
        Side { side: usize } => "`side` must be a power of two from 2 to 32768, got {side}";
        /// The matrix of a torus creates fewer than two replicas, `|det M| < 2`.
        Determinant { determinant: i64 } =>
            "`matrix` must have a determinant of magnitude at least 2, got {determinant}";
        /// An axis of a folded surface has fewer than three knots and therefore no fold.
        TooFewKnots { axis: usize, knots: usize } =>
            "`{}` must have at least 3 knots, got {knots}", ["x", "y"][axis & 1];
        /// A knot is NaN or infinite, or not greater than the previous one by more than the
        /// rounding of the domain.
        NotIncreasing { axis: usize, knot: usize, value: f64 } =>
            "`{}[{knot}]` must be finite and greater than the previous knot, got {value}", ["x", "y"][axis & 1];
        /// The length of a list differs from the number of nodes.
        Length { parameter: &'static str, expected: usize, got: usize } =>
            "`{parameter}` must have {expected} elements, got {got}";
        /// The vertical scaling is NaN or too large for slopes to converge, `most` or more.
        ///
        /// `|s| ‖M‖₂ ≥ 1` on a torus, at least the fraction of the narrowest cell on a folded grid.
        Factor { factor: f64, most: f64 } => "`factor` must be under {most} in magnitude, got {factor}";
        /// The vertical scaling at a node is NaN or at least 1 in magnitude, so values do not
        /// converge.
        NodeFactor { node: [usize; 2], factor: f64 } =>
            "`factors` must be under 1 in magnitude, got {factor} at node ({}, {})", node[0], node[1];
        /// A height or a component of a gradient is NaN or infinite.
        NotFinite { node: [usize; 2], value: f64 } =>
            "`z` and `d` must be finite, got {value} at node ({}, {})", node[0], node[1];
        /// The magnitude of heights or gradients is so large that bounds of the surface overflow.
        TooLarge { magnitude: f64 } =>
            "`z` and `d` are too large: magnitude {magnitude} overflows the error bounds";
    }
}

/// The maximum magnitudes of heights and of both slopes.
///
/// Checks that there are as many as nodes, `columns` per row, and that all are finite.
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
