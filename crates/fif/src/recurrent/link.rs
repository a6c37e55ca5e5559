//! A map of a recurrent system with its source.

use crate::numeric::interval::Interval;
use crate::system::map::Piece;

/// A map with its source.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link<const C: usize> {
    pub(crate) piece: Piece<C>,
    /// The knots of the source.
    pub(crate) from: usize,
    pub(crate) to: usize,
    /// Left end and width of the source.
    pub(crate) start: f64,
    pub(crate) width: f64,
    /// An enclosure of `f` over the image.
    pub(crate) range: Interval,
}

impl<const C: usize> Link<C> {
    /// The width of the image.
    pub(crate) fn image(&self) -> f64 {
        self.piece.x()[1] - self.piece.x()[0]
    }
}
