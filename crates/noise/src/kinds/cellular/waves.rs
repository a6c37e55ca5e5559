//! Points of a row in one cell: the nearest of the candidate feature points, a few vectors at once.

use core::ops::Range;

use crate::{
    kinds::cellular::cellular::{Cellular, CellularOutput},
    kinds::cellular::metric::Metric,
    kinds::cellular::rows::Seen,
    lanes::Lanes,
    row::cells::Plan,
    row::row::Strip,
};

impl<L> Cellular<L> {
    /// Evaluates values and gradients at a range of the points of a row.
    ///
    /// Whole vectors are written. The next cell overwrites entries beyond the end.
    #[inline(always)]
    pub(super) fn wave<S: Lanes, const N: usize, const GRADIENTS: bool>(
        &self,
        s: S,
        seen: Seen<'_, N>,
        plan: &Plan,
        positions: [S::F; N],
        strip: &mut Strip<'_, N, GRADIENTS>,
        range: Range<usize>,
    ) {
        let (mut i, end) = (range.start, range.end);
        if GRADIENTS || self.basis == CellularOutput::Cell {
            while i < end {
                let mut position = positions;
                position[0] = plan.along_from(s, i).position;
                strip.put(s, self.at::<S, N>(s, position, seen), i);
                i += S::LEN;
            }
            return;
        }
        while i < end {
            i = match end - i {
                left if left <= S::LEN => {
                    self.values::<S, N, GRADIENTS, 1>(s, seen, plan, positions, strip, i)
                }
                // The compiler vectorizes single lanes.
                left if S::LEN == 1 && left >= 8 => {
                    self.values::<S, N, GRADIENTS, 8>(s, seen, plan, positions, strip, i)
                }
                left if left <= 2 * S::LEN => {
                    self.values::<S, N, GRADIENTS, 2>(s, seen, plan, positions, strip, i)
                }
                _ => self.values::<S, N, GRADIENTS, 3>(s, seen, plan, positions, strip, i),
            };
        }
    }

    /// Evaluates the values in `V` vectors from point `i` on, and returns the index after them.
    #[inline(always)]
    fn values<S: Lanes, const N: usize, const GRADIENTS: bool, const V: usize>(
        &self,
        s: S,
        seen: Seen<'_, N>,
        plan: &Plan,
        positions: [S::F; N],
        strip: &mut Strip<'_, N, GRADIENTS>,
        i: usize,
    ) -> usize {
        let mut t = [positions[0]; V];
        for v in 0..V {
            t[v] = plan.along_from(s, i + v * S::LEN).position;
        }
        let measures = match (self.metric, self.takes_second()) {
            (Metric::Euclidean, false) => nearest::<S, N, V, false>(s, Metric::Euclidean, seen, positions, t),
            (metric, false) => nearest::<S, N, V, false>(s, metric, seen, positions, t),
            (metric, true) => nearest::<S, N, V, true>(s, metric, seen, positions, t),
        };
        for v in 0..V {
            strip.put(s, self.of_measures::<S, N>(s, measures[v]), i + v * S::LEN);
        }
        i + V * S::LEN
    }

    /// Value and gradient at positions in a cell, or the number of the nearest feature point's
    /// cell.
    #[inline(always)]
    fn at<S: Lanes, const N: usize>(
        &self,
        s: S,
        positions: [S::F; N],
        seen: Seen<'_, N>,
    ) -> (S::F, [S::F; N]) {
        let mut measures = [s.float(f32::INFINITY); 2];
        let mut offsets = [[s.float(0.0); N]; 2];
        let mut numbers = s.float(0.0);
        let second = self.takes_second();
        for (point, &number) in seen.points.iter().zip(seen.numbers) {
            let mut offset = positions;
            for axis in 0..N {
                offset[axis] = positions[axis] - s.float(point[axis]);
            }
            let measure = self.metric.measure(s, offset);
            // At equal distance the first feature point, which has the lower rank, is nearer.
            let nearest = s.less(measure, measures[0]);
            if self.basis == CellularOutput::Cell {
                numbers = s.select(nearest, s.float(number), numbers);
            } else if second {
                let nearer = s.less(measure, measures[1]);
                let next = |first, second, new| s.select(nearest, first, s.select(nearer, new, second));
                for axis in 0..N {
                    offsets[1][axis] = next(offsets[0][axis], offsets[1][axis], offset[axis]);
                }
                measures[1] = next(measures[0], measures[1], measure);
            }
            for axis in 0..N {
                offsets[0][axis] = s.select(nearest, offset[axis], offsets[0][axis]);
            }
            measures[0] = s.select(nearest, measure, measures[0]);
        }
        if self.basis == CellularOutput::Cell {
            return (numbers, [s.float(0.0); N]);
        }
        self.of_offsets(s, measures, offsets)
    }
}

/// The measures of the nearest feature point, and of the second if `SECOND`, at `V` vectors of
/// positions along the first axis.
#[inline(always)]
fn nearest<S: Lanes, const N: usize, const V: usize, const SECOND: bool>(
    s: S,
    metric: Metric,
    seen: Seen<'_, N>,
    positions: [S::F; N],
    t: [S::F; V],
) -> [[S::F; 2]; V] {
    let mut measures = [[s.float(f32::INFINITY); 2]; V];
    for point in seen.points {
        let mut offsets = positions;
        for axis in 1..N {
            offsets[axis] = positions[axis] - s.float(point[axis]);
        }
        let rest = metric.rest(s, offsets);
        let x = s.float(point[0]);
        for v in 0..V {
            let [first, second] = measures[v];
            let measure = metric.joined(s, rest, t[v] - x);
            measures[v][0] = s.min(first, measure);
            if SECOND {
                measures[v][1] = s.min(second, s.max(first, measure));
            }
        }
    }
    measures
}
