//! Why data could not be fitted.

use core::fmt;

use crate::system::error::{self as system, SystemError, check_finite, check_length};

/// Why a fit was refused. Points are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FitError {
    /// The knots are not the indices of three points or more, rising from the first point to the last.
    Knots {
        /// The position in the list of knots.
        at: usize,
        /// The index that stands there, or the number of points when one is missing.
        index: usize,
    },
    /// A tolerance is NaN or negative.
    Tolerance {
        /// Its value.
        value: f64,
    },
    /// A rule of every system of maps is broken, by the data or by the fit.
    System {
        /// Its refusal.
        error: SystemError,
    },
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Knots { at, index } => {
                write!(
                    f,
                    "`knots[{at}]` must rise from the first point to the last, three at least, got {index}"
                )
            }
            Self::Tolerance { value } => write!(f, "`tolerance` must be a number from 0, got {value}"),
            Self::System { error } => error.fmt(f),
        }
    }
}

impl core::error::Error for FitError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::System { error } => Some(error),
            _ => None,
        }
    }
}

impl From<SystemError> for FitError {
    fn from(error: SystemError) -> Self {
        Self::System { error }
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
