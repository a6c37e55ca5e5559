//! A piece of the marginal on which it is one polynomial, and the inverse of its integral.

use crate::map::columns::mix;
use crate::numeric::bernstein::{Cubic, inverse_share, kept_away, share};

/// Weight that a sample leaves on either side of it where the marginal vanishes at that end of the piece.
///
/// Like at the two ends of the disk, the conditional's support would otherwise shrink to a point there, and `u₂` could not be
/// found again. With it `u₂` is found to 10⁻¹⁰, as `u₁` is.
const LEAST_MASS: f64 = 9e-11;

/// A piece of x that lies in one column of cells and in which either end of the chord stays in one row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Beginning and end.
    pub(crate) x: [f64; 2],
    /// Half the chord there; it is linear between.
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

impl Piece {
    /// Place of `x` in the piece, from 0 to 1.
    #[inline]
    pub(crate) fn place(&self, x: f64) -> f64 {
        ((x - self.x[0]) / (self.x[1] - self.x[0])).clamp(0.0, 1.0)
    }

    /// Half the chord at place `s`.
    #[inline]
    pub(crate) fn half_chord(&self, s: f64) -> f64 {
        mix(self.half_chord[0], self.half_chord[1], s)
    }

    /// Which share of the piece's weight is before place `s`.
    #[inline]
    pub(crate) fn share(&self, s: f64) -> f64 {
        share(self.marginal, s)
    }

    /// The place before which there is the share `share` of the piece's weight `mass`, and its x.
    pub(crate) fn inverse(&self, share: f64, mass: f64) -> (f64, f64) {
        let s = inverse_share(self.marginal, kept_away(self.marginal, share, LEAST_MASS / mass));
        let x = (self.x[0] + (self.x[1] - self.x[0]) * s).clamp(self.x[0], self.x[1].next_down());
        // The place of the rounded x, which is what the way back finds.
        (self.place(x), x)
    }
}
