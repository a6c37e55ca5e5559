//! Why data could not be fitted.

use crate::numeric::refusal::refusals;
use crate::system::error::{self as system, SystemError, check_finite, check_length};

refusals! {
    /// Why a fit was refused. Points are counted from 0.
    FitError from SystemError {
        /// The knots are not the indices of three points or more, rising from the first point to the last: entry `at` is
        /// `index`, or the number of points if it is missing.
        Knots { at: usize, index: usize } =>
            "`knots[{at}]` must rise from the first point to the last, three at least, got {index}";
        /// A tolerance is NaN or negative.
        Tolerance { value: f64 } => "`tolerance` must be a number from 0, got {value}";
    }
}

pub(crate) fn check_points(x: &[f64], y: &[f64]) -> Result<(), FitError> {
    check_length("y", x.len(), y.len())?;
    system::check_knots(x)?;
    Ok(check_finite("y", y)?)
}

pub(crate) fn check_knots(points: usize, knots: &[usize]) -> Result<(), FitError> {
    let wrong = |at: usize| FitError::Knots { at, index: knots.get(at).copied().unwrap_or(points) };
    if knots.first() != Some(&0) {
        return Err(wrong(0));
    }
    if knots.len() < 3 {
        return Err(wrong(knots.len()));
    }
    if let Some(at) = (1..knots.len()).find(|&at| knots.get(at) <= knots.get(at - 1)) {
        return Err(wrong(at));
    }
    let last = knots.len() - 1;
    if knots.get(last).copied() != Some(points - 1) { Err(wrong(last)) } else { Ok(()) }
}
