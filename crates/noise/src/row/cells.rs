//! The cells of a row's points, and the points' positions and weights in them, equal in all rows of
//! a grid.

use crate::{
    lanes::{LANES, Lanes, Scalar},
    lattice::fade::{Along, Fade},
    row::row::{Row, RowKey},
};

/// The number of points of a row that are planned at once.
pub(crate) const POINTS: usize = 512;
/// The number of lattice points that are computed at once along a row.
pub(crate) const COLUMNS: usize = 64;
/// The step from which on cells have so few points that every point computes its own columns.
const SPARSE_STEP: f32 = 0.22;

/// One number per point, with space for a vector that begins at the last.
pub(crate) type Numbers = [[f32; LANES]; POINTS / LANES + 1];

pub(crate) const ZEROS: Numbers = [[0.0; LANES]; POINTS / LANES + 1];

/// Whether cells hold several points each, and where they begin can be computed.
#[inline(always)]
pub(crate) fn has_columns<const N: usize>(row: &Row<N>, count: usize, longest: f32) -> bool {
    let step = row.stride().abs();
    let reach = row.x(0).abs().max(row.x(count).abs());
    step < longest && step > reach * 1e-6 && count < 1 << 24
}

/// The cells of a row's points, and the points' positions and weights in them.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// The row of the plan.
    key: Option<(RowKey, Fade, usize)>,
    /// The first point's cell, and whether cells descend from it.
    cell: i32,
    descending: bool,
    /// Whether cells have few points. Then only the cells of points are stored, not the points of
    /// cells.
    pub(crate) sparse: bool,
    /// The index after the last point of every cell, in the order of the points. There are at most
    /// as many cells as points.
    cells: usize,
    ends: [u16; POINTS],
    floor: Numbers,
    position: Numbers,
    weight: Numbers,
    slope: Numbers,
}

/// Cells whose columns are computed at once. There is one more column than cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    /// The first cell in the order of the points.
    first: usize,
    pub(crate) cells: usize,
    /// The lattice point of the first column, in ascending order.
    pub(crate) leftmost: i32,
}

impl Plan {
    #[inline(always)]
    pub(crate) fn empty() -> Self {
        Self {
            key: None,
            cell: 0,
            descending: false,
            sparse: false,
            cells: 0,
            ends: [0; POINTS],
            floor: ZEROS,
            position: ZEROS,
            weight: ZEROS,
            slope: ZEROS,
        }
    }

    /// Plans the first `points` points of a row, and returns whether the plan changed.
    #[inline(always)]
    pub(crate) fn make<S: Lanes, const N: usize>(
        &mut self,
        s: S,
        fade: Fade,
        row: &Row<N>,
        points: usize,
    ) -> bool {
        let key = Some((row.key(), fade, points));
        if self.key == key {
            return false;
        }
        self.key = key;
        self.sparse = !has_columns(row, points, SPARSE_STEP);
        if self.sparse {
            for i in (0..points).step_by(S::LEN) {
                let x = row.xs(s, i);
                let floor = s.floor(x);
                s.store(floor, &mut self.floor.as_flattened_mut()[i..]);
                self.store(s, fade, x - floor, i);
            }
            return true;
        }
        self.cell = Scalar.floor(row.x(0)) as i32;
        self.descending = row.stride() < 0.0;
        self.cells = 0;
        let inverse = 1.0 / row.stride();
        let (mut i, mut cell) = (0, self.cell);
        while i < points && self.cells < POINTS {
            let floor = cell as f32;
            let end = end_of_cell(row, floor, inverse, i, points);
            self.ends[self.cells] = end as u16;
            self.cells += 1;
            while i < end {
                self.store(s, fade, row.xs(s, i) - s.float(floor), i);
                i += S::LEN;
            }
            i = end;
            cell = if self.descending { cell.wrapping_sub(1) } else { cell.wrapping_add(1) };
        }
        true
    }

    /// Writes positions from point `i` on, and their weights.
    #[inline(always)]
    fn store<S: Lanes>(&mut self, s: S, fade: Fade, t: S::F, i: usize) {
        s.store(t, &mut self.position.as_flattened_mut()[i..]);
        s.store(fade.weight(s, t), &mut self.weight.as_flattened_mut()[i..]);
        s.store(fade.slope(s, t), &mut self.slope.as_flattened_mut()[i..]);
    }

    /// The number of points.
    #[inline(always)]
    pub(crate) fn points(&self) -> usize {
        self.key.map_or(0, |(.., points)| points.min(POINTS))
    }

    /// The number of cells.
    #[inline(always)]
    pub(crate) fn crossed(&self) -> usize {
        self.cells
    }

    /// The run of cells from `first` on; empty after the last cell.
    #[inline(always)]
    pub(crate) fn run(&self, first: usize) -> Run {
        let cells = self.cells.saturating_sub(first).min(COLUMNS - 1);
        let leftmost = if self.descending {
            self.cell.wrapping_sub((first + cells) as i32).wrapping_add(1)
        } else {
            self.cell.wrapping_add(first as i32)
        };
        Run { first, cells, leftmost }
    }

    /// The run after this one.
    #[inline(always)]
    pub(crate) fn next(&self, run: &Run) -> Option<Run> {
        let next = self.run(run.first + run.cells);
        if next.cells > 0 { Some(next) } else { None }
    }

    /// The column below cell j of a run, and the index after the cell's last point.
    #[inline(always)]
    pub(crate) fn cell(&self, run: &Run, j: usize) -> (usize, usize) {
        let column = if self.descending { run.cells - 1 - j } else { j };
        (column % COLUMNS, usize::from(self.ends[(run.first + j) % POINTS]).min(POINTS))
    }

    /// The cells of one point per lane, from point `i` on, where points are sparse.
    #[inline(always)]
    pub(crate) fn cells<S: Lanes>(&self, s: S, i: usize) -> S::U {
        s.integer(s.load(&self.floor.as_flattened()[i..]))
    }

    /// The positions of one point per lane, from point `k` of block `b` on.
    #[inline(always)]
    pub(crate) fn along<S: Lanes>(&self, s: S, b: usize, k: usize) -> Along<S> {
        Along {
            position: s.load(&self.position[b][k..]),
            weight: s.load(&self.weight[b][k..]),
            slope: s.load(&self.slope[b][k..]),
        }
    }

    /// The positions of one point per lane, from point `i` on.
    #[inline(always)]
    pub(crate) fn along_from<S: Lanes>(&self, s: S, i: usize) -> Along<S> {
        Along {
            position: s.load(&self.position.as_flattened()[i..]),
            weight: s.load(&self.weight.as_flattened()[i..]),
            slope: s.load(&self.slope.as_flattened()[i..]),
        }
    }
}

/// The index after the last point from `i` on in the cell at `floor`.
#[inline(always)]
pub(crate) fn end_of_cell<const N: usize>(
    row: &Row<N>,
    floor: f32,
    inverse: f32,
    i: usize,
    count: usize,
) -> usize {
    let border = if row.stride() < 0.0 { floor } else { floor + 1.0 };
    let guess = (border - row.x(0)) * inverse;
    let mut end = (guess as i32).max(0) as usize;
    end = end.clamp(i, count);
    let inside = |i: usize| {
        let x = row.x(i);
        if row.stride() < 0.0 { x >= floor } else { x < border }
    };
    while end < count && inside(end) {
        end += 1;
    }
    while end > i && !inside(end - 1) {
        end -= 1;
    }
    end
}
