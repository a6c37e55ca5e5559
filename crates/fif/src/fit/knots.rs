//! Greedy choice of knots by Mazel and Hayes.

use alloc::vec::Vec;

use crate::fit::collage::{Data, check_points};
use crate::system::error::FifError;

/// Chooses knots among the data so that the collage error at the data is at most `tolerance`.
///
/// The search is greedy and uses few knots.
///
/// From the first point on, each map extends to the farthest point, at most `longest` points away,
/// for which the optimal scaling misses no point between by more than `tolerance`. A map to the
/// next point misses none. The farthest point is tried first, because the error does not increase
/// with the length: a part that repeats the whole fits, but a piece of it does not. Pass the result
/// to [`affine`](crate::fit::affine) or [`refine`](crate::fit::refine()).
///
/// Time: for each map at most `longest²/2` terms, each with a binary search.
///
/// Mazel and Hayes, *Using iterated function systems to model discrete sequences*, 1992. The
/// vertical scalings are those of least squares, and the criterion is the maximum error, not the
/// mean square.
///
/// ```
/// use asperity_fif::{fit, cochran_2000};
/// let f = cochran_2000::f()?;
/// let x: Vec<f64> = (0..=32).map(|k| f64::from(k) / 16.0).collect();
/// let y: Vec<f64> = x.iter().map(|&x| f.evaluate(x, 1e-14).value).collect();
/// assert_eq!(fit::knots(&x, &y, 1e-12, 32)?, [0, 16, 32]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FifError`]: points that are too few, not finite or not in order; a tolerance that is NaN or
/// negative.
pub fn knots(x: &[f64], y: &[f64], tolerance: f64, longest: usize) -> Result<Vec<usize>, FifError> {
    check_points(x, y)?;
    if tolerance.is_nan() || tolerance < 0.0 {
        return Err(FifError::Tolerance { value: tolerance });
    }
    let (data, last) = (Data { x, y }, x.len() - 1);
    // A single map onto the whole would not contract.
    let longest = longest.clamp(1, last - 1);
    let (mut knots, mut from) = (alloc::vec![0], 0);
    while from < last {
        let farthest = last.min(from + longest);
        let to =
            (from + 2..=farthest).rev().find(|&to| data.misfit(from, to) <= tolerance).unwrap_or(from + 1);
        knots.push(to);
        from = to;
    }
    Ok(knots)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knots_accepts_extreme_arguments() {
        let (x, y) = ([0.0, 1.0, 2.0, 3.0, 4.0], [0.0, 1.0, -1.0, 3.0, 0.5]);
        // If everything fits, two maps remain; if nothing fits, every point is a knot.
        assert_eq!(knots(&x, &y, f64::INFINITY, usize::MAX).unwrap(), [0, 3, 4]);
        assert_eq!(knots(&x, &y, f64::INFINITY, 0).unwrap(), [0, 1, 2, 3, 4]);
        assert!(matches!(knots(&x, &y, -1.0, 4), Err(FifError::Tolerance { .. })));
        assert!(matches!(knots(&x, &y, f64::NAN, 4), Err(FifError::Tolerance { .. })));
        assert!(matches!(knots(&x[..2], &y[..2], 1.0, 4), Err(FifError::TooFew { .. })));
    }
}
