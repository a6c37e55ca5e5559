//! Rows of cellular noise: the feature points that the points of a cell can have nearest are found once for all of them.

use crate::{
    kinds::cell::blend::splat,
    kinds::cellular::metric::Metric,
    kinds::cellular::search::{Features, Place, number},
    lanes::lanes::{Lanes, Scalar},
    lattice::lattice::Lattice,
    row::row::Row,
};

/// Steps from here on leave too few points in a cell for columns to pay.
pub(super) const LONG_STEP: f32 = 0.5;
/// Columns of cells that are computed at once along a row.
const COLUMNS: usize = 32;
/// The most cells of a column: 5² in space in the Euclidean metric, 3³ in that of Chebyshev in 4-D.
const SECTIONS: usize = 27;

type Numbers = [[f32; COLUMNS]; SECTIONS];

/// The feature points of the columns that a stretch of a row crosses.
#[derive(Clone, Debug)]
pub struct Columns<const N: usize> {
    /// Line for which the places were computed.
    key: Option<Key<N>>,
    /// Reach of columns, and the number of cells in each.
    reach: usize,
    sections: usize,
    /// The steps to the cells of a column.
    steps: [[f32; SECTIONS]; N],
    /// Places in their cells, ways along the axes but the first, their measure, and the numbers of the cells.
    places: [Numbers; N],
    ways: [Numbers; N],
    rest: Numbers,
    number: Numbers,
    /// The greatest measure that the feature point sought can have in a cell.
    bound: [f32; COLUMNS],
    pub(super) seen: [Seen<N>; MOST],
}

/// All that the words of columns depend on: the first column and their number, the row's cell along the other axes, the seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Key<const N: usize> {
    first: i32,
    columns: usize,
    cell: [u32; N],
    seed: u32,
}

/// A feature point that points of a cell can have nearest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen<const N: usize> {
    pub(super) x: f32,
    pub(super) rest: f32,
    pub(super) ways: [f32; N],
    pub(super) number: f32,
}

/// The most feature points of the columns around a cell.
const MOST: usize = SECTIONS * 5;

impl<const N: usize> Default for Columns<N> {
    fn default() -> Self {
        let numbers = [[0.0; COLUMNS]; SECTIONS];
        Self {
            key: None,
            reach: 0,
            sections: 0,
            steps: [[0.0; SECTIONS]; N],
            places: [numbers; N],
            ways: [numbers; N],
            rest: numbers,
            number: numbers,
            bound: [0.0; COLUMNS],
            seen: [Seen { x: 0.0, rest: 0.0, ways: [0.0; N], number: 0.0 }; MOST],
        }
    }
}

impl<const N: usize> Columns<N> {
    /// Whether a column holds all cells within a metric's reach.
    #[inline(always)]
    pub(super) const fn holds(reach: usize) -> bool {
        (2 * reach + 1).pow(N as u32 - 1) <= SECTIONS
    }

    /// The most cells that are computed at once.
    #[inline(always)]
    pub(super) const fn cells(reach: usize) -> usize {
        COLUMNS - 2 * reach
    }

    /// The feature points around `count` cells from `leftmost` on, as a row sees them.
    #[inline(always)]
    pub(super) fn fill<S: Lanes, L: Lattice>(
        &mut self,
        s: S,
        features: &Features<'_, L>,
        row: &Row<N>,
        [leftmost, count]: [i32; 2],
        second: bool,
    ) {
        let place = Place::<S, N>::new(s, splat(s, row.origin()));
        let reach = features.metric.reach(N);
        let (first, columns) = (leftmost.wrapping_sub(reach as i32), count as usize + 2 * reach);
        let mut cell = [0; N];
        for axis in 1..N {
            cell[axis] = s.lane_word(place.cell[axis], 0);
        }
        let key = Key { first, columns, cell, seed: features.seed };
        if self.key != Some(key) {
            self.key = Some(key);
            self.reach = reach;
            self.sections = (2 * reach + 1).pow(N as u32 - 1).min(SECTIONS);
            self.draw(s, features, &place, first, columns);
        }
        for j in 0..self.sections {
            for i in (0..columns).step_by(S::LEN) {
                let mut rest = s.float(0.0);
                for axis in 1..N {
                    let step = s.float(self.steps[axis][j]);
                    let way = place.t[axis] - (step + s.load_part(&self.places[axis][j][i..]));
                    rest = features.metric.joined(s, rest, way);
                    s.store(way, &mut self.ways[axis][j][i..]);
                }
                s.store(rest, &mut self.rest[j][i..]);
            }
        }
        self.bound(s, features.metric, count as usize, second);
    }

    /// Draws the feature points of all cells.
    #[inline(always)]
    fn draw<S: Lanes, L: Lattice>(
        &mut self,
        s: S,
        features: &Features<'_, L>,
        place: &Place<S, N>,
        first: i32,
        columns: usize,
    ) {
        let side = 2 * self.reach + 1;
        for j in 0..self.sections {
            let (mut terms, mut rest) = ([s.word(0); N], j);
            for axis in 1..N {
                let step = (rest % side) as i32 - self.reach as i32;
                rest /= side;
                self.steps[axis][j] = step as f32;
                terms[axis] = features.lattice.term(s, axis, place.cell[axis] + s.word(step as u32));
            }
            for i in (0..columns).step_by(S::LEN) {
                let cells = s.word(first.wrapping_add(i as i32) as u32) + s.iota();
                terms[0] = features.lattice.term(s, 0, cells);
                let word = features.lattice.words(s, terms, features.seed);
                let places = features.places::<S, N>(s, word);
                for axis in 0..N {
                    s.store(places[axis], &mut self.places[axis][j][i..]);
                }
                s.store(number(s, word), &mut self.number[j][i..]);
            }
        }
    }

    /// Bounds what is sought in each cell by the feature points next to it, from the farther end of the cell.
    #[inline(always)]
    fn bound<S: Lanes>(&mut self, s: S, metric: Metric, count: usize, second: bool) {
        for i in (0..count).step_by(S::LEN) {
            let mut bounds = [s.float(f32::INFINITY); 2];
            for j in 0..self.sections {
                if (1..N).any(|axis| self.steps[axis][j].abs() > 1.0) {
                    continue;
                }
                for near in [-1.0, 0.0, 1.0] {
                    let column = (i as f32 + self.reach as f32 + near) as usize;
                    let x = s.float(near) + s.load_part(&self.places[0][j][column..]);
                    let farthest = s.max(s.abs(x), s.abs(s.float(1.0) - x));
                    let measure = metric.joined(s, s.load_part(&self.rest[j][column..]), farthest);
                    bounds = [s.min(bounds[0], measure), s.min(bounds[1], s.max(bounds[0], measure))];
                }
            }
            s.store(bounds[usize::from(second)], &mut self.bound[i..]);
        }
    }

    /// The feature points that points of cell k can have nearest, in the order of their ranks; their count.
    ///
    /// Sums and differences are rounded by one formula here and at points, and rounding keeps their order.
    #[inline(always)]
    pub(super) fn see(&mut self, metric: Metric, k: usize) -> usize {
        let joined = |rest, way| metric.joined(Scalar, rest, way);
        let bound = self.bound[k % COLUMNS];
        let mut count = 0;
        for c in 0..=2 * self.reach {
            let (step, column) = (c as f32 - self.reach as f32, (k + c) % COLUMNS);
            if joined(0.0, (step.abs() - 1.0).max(0.0)) > bound {
                continue;
            }
            for j in 0..self.sections.min(SECTIONS) {
                let rest = self.rest[j][column];
                if rest > bound {
                    continue;
                }
                let x = step + self.places[0][j][column];
                if joined(rest, (x - 1.0).max(-x).max(0.0)) <= bound && count < MOST {
                    let mut ways = [0.0; N];
                    for axis in 1..N {
                        ways[axis] = self.ways[axis][j][column];
                    }
                    self.seen[count] = Seen { x, rest, ways, number: self.number[j][column] };
                    count += 1;
                }
            }
        }
        count
    }
}
