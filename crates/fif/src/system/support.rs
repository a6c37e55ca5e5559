//! Ranges of a rough function plus a line, which bound cells more tightly than separate ranges.

use asperity_core::Interval;

use crate::numeric::polynomial::UNIT;
use crate::system::cell::Cell;
use crate::system::map::Piece;

/// Slopes for which the ranges are stored, from `−LIMIT` to `LIMIT` ranges of the function per
/// domain.
const NODES: usize = 33;
const LIMIT: f64 = 2.0;

/// Cells from which ranges are computed, unless there are more maps.
///
/// And the number of rounds in which ranges are computed from the previous ones.
const CELLS: usize = 8;
const ROUNDS: usize = 24;

/// Maximum number of maps of a function.
const MAPS: usize = 64;

/// For slopes `k`, with `u` from 0 to 1 over the domain, enclosures of `{f + k u}`.
///
/// Its upper end is convex in `k` and its lower end concave, so lines between nodes enclose the
/// ends.
#[derive(Clone, Copy, Debug)]
pub struct Support {
    steepest: f64,
    ranges: [Interval; NODES],
}

impl Support {
    /// Returns `None` for a function of many maps, for which this would take long.
    ///
    /// Also for a function whose range is too narrow or too wide for slopes in units of it.
    pub(crate) fn new<const C: usize>(pieces: &[Piece<C>], range: Interval) -> Option<Self> {
        let steepest = LIMIT * range.width();
        if pieces.len() > MAPS || !(1e-280..1e280).contains(&steepest) || range.magnitude() > 1e280 {
            return None;
        }
        let mut support = Self { steepest, ranges: [range; NODES] };
        for i in 0..NODES {
            let k = support.slope(i);
            if let Some(place) = support.ranges.get_mut(i) {
                *place = Interval::new(range.lo + k.min(0.0), range.hi + k.max(0.0)).inflated(0.0);
            }
        }
        let mut depth = 1;
        while pieces.len().saturating_pow(depth + 1) <= CELLS {
            depth += 1;
        }
        for _ in 0..ROUNDS {
            let mut hulls = [Interval::EMPTY; NODES];
            support.gather(pieces, &Cell::root(), [0.0, 1.0], depth, &mut hulls);
            let mut gained = false;
            for (old, new) in support.ranges.iter_mut().zip(hulls) {
                let new = new.intersection(*old);
                gained |= new.width() < 0.999 * old.width();
                *old = new;
            }
            if !gained {
                break;
            }
        }
        Some(support)
    }

    /// The hulls of the ranges over all cells some levels below one.
    fn gather<const C: usize>(
        &self,
        pieces: &[Piece<C>],
        cell: &Cell<C>,
        [from, to]: [f64; 2],
        depth: u32,
        hulls: &mut [Interval; NODES],
    ) {
        if depth == 0 {
            for (i, hull) in hulls.iter_mut().enumerate() {
                let k = self.slope(i);
                let range = self.tilted_range(cell, [k * from, k * to]);
                *hull = hull.hull(range.inflated(64.0 * f64::EPSILON * k.abs()));
            }
            return;
        }
        for piece in pieces {
            let part = piece.s.map(|s| from + (to - from) * s);
            self.gather(pieces, &cell.child(piece), part, depth - 1, hulls);
        }
    }

    #[inline]
    fn slope(&self, i: usize) -> f64 {
        self.steepest * ((2 * i) as f64 / (NODES - 1) as f64 - 1.0)
    }

    /// More than the magnitude of numbers in a range at the maximum slope.
    pub(crate) fn magnitude(&self) -> f64 {
        2.0 * self.steepest + self.ranges[NODES / 2].magnitude()
    }

    /// An enclosure of `f` plus a line over the cell, from enclosures of `f` plus lines over the
    /// domain.
    #[inline]
    pub(crate) fn tilted_range<const C: usize>(&self, cell: &Cell<C>, [from, to]: [f64; 2]) -> Interval {
        let first = cell.polynomial.first().copied().unwrap_or(0.0);
        let last = cell.polynomial.last().copied().unwrap_or(0.0);
        let rise = last - first;
        // The difference between the polynomial and its chord.
        let mut rest = Interval::new(0.0, 0.0);
        let mut largest = from.abs() + to.abs();
        for (i, &b) in cell.polynomial.iter().enumerate() {
            let off = b - (first + rise * (i as f64 / (C.max(2) - 1) as f64));
            rest = rest.hull(Interval::new(off, off));
            largest = if b.abs() > largest { b.abs() } else { largest };
        }
        let size = cell.product.abs();
        let (base, line) = (first + from, rise + (to - from));
        let (slope, flat) = (line / size, self.range(0.0));
        let flipped = |range: Interval| {
            if cell.product > 0.0 { range } else { Interval::new(-range.hi, -range.lo) }
        };
        let range = if slope.is_finite() {
            flipped(self.range(if cell.product > 0.0 { slope } else { -slope }))
        } else {
            // The quotient is infinite or NaN, so the line is bounded separately.
            rest = rest.sum(Interval::new(line.min(0.0), line.max(0.0)));
            flipped(flat)
        };
        let slack =
            1.01 * cell.error + (cell.steps + 64.0) * UNIT * (size * self.magnitude() + 4.0 * largest);
        Interval::new(base + size * range.lo + rest.lo, base + size * range.hi + rest.hi).inflated(slack)
    }

    /// An enclosure of `{f + k u}`, except for rounding relative to its magnitude and that of `k`.
    #[inline]
    pub(crate) fn range(&self, k: f64) -> Interval {
        let over = k.abs() - self.steepest;
        if over >= 0.0 || k.is_nan() {
            let (first, last) = (self.ranges[0], self.ranges[NODES - 1]);
            return if k > 0.0 {
                Interval::new(last.lo, last.hi + over)
            } else {
                Interval::new(first.lo - over, first.hi)
            };
        }
        let at = (k / self.steepest + 1.0) * (0.5 * (NODES - 1) as f64);
        let i = (at as usize).min(NODES - 2);
        let t = at - i as f64;
        match (self.ranges.get(i), self.ranges.get(i + 1)) {
            (Some(a), Some(b)) => Interval::new(a.lo + t * (b.lo - a.lo), a.hi + t * (b.hi - a.hi)),
            _ => Interval::ENTIRE,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FixedFif, cochran_2000};

    fn check<const N: usize>(function: &FixedFif<N, 2>, most: f64) {
        let support = Support::new(function.pieces(), function.range()).unwrap();
        let mut widest = 0.0_f64;
        for k in [-20.0, -5.0, -1.3, -0.01, 0.0, 0.7, 2.0, 3.9, 11.0] {
            let range = support.range(k);
            let mut seen = Interval::EMPTY;
            for i in 0..=4096 {
                let (u, domain) = (f64::from(i) / 4096.0, function.domain());
                let value = function.evaluate(domain.lo + u * domain.width(), 0.0).value + k * u;
                seen = seen.hull(Interval::new(value, value));
            }
            assert!(range.lo <= seen.lo + 1e-12 && seen.hi <= range.hi + 1e-12, "{k}: {range:?} {seen:?}");
            widest = widest.max(range.width() / seen.width());
        }
        assert!(widest < most, "{widest}");
    }

    #[test]
    fn support_encloses_samples() {
        check(&cochran_2000::f().unwrap(), 1.1);
        check(&cochran_2000::g().unwrap(), 1.3);
        let knots = [-1.0, 0.0, 0.5, 3.0];
        let y = [0.5, -1.0, 2.0, 0.25];
        check(&FixedFif::<3, 2>::affine(&knots, &y, &[0.7, 0.0, -0.8]).unwrap(), 1.5);
        check(&FixedFif::<3, 2>::affine(&knots, &y, &[0.0, 0.0, 0.0]).unwrap(), 1.5);
    }

    #[test]
    fn support_none_for_extreme_ranges() {
        let flat = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[0.0; 3], &[0.5, 0.5]).unwrap();
        assert!(Support::new(flat.pieces(), flat.range()).is_none());
    }
}
