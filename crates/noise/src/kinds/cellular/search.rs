//! The search for the nearest feature points, with one point per lane.

use crate::{
    kinds::cellular::metric::Metric,
    lanes::Lanes,
    lattice::integer_hash::further,
    lattice::lattice::{Lattice, cell},
    lattice::variates::uniform,
};

/// Cells are skipped only if their border is farther than the second nearest point by this margin.
///
/// It exceeds the rounding error, which is 5e-7 for offsets up to 5.
const MARGIN: f32 = 4e-6;

/// Weights of the cells' steps in a rank: steps are from −4 to 4, and the first axis has the
/// largest weight.
const RANKS: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [9.0, 1.0, 0.0, 0.0], [81.0, 1.0, 9.0, 0.0], [729.0, 1.0, 9.0, 81.0]];

/// The feature points of a lattice, one in each cell.
pub(super) struct Features<'a, L> {
    pub(super) lattice: &'a L,
    pub(super) seed: u32,
    pub(super) metric: Metric,
    /// The side of the box in the middle of a cell that contains its feature point.
    pub(super) jitter: f32,
}

/// The cells of points, and the positions of the points in them.
pub(super) struct CellPosition<S: Lanes, const N: usize> {
    pub(super) cell: [S::U; N],
    pub(super) t: [S::F; N],
}

impl<S: Lanes, const N: usize> CellPosition<S, N> {
    #[inline(always)]
    pub(super) fn new(s: S, p: [S::F; N]) -> Self {
        let mut position = Self { cell: [s.word(0); N], t: p };
        for axis in 0..N {
            let (cell, t) = cell(s, p[axis]);
            position.cell[axis] = cell;
            position.t[axis] = t;
        }
        position
    }
}

/// The number of the cell of a word.
#[inline(always)]
pub(super) fn number<S: Lanes>(s: S, word: S::U) -> S::F {
    uniform(s, further::<S, 2>(s, word))
}

/// Measures of the distances to the nearest and the second nearest feature point, and the ranks of
/// their cells.
pub(super) struct Nearest<S: Lanes> {
    pub(super) measures: [S::F; 2],
    pub(super) ranks: [S::F; 2],
}

impl<S: Lanes> Nearest<S> {
    #[inline(always)]
    fn none(s: S) -> Self {
        let far = s.float(f32::INFINITY);
        Self { measures: [far; 2], ranks: [far; 2] }
    }

    /// Adds a feature point. At equal distance the feature point of lower rank is nearer, in any
    /// order of calls.
    #[inline(always)]
    fn take<const RANKED: bool>(&mut self, s: S, measure: S::F, rank: S::F) {
        let [first, second] = self.measures;
        if !RANKED {
            self.measures = [s.min(first, measure), s.min(second, s.max(first, measure))];
            return;
        }
        let before = |other: S::F, other_rank: S::F| {
            let (yes, no) = (s.float(1.0), s.float(0.0));
            let tied = s.select(s.less(rank, other_rank), yes, no);
            let not_farther = s.select(s.less(other, measure), no, tied);
            s.less(no, s.select(s.less(measure, other), yes, not_farther))
        };
        let [first_rank, second_rank] = self.ranks;
        let (nearest, nearer) = (before(first, first_rank), before(second, second_rank));
        let position = |first, second, new| {
            let displaced = s.select(nearest, first, s.select(nearer, new, second));
            [s.select(nearest, new, first), displaced]
        };
        self.measures = position(first, second, measure);
        self.ranks = position(first_rank, second_rank, rank);
    }
}

/// One axis of a visited cell: the term of its word, and its step from the point's own cell.
struct Axis<S: Lanes> {
    term: S::U,
    step: S::F,
}

impl<S: Lanes> Clone for Axis<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Lanes> Copy for Axis<S> {}

impl<L: Lattice> Features<'_, L> {
    /// The positions of the feature points of words in their cells.
    #[inline(always)]
    pub(super) fn positions<S: Lanes, const N: usize>(&self, s: S, word: S::U) -> [S::F; N] {
        let low = s.word(0xffff);
        let second = if N > 2 { further::<S, 1>(s, word) } else { word };
        let fields = [s.shr::<16>(word), word & low, s.shr::<16>(second), second & low];
        let (side, corner) = (s.float(self.jitter / 65_536.0), s.float(0.5 - 0.5 * self.jitter));
        let mut positions = [corner; N];
        for axis in 0..N {
            positions[axis] = corner + (s.real(fields[axis]) + s.float(0.5)) * side;
        }
        positions
    }

    /// The offsets from feature points to points.
    #[inline(always)]
    fn offsets<S: Lanes, const N: usize>(
        &self,
        s: S,
        position: &CellPosition<S, N>,
        axes: &[Axis<S>; N],
        word: S::U,
    ) -> [S::F; N] {
        let positions = self.positions::<S, N>(s, word);
        let mut offsets = positions;
        for axis in 0..N {
            offsets[axis] = position.t[axis] - (axes[axis].step + positions[axis]);
        }
        offsets
    }

    #[inline(always)]
    fn word<S: Lanes, const N: usize>(&self, s: S, axes: &[Axis<S>; N]) -> S::U {
        let mut terms = [axes[0].term; N];
        for axis in 1..N {
            terms[axis] = axes[axis].term;
        }
        self.lattice.words(s, terms, self.seed)
    }

    #[inline(always)]
    fn visit<S: Lanes, const N: usize, const RANKED: bool>(
        &self,
        s: S,
        position: &CellPosition<S, N>,
        axes: &[Axis<S>; N],
        nearest: &mut Nearest<S>,
    ) {
        let offsets = self.offsets(s, position, axes, self.word(s, axes));
        let mut rank = s.float(0.0);
        if RANKED {
            for axis in 0..N {
                rank = rank + axes[axis].step * s.float(RANKS[N - 1][axis]);
            }
        }
        nearest.take::<RANKED>(s, self.metric.measure(s, offsets), rank);
    }

    /// The nearest feature point and, if `second`, the second nearest, which is otherwise
    /// unspecified.
    ///
    /// The 2ⁿ cells next to the nearest corner are visited first. The other cells along an axis
    /// follow in the order of their distance. The search ends where the border of a cell is farther
    /// than the result in every lane.
    #[inline(always)]
    pub(super) fn nearest<S: Lanes, const N: usize, const RANKED: bool>(
        &self,
        s: S,
        position: &CellPosition<S, N>,
        second: bool,
    ) -> Nearest<S> {
        let mut nearest = Nearest::none(s);
        let zero = s.float(0.0);
        // The direction to the nearer border, and the distance of the point from the middle of its
        // cell.
        let (mut towards, mut off_center) = ([zero; N], [zero; N]);
        let mut near = [[Axis { term: position.cell[0], step: zero }; 2]; N];
        for axis in 0..N {
            let t = position.t[axis] - s.float(0.5);
            towards[axis] = s.select(s.less(t, zero), s.float(-1.0), s.float(1.0));
            off_center[axis] = s.abs(t);
            near[axis] = [self.axis(s, position, axis, zero), self.axis(s, position, axis, towards[axis])];
        }
        for corner in 0..1 << N {
            let mut axes = [near[0][corner & 1]; N];
            for axis in 1..N {
                axes[axis] = near[axis][corner >> axis & 1];
            }
            self.visit::<S, N, RANKED>(s, position, &axes, &mut nearest);
        }

        let last = 2 * self.metric.reach(N);
        let half = 0.5 * self.jitter + MARGIN;
        // The gap along an axis to a cell, given the distance of the point from the middle of its
        // cell.
        let gap = |off_center: S::F, turn: usize| {
            let cells = turn.div_ceil(2) as f32;
            let off = if turn % 2 == 1 { -off_center } else { off_center };
            s.max(s.float(cells - half) + off, zero)
        };
        let mut turns = [0; N];
        let mut axes = [near[0][0]; N];
        // The measure of the gaps along an axis and later axes.
        let mut gaps = [zero; 5];
        for axis in (0..N).rev() {
            axes[axis] = near[axis][0];
            gaps[axis] = self.metric.joined(s, gaps[axis + 1], gap(off_center[axis], 0));
        }
        let mut axis = 0;
        while axis < N {
            turns[axis] += 1;
            let turn = turns[axis];
            if turn <= last {
                let gaps_here = self.metric.joined(s, gaps[axis + 1], gap(off_center[axis], turn));
                let sought = nearest.measures[usize::from(second)];
                if !s.all(s.less(sought, gaps_here)) {
                    gaps[axis] = gaps_here;
                    let cells = turn.div_ceil(2) as f32;
                    let step = towards[axis] * s.float(if turn % 2 == 1 { cells } else { -cells });
                    axes[axis] = self.axis(s, position, axis, step);
                    for before in (0..axis).rev() {
                        gaps[before] = self.metric.joined(s, gaps[before + 1], gap(off_center[before], 0));
                    }
                    axis = 0;
                    if turns.iter().any(|&turn| turn > 1) {
                        self.visit::<S, N, RANKED>(s, position, &axes, &mut nearest);
                    }
                    continue;
                }
            }
            turns[axis] = 0;
            axes[axis] = near[axis][0];
            axis += 1;
        }
        nearest
    }

    #[inline(always)]
    fn axis<S: Lanes, const N: usize>(
        &self,
        s: S,
        position: &CellPosition<S, N>,
        axis: usize,
        step: S::F,
    ) -> Axis<S> {
        Axis { term: self.lattice.term(s, axis, position.cell[axis] + s.integer(step)), step }
    }

    /// The word and the offsets of the feature point of a rank.
    #[inline(always)]
    pub(super) fn of_rank<S: Lanes, const N: usize>(
        &self,
        s: S,
        position: &CellPosition<S, N>,
        rank: S::F,
    ) -> (S::U, [S::F; N]) {
        let weights = RANKS[N - 1];
        let mut axes = [Axis { term: position.cell[0], step: s.float(0.0) }; N];
        // Decodes the largest weight first: the first axis, then from the last axis down.
        let mut rest = rank;
        for turn in 0..N {
            let axis = if turn == 0 { 0 } else { N - turn };
            // The remaining smaller weights sum to less than half a weight.
            let step = s.floor(rest * s.float(1.0 / weights[axis]) + s.float(0.5));
            rest = rest - step * s.float(weights[axis]);
            axes[axis] = self.axis(s, position, axis, step);
        }
        let word = self.word(s, &axes);
        (word, self.offsets(s, position, &axes, word))
    }
}
