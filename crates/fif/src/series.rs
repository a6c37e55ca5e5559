//! How far a sum over composites must go, and how much it may then be wrong.

use crate::composites::TableError;
use crate::interval::Interval;
use crate::map::Piece;
use crate::polynomial::UNIT;
use crate::system::Fif;

/// Composites that one evaluation takes at most.
pub(crate) const MOST: u32 = 64;

/// The sum `Σ_{k < K} W_k P_k + W_K tail`, every factor of `W_k` at most `ratio` in size.
pub(crate) struct Series {
    pub(crate) ratio: f64,
    /// `max |P_k|`.
    pub(crate) largest: f64,
    /// Bound of the error of one `P_k` as it is evaluated.
    pub(crate) row: f64,
    /// Relative error of one factor of `W_k` and of the product, in units of rounding.
    pub(crate) roundings: f64,
    /// What the tail lies in.
    pub(crate) tail: Interval,
    /// The size of what is added to the sum.
    pub(crate) scale: f64,
    /// The number of steps after which nothing is left.
    pub(crate) end: u32,
    /// An error that does not depend on the depth.
    pub(crate) lost: f64,
}

/// How many steps, and the error that they leave.
pub(crate) struct Depth {
    pub(crate) steps: u32,
    pub(crate) bound: f64,
}

impl Series {
    /// The least number of steps within the tolerance, else the one with the least bound; or the least bound, when
    /// more steps than [`MOST`] would have lessened it.
    pub(crate) fn depth(&self, tolerance: f64) -> Result<Depth, f64> {
        let (radius, most) = (0.5 * self.tail.width(), self.tail.magnitude());
        let (mut weight, mut weights, mut counts) = (1.0_f64, 0.0_f64, 0.0_f64);
        let mut best = Depth { steps: MOST, bound: f64::INFINITY };
        let mut left = f64::INFINITY;
        for steps in 1..=MOST.min(self.end) {
            let k = f64::from(steps);
            // Σ |W_k| and Σ k |W_k|.
            weights += weight;
            counts += (k - 1.0) * weight;
            weight *= self.ratio;
            let rounding = weights * self.row
                + counts * self.roundings * UNIT * self.largest
                + (k + 3.0) * UNIT * (self.scale + weights * self.largest + most)
                + weight * most * (k * self.roundings + 2.0) * UNIT;
            let truncation = if steps == self.end { 0.0 } else { weight * radius };
            let bound = 1.001 * (truncation + rounding) + self.lost;
            if bound < best.bound {
                best = Depth { steps, bound };
            }
            left = truncation - rounding;
            if bound <= tolerance {
                return Ok(best);
            }
        }
        // Written so that NaN is refused too.
        if left <= 0.0 && best.bound.is_finite() { Ok(best) } else { Err(best.bound) }
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize> Fif<S, C> {
    /// The refusal of a table that would leave this bound.
    pub(crate) fn too_deep(&self, bound: f64) -> TableError {
        let alpha = self.pieces().iter().fold(0.0_f64, |most, piece| most.max(piece.map().alpha.abs()));
        TableError::Depth { alpha, most: MOST, bound }
    }
}
