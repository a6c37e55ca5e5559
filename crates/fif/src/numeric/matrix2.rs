//! Products of two-by-two matrices: Jacobians of iterated maps.

use asperity_core::Interval;

/// The identity, the first Jacobian.
pub(crate) const IDENTITY: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];

/// `A B`.
#[inline]
pub(crate) fn product(a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]) -> [[f64; 2]; 2] {
    a.map(|row| [row[0] * b[0][0] + row[1] * b[1][0], row[0] * b[0][1] + row[1] * b[1][1]])
}

/// `Jᵀ g`.
#[inline]
pub(crate) fn transposed(jacobian: &[[f64; 2]; 2], [x, y]: [f64; 2]) -> [f64; 2] {
    let [[a, b], [c, d]] = *jacobian;
    [a * x + c * y, b * x + d * y]
}

/// `sum + Jᵀ g` of ranges.
pub(crate) fn added(sum: [Interval; 2], jacobian: &[[f64; 2]; 2], [x, y]: [Interval; 2]) -> [Interval; 2] {
    [0, 1].map(|k| sum[k].sum(x.scaled(jacobian[0][k])).sum(y.scaled(jacobian[1][k])))
}
