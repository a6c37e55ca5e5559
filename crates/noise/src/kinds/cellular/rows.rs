//! Rows of cellular noise: the candidate feature points of a cell are found once for many of its
//! points.
//!
//! Cells are cut into slabs across all axes but the first. Rows of a grid that pass through the
//! same slab of the same cells reuse the search. Feature points that are farther from the slab than
//! the maximum distance of the nearest feature point are not candidates for any of them.

use crate::{
    kinds::cellular::metric::Metric,
    kinds::cellular::search::{Features, number},
    lanes::{Lanes, Scalar},
    lattice::fade::Fade,
    lattice::lattice::{Lattice, cell},
    row::cells::Plan,
    row::row::Row,
};

/// The step from which on a cell has too few points for columns to pay off.
pub(super) const LONG_STEP: f32 = 0.15;
/// The number of columns of cells that are computed at once along a row.
const COLUMNS: usize = 64;
/// The maximum number of cells of a column: 5² in 3-D in the Euclidean metric, 3³ in 4-D in the
/// Chebyshev metric.
const SECTIONS: usize = 27;
/// The maximum number of feature points of the columns around a cell.
const MAX_SEEN: usize = SECTIONS * 5;
/// The maximum number of feature points stored for the cells of a row; 60 cells in 3-D have some
/// 600 candidates.
const MAX_STORED: usize = 1024;
/// Slabs of a cell along an axis: a power of two, so that their borders are exact.
const SLABS: f32 = 4.0;

type Numbers = [[f32; COLUMNS]; SECTIONS];

/// The feature points of the columns that an interval of a row crosses.
#[derive(Clone, Debug)]
pub struct Columns<const N: usize> {
    pub(super) plan: Plan,
    /// The cells that the feature points were drawn for.
    key: Option<Key<N>>,
    /// Minimum and maximum position in the cell of the points that use the search, along all axes
    /// but the first.
    slab: [[f32; N]; 2],
    /// Reach of columns, and the number of cells in each.
    reach: usize,
    sections: usize,
    /// The steps to the cells of a column.
    steps: [[f32; SECTIONS]; N],
    /// Positions of feature points: along the first axis in their cells, along the others relative
    /// to the cell of the row.
    positions: [Numbers; N],
    /// The random numbers of the cells.
    numbers: Numbers,
    /// Minimum and maximum measure of the offsets from the slab to the feature points, along all
    /// axes but the first.
    gaps: [Numbers; 2],
    /// The maximum measure of the nearest or second nearest feature point in a cell.
    bounds: [f32; COLUMNS],
    /// The number of cells whose feature points fit.
    pub(super) cells: usize,
    /// For each cell the columns and sections of its candidate feature points, and their number.
    lists: [[u8; MAX_SEEN]; COLUMNS],
    counts: [u8; COLUMNS],
    /// The index after the last feature point of each cell, in the order of the points of the row.
    ends: [u16; COLUMNS],
    points: [[f32; N]; MAX_STORED],
    point_numbers: [f32; MAX_STORED],
}

/// Everything that the words of columns depend on.
///
/// The first column, the number of columns, the row's cell along the other axes, and the seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Key<const N: usize> {
    first: i32,
    columns: usize,
    descending: bool,
    cell: [u32; N],
    seed: u32,
}

/// The candidate feature points of the points of a cell, in the order of their ranks, and the
/// numbers of their cells.
#[derive(Clone, Copy)]
pub(super) struct Seen<'a, const N: usize> {
    pub(super) points: &'a [[f32; N]],
    pub(super) numbers: &'a [f32],
}

impl<const N: usize> Default for Columns<N> {
    fn default() -> Self {
        let numbers = [[0.0; COLUMNS]; SECTIONS];
        Self {
            plan: Plan::empty(),
            key: None,
            slab: [[0.0; N]; 2],
            reach: 0,
            sections: 0,
            steps: [[0.0; SECTIONS]; N],
            positions: [numbers; N],
            numbers,
            gaps: [numbers; 2],
            bounds: [0.0; COLUMNS],
            cells: 0,
            lists: [[0; MAX_SEEN]; COLUMNS],
            counts: [0; COLUMNS],
            ends: [0; COLUMNS],
            points: [[0.0; N]; MAX_STORED],
            point_numbers: [0.0; MAX_STORED],
        }
    }
}

impl<const N: usize> Columns<N> {
    /// Plans the first `points` points of a row.
    ///
    /// Returns false if they lie in too many cells, or if columns do not hold all cells within
    /// reach.
    #[inline(always)]
    pub(super) fn plan<S: Lanes>(&mut self, s: S, metric: Metric, row: &Row<N>, points: usize) -> bool {
        let reach = metric.reach(N);
        if (2 * reach + 1).pow(N as u32 - 1) > SECTIONS {
            return false;
        }
        // Weights are not used.
        self.plan.make(s, Fade::Cubic, row, points);
        self.plan.crossed() + 2 * reach <= COLUMNS
    }

    /// Finds the candidate feature points of the cells of the planned row, and returns its position
    /// in them along all axes but the first.
    #[inline(always)]
    pub(super) fn fill<S: Lanes, L: Lattice>(
        &mut self,
        s: S,
        features: &Features<'_, L>,
        row: &Row<N>,
        second: bool,
    ) -> [f32; N] {
        let (reach, run) = (features.metric.reach(N), self.plan.run(0));
        let (mut cells, mut positions, mut slab) = ([0; N], [0.0; N], [[0.0; N]; 2]);
        for axis in 1..N {
            let (cell, t) = cell(Scalar, row.origin()[axis]);
            (cells[axis], positions[axis]) = (cell.0, t);
            let low = Scalar.floor(t * SLABS).min(SLABS - 1.0);
            (slab[0][axis], slab[1][axis]) = (low / SLABS, (low + 1.0) / SLABS);
        }
        let key = Key {
            first: run.leftmost.wrapping_sub(reach as i32),
            columns: run.cells + 2 * reach,
            descending: row.stride() < 0.0,
            cell: cells,
            seed: features.seed,
        };
        let drawn = self.key == Some(key);
        if !drawn {
            self.key = Some(key);
            self.reach = reach;
            self.sections = (2 * reach + 1).pow(N as u32 - 1).min(SECTIONS);
            self.draw(s, features, &key);
        }
        if !drawn || self.slab != slab {
            self.slab = slab;
            self.bound(s, features.metric, run.cells, second);
            self.list(s, features.metric, run.cells);
            self.copy(run.cells, key.descending);
        }
        positions
    }

    /// Draws the feature points of all cells.
    #[inline(always)]
    fn draw<S: Lanes, L: Lattice>(&mut self, s: S, features: &Features<'_, L>, key: &Key<N>) {
        let side = 2 * self.reach + 1;
        for j in 0..self.sections {
            let (mut terms, mut rest) = ([s.word(0); N], j);
            for axis in 1..N {
                let step = (rest % side) as i32 - self.reach as i32;
                rest /= side;
                self.steps[axis][j] = step as f32;
                let cell = key.cell[axis].wrapping_add(step as u32);
                terms[axis] = features.lattice.term(s, axis, s.word(cell));
            }
            for i in (0..key.columns).step_by(S::LEN) {
                let cells = s.word(key.first.wrapping_add(i as i32) as u32) + s.iota();
                terms[0] = features.lattice.term(s, 0, cells);
                let word = features.lattice.words(s, terms, features.seed);
                let positions = features.positions::<S, N>(s, word);
                s.store(positions[0], &mut self.positions[0][j][i..]);
                for axis in 1..N {
                    s.store(
                        s.float(self.steps[axis][j]) + positions[axis],
                        &mut self.positions[axis][j][i..],
                    );
                }
                s.store(number(s, word), &mut self.numbers[j][i..]);
            }
        }
    }

    /// Bounds the result in each cell by the feature points next to it, from the farthest corner of
    /// the slab.
    #[inline(always)]
    fn bound<S: Lanes>(&mut self, s: S, metric: Metric, cells: usize, second: bool) {
        let [low, high] = self.slab;
        for j in 0..self.sections {
            for i in (0..cells + 2 * self.reach).step_by(S::LEN) {
                let mut gaps = [s.float(0.0); 2];
                for axis in 1..N {
                    let position = s.load(&self.positions[axis][j][i..]);
                    let (below, above) = (position - s.float(low[axis]), position - s.float(high[axis]));
                    let gap = s.max(s.max(above, -below), s.float(0.0));
                    let offsets = [gap, s.max(s.abs(below), s.abs(above))];
                    for k in 0..2 {
                        gaps[k] = metric.joined(s, gaps[k], offsets[k]);
                    }
                }
                for k in 0..2 {
                    s.store(gaps[k], &mut self.gaps[k][j][i..]);
                }
            }
        }
        for i in (0..cells).step_by(S::LEN) {
            let mut bounds = [s.float(f32::INFINITY); 2];
            for j in 0..self.sections {
                if (1..N).any(|axis| self.steps[axis][j].abs() > 1.0) {
                    continue;
                }
                for near in [-1.0, 0.0, 1.0] {
                    let column = (i as f32 + self.reach as f32 + near) as usize;
                    let x = s.float(near) + s.load(&self.positions[0][j][column..]);
                    let farthest = s.max(s.abs(x), s.abs(s.float(1.0) - x));
                    let measure = metric.joined(s, s.load(&self.gaps[1][j][column..]), farthest);
                    bounds = [s.min(bounds[0], measure), s.min(bounds[1], s.max(bounds[0], measure))];
                }
            }
            s.store(bounds[usize::from(second)], &mut self.bounds[i..]);
        }
    }

    /// Lists the candidate feature points of each cell, in the order of their ranks.
    ///
    /// Sums and differences are rounded by the same formula here and at points, and rounding is
    /// monotonic.
    #[inline(always)]
    fn list<S: Lanes>(&mut self, s: S, metric: Metric, cells: usize) {
        self.counts = [0; COLUMNS];
        let largest = self.bounds.iter().take(cells).fold(0.0, |largest, &bound| bound.max(largest));
        for c in 0..=2 * self.reach {
            let step = c as f32 - self.reach as f32;
            for j in 0..self.sections {
                let mut gap = 0.0;
                for axis in 1..N {
                    let (below, above) = (
                        self.slab[0][axis] - (self.steps[axis][j] + 1.0),
                        self.steps[axis][j] - self.slab[1][axis],
                    );
                    gap = metric.joined(Scalar, gap, below.max(above).max(0.0));
                }
                if metric.joined(Scalar, gap, (step.abs() - 1.0).max(0.0)) > largest {
                    continue;
                }
                for i in (0..cells).step_by(S::LEN) {
                    let x = s.float(step) + s.load(&self.positions[0][j][i + c..]);
                    let offset = s.max(s.max(x - s.float(1.0), -x), s.float(0.0));
                    let measure = metric.joined(s, s.load(&self.gaps[0][j][i + c..]), offset);
                    let beyond = s.bitmask(s.less(s.load(&self.bounds[i..]), measure));
                    let mut seeing = !beyond & ((1 << S::LEN.min(cells - i)) - 1);
                    while seeing != 0 {
                        let k = i + seeing.trailing_zeros() as usize;
                        seeing &= seeing - 1;
                        let count = &mut self.counts[k % COLUMNS];
                        self.lists[k % COLUMNS][usize::from(*count) % MAX_SEEN] = (c << 5 | j) as u8;
                        *count += 1;
                    }
                }
            }
        }
    }

    /// Copies the listed feature points of as many cells as fit.
    #[inline(always)]
    fn copy(&mut self, cells: usize, descending: bool) {
        let mut end = 0;
        self.cells = 0;
        for i in 0..cells {
            let k = if descending { cells - 1 - i } else { i } % COLUMNS;
            let count = usize::from(self.counts[k]);
            let Some(points) = self.points.get_mut(end..end + count) else { return };
            let Some(numbers) = self.point_numbers.get_mut(end..end + count) else { return };
            for ((point, number), &packed) in points.iter_mut().zip(numbers).zip(&self.lists[k]) {
                let (c, j) = (usize::from(packed >> 5), usize::from(packed & 31) % SECTIONS);
                let column = (k + c) % COLUMNS;
                for axis in 0..N {
                    point[axis] = self.positions[axis][j][column];
                }
                point[0] = (c as f32 - self.reach as f32) + self.positions[0][j][column];
                *number = self.numbers[j][column];
            }
            end += count;
            self.ends[i % COLUMNS] = end as u16;
            self.cells += 1;
        }
    }

    /// The candidate feature points of the points of cell j of the run.
    #[inline(always)]
    pub(super) fn seen(&self, j: usize) -> Seen<'_, N> {
        let start = if j == 0 { 0 } else { self.ends[(j - 1) % COLUMNS] };
        let range = usize::from(start)..usize::from(self.ends[j % COLUMNS]);
        Seen {
            points: self.points.get(range.clone()).unwrap_or_default(),
            numbers: self.point_numbers.get(range).unwrap_or_default(),
        }
    }
}
