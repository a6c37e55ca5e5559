//! Number of terms of a sum over composites, and the error that it leaves.

use crate::numeric::interval::Interval;
use crate::system::fif::System;
use crate::system::map::Piece;
use crate::table::error::TableError;

/// Composites that one evaluation takes at most.
pub(crate) const MOST: u32 = 64;

/// The sum `Σ_{k < K} W_k P_k + W_K tail`, every factor of `W_k` at most `ratio` in size.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) ratio: f64,
    /// `max |P_k|`.
    pub(crate) largest: f64,
    /// Bound of the error of one `P_k` as it is evaluated.
    pub(crate) row: f64,
    /// Relative error of one factor of `W_k` and of the product, in units of rounding.
    pub(crate) roundings: f64,
    /// Encloses the tail.
    pub(crate) tail: Interval,
    /// The size of what is added to the sum.
    pub(crate) scale: f64,
    /// The number of steps after which nothing is left.
    pub(crate) end: u32,
    /// An error that does not depend on the depth.
    pub(crate) lost: f64,
    /// The unit of rounding.
    pub(crate) unit: f64,
}

/// Number of steps, and the error that they leave.
pub(crate) struct Depth {
    pub(crate) steps: u32,
    pub(crate) bound: f64,
}

impl Series {
    /// The least number of steps whose bound is within the tolerance, or else within 5/4 of the least bound; that bound
    /// as an error when more steps than [`MOST`] would have lessened it.
    pub(crate) fn depth(&self, tolerance: f64) -> Result<Depth, f64> {
        let last = MOST.min(self.end);
        let bounds = || (1..=last).map(|steps| Depth { steps, bound: self.bound(steps) });
        let least = bounds().fold(f64::INFINITY, |least, depth| least.min(depth.bound));
        let enough = if tolerance > 1.25 * least { tolerance } else { 1.25 * least };
        let first =
            bounds().find(|depth| depth.bound <= enough).filter(|_| least.is_finite()).ok_or(least)?;
        let [truncation, rounding] = self.errors(last);
        // NaN is no tolerance that could be met.
        let within = first.bound <= tolerance;
        if within || truncation <= rounding { Ok(first) } else { Err(least) }
    }

    /// The least number of steps whose truncation is within the tolerance, or else within half the rounding error.
    pub(crate) fn depth_of_truncation(&self, tolerance: f64) -> Result<Depth, f64> {
        let enough = |steps: &u32| {
            let [truncation, rounding] = self.errors(*steps);
            truncation <= tolerance || truncation <= 0.5 * rounding
        };
        let bound = |steps: u32| Depth { steps, bound: self.bound(steps) };
        let last = MOST.min(self.end);
        let found = (1..=last).find(enough).map(bound).filter(|depth| depth.bound.is_finite());
        found.ok_or_else(|| self.bound(last))
    }

    /// Truncation and rounding after so many steps.
    pub(crate) fn bound(&self, steps: u32) -> f64 {
        let [truncation, rounding] = self.errors(steps);
        1.001 * (truncation + rounding) + self.lost
    }

    /// Truncation and rounding error after `steps` steps.
    fn errors(&self, steps: u32) -> [f64; 2] {
        let (radius, most) = (0.5 * self.tail.width(), self.tail.magnitude());
        // Σ |W_k| and Σ k |W_k|.
        let (mut weight, mut weights, mut counts) = (1.0_f64, 0.0_f64, 0.0_f64);
        for k in 0..steps {
            weights += weight;
            counts += f64::from(k) * weight;
            weight *= self.ratio;
        }
        let k = f64::from(steps);
        let rounding = weights * self.row
            + counts * self.roundings * self.unit * self.largest
            + (k + 3.0) * self.unit * (self.scale + weights * self.largest)
            + weight * most * (k * self.roundings + 4.0) * self.unit;
        [if steps == self.end { 0.0 } else { weight * radius }, rounding]
    }
}

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// The refusal of a table that would leave this bound.
    pub(crate) fn too_deep(&self, bound: f64) -> TableError {
        TableError { alpha: self.steepest(), steps: MOST, bound }
    }
}
