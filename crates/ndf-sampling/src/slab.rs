//! A piece of the marginal on which it is one polynomial, and the inverse of its integral.

use crate::bernstein::{Cubic, inverse_share, kept_away, share};
use crate::columns::{Strip, mix, value};
use crate::disk::segment;
use crate::math;

/// What a sample leaves on either side of it where the marginal vanishes at that end of the piece.
///
/// As at the two ends of the disk, the conditional's support would otherwise shrink to a point there, and `u₂` could not be
/// found again. With it `u₂` is found to 10⁻¹⁰, as `u₁` is.
const LEAST_MASS: f64 = 9e-11;

/// A piece of x that lies in one column of cells and in which either end of the chord stays in one row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slab {
    /// Where it begins and ends.
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

impl Slab {
    /// The piece, and its integral of the density inside the circle.
    ///
    /// `t` are the places of its ends in the column of cells, `middle` that of the map's middle, in cells.
    pub(crate) fn new(
        x: [f64; 2],
        half_chord: [f64; 2],
        (column, strip, t): (usize, Strip<'_>, [f64; 2]),
        (height, middle): (f64, f64),
    ) -> (Self, f64) {
        let last = (2.0 * middle) as usize - 1;
        let mean = 0.5 * (half_chord[0] + half_chord[1]) * height;
        let rows = [middle - mean, middle + mean].map(|y| (y as usize).min(last));
        // A chord without length in the middle of the map begins below it nevertheless.
        let lower = middle as usize - usize::from(middle == math::floor_f64(middle));
        let rows = [rows[0].min(lower), rows[1]];
        let ends = [-height, height].map(|height| half_chord.map(|c| middle + height * c));
        let (mut below, rim_below) = side(strip, t, rows[0], ends[0], middle, false);
        let (above, rim_above) = side(strip, t, rows[1], ends[1], middle, true);
        let mut marginal = below;
        for (sum, above) in marginal.iter_mut().zip(above) {
            *sum += above;
        }
        let mean: f64 = 0.25 * marginal.iter().sum::<f64>();
        if mean <= 0.0 {
            (marginal, below) = ([0.0; 4], [0.0; 4]);
        }
        let slab =
            Self { x, half_chord, marginal, below, column: column as u32, rows: rows.map(|row| row as u32) };
        let beyond = if mean > 0.0 { segment(x, half_chord) * height * (rim_below + rim_above) } else { 0.0 };
        (slab, (x[1] - x[0]) * mean + beyond)
    }

    /// Where `x` is in the piece, from 0 to 1.
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

/// `∫ f dy` from one end of the chord to the middle of the map along a piece, in cells, and the density at the rim.
///
/// `end` is where the chord ends at either end of the piece, in cells, `row` the row of that, `t` as for [`Slab::new`].
fn side(strip: Strip<'_>, t: [f64; 2], row: usize, end: [f64; 2], middle: f64, above: bool) -> (Cubic, f64) {
    let corners = strip.corners(row);
    let begin = row as f64;
    let q = end.map(|end| (end - begin).clamp(0.0, 1.0));
    // The line of the row that is nearer to the middle, or the middle itself if it is in the row.
    let (inner, line) =
        if above { ((middle - begin).max(0.0), row) } else { ((middle - begin).min(1.0), row + 1) };
    let whole = if (inner > 0.0) == (inner < 1.0) { [0.0; 2] } else { strip.sums(line).map(f64::abs) };
    let whole = t.map(|t| mix(whole[0], whole[1], t));
    // A bilinear density is a quadratic along the straight rim, whose middle coefficient is the mean of the crossed values.
    let rim = [
        value(corners, t[0], q[0]),
        0.5 * (value(corners, t[0], q[1]) + value(corners, t[1], q[0])),
        value(corners, t[1], q[1]),
    ];
    let inside = t.map(|t| value(corners, t, inner));
    let mean = [
        0.5 * (rim[0] + inside[0]),
        0.5 * (rim[1] + 0.5 * (inside[0] + inside[1])),
        0.5 * (rim[2] + inside[1]),
    ];
    let depth = q.map(|q| if above { (q - inner).max(0.0) } else { (inner - q).max(0.0) });
    let integral = [
        depth[0] * mean[0] + whole[0],
        (2.0 * (depth[0] * mean[1] + whole[0]) + (depth[1] * mean[0] + whole[1])) / 3.0,
        ((depth[0] * mean[2] + whole[0]) + 2.0 * (depth[1] * mean[1] + whole[1])) / 3.0,
        depth[1] * mean[2] + whole[1],
    ];
    (integral, 0.25 * (rim[0] + 2.0 * rim[1] + rim[2]))
}
