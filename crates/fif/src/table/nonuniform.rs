//! Values on unequal knots: a partition into composite cells of similar weight, found by a guide
//! table.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;

use crate::numeric::polynomial::{UNIT, horner, magnitude, substitute};
use crate::system::chord::Chord;
use crate::system::error::FifError;
use crate::system::fif::FifRef;
use crate::system::map::Piece;
use crate::table::composite::{Series, enclose};

/// Cells of a partition.
const CELLS: usize = 4096;

/// Entries of the guide.
const BUCKETS: usize = 16384;

/// Cells narrower than this fraction of the domain are not split, because hardly any point lies in
/// them.
const NARROW: f64 = 1.0 / 1_048_576.0;

/// Cells of a partition with their composites, and a guide that finds the cell of a point in one or
/// two steps.
///
/// The domain is split into 4096 cells, images of composites of maps, the one with the largest
/// vertical scaling first.
#[derive(Clone, Debug)]
pub(crate) struct Nonuniform<const C: usize> {
    cells: Vec<Row<C>>,
    guide: Vec<u16>,
    steps: u32,
    chord: Chord,
    origin: f64,
    width: f64,
    middle: f64,
    /// Error bound away from knots.
    pub(crate) away: f64,
}

/// A cell, with its composite over it scaled to `[0, 1]`.
#[derive(Clone, Copy, Debug)]
struct Row<const C: usize> {
    left: f64,
    stretch: f64,
    a: f64,
    c: [f64; C],
}

impl<const C: usize> Nonuniform<C> {
    pub(crate) fn new(system: FifRef<'_, C>, tolerance: f64) -> Result<Self, FifError> {
        let parts = partition(system);
        let most = |of: fn(&Cell<C>) -> f64| parts.iter().map(of).fold(0.0_f64, f64::max);
        let (largest, roundings) = (most(|part| magnitude(&part.c, 1.0)), most(|part| part.depth) + 2.0);
        let row = 1.01 * most(|part| part.error) + 3.0 * C as f64 * UNIT * largest;
        let rows = parts.iter().map(|part| (part.a, part.c));
        let tail = enclose(system, rows, row + 4.0 * C as f64 * UNIT * largest, roundings);
        let chord = system.chord();
        let series = Series {
            ratio: most(|part| part.a.abs()) * (1.0 + roundings * UNIT),
            largest,
            row,
            roundings,
            tail,
            scale: chord.start.abs() + chord.rise.abs(),
            end: u32::MAX,
            lost: 0.0,
            unit: UNIT,
        };
        let depth = series.depth(tolerance).map_err(|bound| system.too_deep(bound))?;
        let rows =
            parts.iter().map(|part| Row { left: part.left, stretch: 1.0 / part.width, a: part.a, c: part.c });
        // Three cells beyond the end, for the steps of a search.
        let beyond = Row { left: f64::INFINITY, stretch: 0.0, a: 0.0, c: [0.0; C] };
        let cells: Vec<_> = rows.chain([beyond; 3]).collect();
        let guide = (0..=BUCKETS).map(|bucket| {
            let start = bucket as f64 / BUCKETS as f64;
            let index = cells.partition_point(|cell| cell.left <= start).saturating_sub(1);
            u16::try_from(index).unwrap_or(u16::MAX)
        });
        Ok(Self {
            guide: guide.collect(),
            cells,
            steps: depth.steps,
            chord,
            origin: system.domain().lo,
            width: system.domain().width(),
            middle: tail.middle(),
            away: depth.bound,
        })
    }

    /// The sum over the cells; `None` at knots, outside and for NaN.
    #[inline(always)]
    pub(crate) fn sum(&self, x: f64) -> Option<f64> {
        // Divided, like the positions of the knots, which are therefore matched exactly.
        let t = (x - self.origin) / self.width;
        if !(t > 0.0 && t < 1.0) {
            return None;
        }
        let cell = self.cell(t)?;
        let mut u = (t - cell.left) * cell.stretch;
        if u == 0.0 {
            return None;
        }
        u = if u < 1.0 { u } else { 1.0 };
        let mut sum = self.chord.at(t) + horner(&cell.c, u);
        let mut weight = cell.a;
        for _ in 1..self.steps {
            let cell = self.cell(u)?;
            u = (u - cell.left) * cell.stretch;
            u = if u < 1.0 { u } else { 1.0 };
            sum += weight * horner(&cell.c, u);
            weight *= cell.a;
        }
        Some(sum + weight * self.middle)
    }

    /// The last cell whose left end is not right of `t` in `[0, 1]`.
    #[inline(always)]
    fn cell(&self, t: f64) -> Option<&Row<C>> {
        // Signed, which one instruction converts; `t` is in [0, 1].
        let bucket = (t * BUCKETS as f64) as i64 as usize;
        let mut index = usize::from(*self.guide.get(bucket)?);
        // Two steps without a branch, which is sufficient for most points.
        index += usize::from(self.cells.get(index + 1)?.left <= t);
        index += usize::from(self.cells.get(index + 1)?.left <= t);
        if self.cells.get(index + 1)?.left <= t {
            let here = self.cells.get(index..)?;
            index += here.partition_point(|cell| cell.left <= t).saturating_sub(1);
        }
        self.cells.get(index)
    }
}

/// A cell while the domain is being split.
#[derive(Clone, Copy)]
struct Cell<const C: usize> {
    left: f64,
    /// Rounding error of the sum for `left`.
    low: f64,
    width: f64,
    a: f64,
    c: [f64; C],
    error: f64,
    depth: f64,
}

/// The cells from left to right.
fn partition<const C: usize>(system: FifRef<'_, C>) -> Vec<Cell<C>> {
    let root = Cell { left: 0.0, low: 0.0, width: 1.0, a: 1.0, c: [0.0; C], error: 0.0, depth: 0.0 };
    let mut parts = alloc::vec![root];
    // The order of the bits is the order of non-negative numbers.
    let mut heap = BinaryHeap::from([(u64::MAX, 0)]);
    let maps = system.pieces().len();
    while let Some((_, index)) = heap.pop() {
        let Some(part) = parts.get(index).copied() else { break };
        if parts.len() + maps > CELLS + 1 && part.depth > 0.0 {
            break;
        }
        for (j, piece) in system.pieces().iter().enumerate() {
            let child = part.child(system, piece);
            let place = if j == 0 { index } else { parts.len() };
            match parts.get_mut(place) {
                Some(split) => *split = child,
                None => parts.push(child),
            }
            if child.width > NARROW {
                heap.push((child.a.abs().to_bits(), place));
            }
        }
    }
    parts.sort_by(|a, b| a.left.total_cmp(&b.left));
    parts
}

impl<const C: usize> Cell<C> {
    fn child(&self, system: FifRef<'_, C>, piece: &Piece<C>) -> Self {
        let map = system.deviation(piece);
        let mut c = substitute(&self.c, map.a, map.s);
        for (sum, p) in c.iter_mut().zip(map.p) {
            *sum += self.a * p;
        }
        let before = magnitude(&self.c, 1.0);
        let added = self.a.abs() * (map.slack + (self.depth + 2.0) * UNIT * magnitude(&map.p, 1.0));
        let error = self.error + 4.0 * C as f64 * UNIT * before + added + UNIT * magnitude(&c, 1.0);
        // left + low + shift with one rounding at the end.
        let shift = self.width * map.s;
        let left = self.left + shift;
        let back = left - self.left;
        let low = self.low + ((self.left - (left - back)) + (shift - back));
        Self {
            left: left + low,
            low: low - ((left + low) - left),
            width: self.width * map.a,
            a: self.a * map.alpha,
            c,
            error,
            depth: self.depth + 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Fif;

    #[test]
    fn cells_tile_the_domain() {
        let gaps = [0.0, 1e-9, 0.3, 0.300_001, 1.0];
        let f = Fif::affine(&gaps, &[0.0, 1.0, 0.5, -0.5, 0.0], &[0.9, -0.7, 0.9, 0.8]).unwrap();
        let parts = partition(f.view());
        assert!(parts.len() > 4000 && parts.len() <= CELLS, "{}", parts.len());
        for pair in parts.windows(2) {
            let end = pair[0].left + pair[0].width;
            assert!((end - pair[1].left).abs() <= f64::EPSILON, "{} {}", end, pair[1].left);
        }
    }
}
