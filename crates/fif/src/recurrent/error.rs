//! Why a recurrent system is refused.

use core::fmt;

use crate::system::error::SystemError;

/// Why a recurrent system was refused. Maps are counted from 1, as in the literature, knots from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RecurrentError {
    /// A rule of every system of maps is broken.
    System {
        /// Its refusal.
        error: SystemError,
    },
    /// A source does not go from a knot to a later one.
    Source {
        /// Whose source.
        map: usize,
        /// Its first knot.
        from: usize,
        /// Its last knot.
        to: usize,
        /// The last knot of all.
        last: usize,
    },
    /// A source is no wider than its image.
    Expansion {
        /// Whose source.
        map: usize,
        /// The width of the source.
        source: f64,
        /// The width of its image.
        image: f64,
    },
}

impl From<SystemError> for RecurrentError {
    fn from(error: SystemError) -> Self {
        Self::System { error }
    }
}

impl fmt::Display for RecurrentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::System { error } => error.fmt(f),
            Self::Source { map, from, to, last } => {
                write!(f, "`sources` of map {map} must rise within 0 to {last}, got {from} to {to}")
            }
            Self::Expansion { map, source, image } => {
                write!(f, "`sources` of map {map} must be wider than its image of {image}, got {source}")
            }
        }
    }
}

impl core::error::Error for RecurrentError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::System { error } => Some(error),
            _ => None,
        }
    }
}
