//! A piece of the marginal on which it is one polynomial.

use crate::numeric::bernstein::Cubic;

/// A piece of x in one column of cells, with each end of the chord in one row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Beginning and end.
    pub(crate) x: [f64; 2],
    /// Half the chord there; linear between.
    pub(crate) half_chord: [f64; 2],
    /// `m`, in texels and cells.
    pub(crate) marginal: Cubic,
    /// The part of `m` below the middle of the map.
    pub(crate) below: Cubic,
    /// The column of cells.
    pub(crate) column: u32,
    /// The rows of cells in which the chord begins and ends.
    pub(crate) rows: [u32; 2],
}
