//! Linear equations.

/// Solves `M z = right` in place by Gaussian elimination without pivots.
///
/// The matrix is diagonally dominant by columns or positive definite, with its rows `stride` apart.
/// A row without weight yields 0.
pub(crate) fn solve(matrix: &mut [f64], stride: usize, right: &mut [f64]) {
    let n = right.len().min(stride);
    let divide = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a / b };
    for k in 0..n {
        let (above, below) = matrix.split_at_mut((k + 1) * stride);
        let pivots = &above[k * stride..][..n];
        let (known, unknown) = right.split_at_mut(k + 1);
        for (row, right) in below.chunks_mut(stride).zip(unknown) {
            let factor = divide(row[k], pivots[k]);
            for (entry, pivot) in row.iter_mut().zip(pivots).skip(k) {
                *entry -= factor * pivot;
            }
            *right -= factor * known[k];
        }
    }
    for k in (0..n).rev() {
        let row = &matrix[k * stride..][..n];
        let known: f64 = row.iter().zip(&*right).skip(k + 1).map(|(m, x)| m * x).sum();
        right[k] = divide(right[k] - known, row[k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn solve_handles_empty_rows() {
        let mut z = [9.0, 5.0, 0.0];
        solve(&mut [4.0, 1.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 0.0], 3, &mut z);
        assert_abs_diff_eq!(z[0], 2.0, epsilon = 1e-14);
        assert_abs_diff_eq!(z[1], 1.0, epsilon = 1e-14);
        assert_eq!(z[2], 0.0);
    }
}
