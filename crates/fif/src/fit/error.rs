//! Why data could not be fitted.

use core::fmt;

use crate::system::error::SystemError;

/// Why a fit was refused. Points are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FitError {
    /// The two lists of coordinates differ in length.
    Length {
        /// The number of abscissae.
        x: usize,
        /// The number of ordinates.
        y: usize,
    },
    /// Three points are needed at least.
    TooFewPoints {
        /// The number of points.
        points: usize,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Which point.
        point: usize,
        /// Its abscissa.
        x: f64,
        /// Its ordinate.
        y: f64,
    },
    /// A point does not lie to the right of the one before.
    Order {
        /// Which point.
        point: usize,
        /// The abscissa before.
        left: f64,
        /// Its abscissa.
        right: f64,
    },
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
    /// The system of the fit was refused.
    System {
        /// Its refusal.
        error: SystemError,
    },
}

impl fmt::Display for FitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Length { x, y } => write!(f, "`y` must have {x} elements, got {y}"),
            Self::TooFewPoints { points } => write!(f, "`x` must have at least 3 elements, got {points}"),
            Self::NotFinite { point, x, y } => {
                write!(f, "`x` and `y` must be finite, got ({x}, {y}) at point {point}")
            }
            Self::Order { point, left, right } => {
                write!(f, "`x[{point}]` must be right of {left}, got {right}")
            }
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
    if x.len() != y.len() {
        return Err(FitError::Length { x: x.len(), y: y.len() });
    }
    if x.len() < 3 {
        return Err(FitError::TooFewPoints { points: x.len() });
    }
    for (point, (&x, &y)) in x.iter().zip(y).enumerate() {
        if !(x.is_finite() && y.is_finite()) {
            return Err(FitError::NotFinite { point, x, y });
        }
    }
    for (point, (&left, &right)) in x.iter().zip(x.iter().skip(1)).enumerate() {
        if left >= right {
            return Err(FitError::Order { point: point + 1, left, right });
        }
    }
    Ok(())
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
