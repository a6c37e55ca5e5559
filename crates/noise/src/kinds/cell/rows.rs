//! Rows of cell noises: everything that is constant along a row, or from row to row of a grid, is
//! computed once.
//!
//! Positions and weights along the first axis are the same in all rows. The edges of cells are the
//! same in all rows that cross the same cells. Two edges are kept, so that the next row of cells
//! reuses one.

use crate::{
    kinds::cell::blend::{blend, edge, ends},
    kinds::cell::corner::{CellNoise, normalized},
    kinds::cell::corners::CellPosition,
    kinds::cell::row_edges::{Columns, Edges},
    kinds::cell::variance::axis_variance,
    lanes::{LANES, Lanes, Scalar},
    lattice::fade::Along,
    lattice::lattice::{Lattice, cell},
    row::cells::{POINTS, Plan, Run},
    row::row::{Row, Strip, no_slices},
};

/// The slot of the edge at a cell coordinate along the second axis.
#[inline(always)]
fn slot(second: i32) -> usize {
    second as usize % 2
}

/// Everything that the edges of an interval depend on, except the plan and their cell coordinate
/// along the second axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Key<const N: usize> {
    /// The bits of the coordinates from the third on.
    others: [u32; N],
    seed: u32,
    gradients: bool,
}

/// Two edges of the cells that an interval of a row crosses, and the data that they are computed
/// from.
#[derive(Clone)]
pub struct EdgeCache<const N: usize> {
    plan: Plan,
    key: Option<Key<N>>,
    /// The position of the row along all axes but the first, and its cell along the second.
    position: CellPosition<Scalar, N>,
    second: i32,
    columns: Columns<N>,
    edges: [Edges<N>; 2],
}

impl<const N: usize> Default for EdgeCache<N> {
    /// Not a constant, because copying a constant takes longer than writing zeros.
    #[inline(always)]
    fn default() -> Self {
        Self {
            plan: Plan::empty(),
            key: None,
            position: CellPosition::NOWHERE,
            second: 0,
            columns: Columns::empty(),
            edges: [Edges::empty(), Edges::empty()],
        }
    }
}

impl<const N: usize> EdgeCache<N> {
    /// The values along a row, and the gradients if `GRADIENTS`.
    #[inline(always)]
    pub(crate) fn rows<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        noise: &K,
        mut strip: Strip<'_, N, GRADIENTS>,
    ) -> usize {
        let count = strip.values.len();
        for start in (0..count).step_by(POINTS) {
            let part = strip.part(start..count.min(start + POINTS));
            self.plan(s, noise, &part.row, part.values.len(), part.seed, GRADIENTS);
            self.fill_edges::<K, S, GRADIENTS>(s, noise, part.seed);
            self.blend::<K, S, GRADIENTS>(s, part);
        }
        count
    }

    /// Plans the first `points` points of a row and discards the edges of other rows.
    #[inline(always)]
    fn plan<K: CellNoise<N>, S: Lanes>(
        &mut self,
        s: S,
        noise: &K,
        row: &Row<N>,
        points: usize,
        seed: u32,
        gradients: bool,
    ) {
        let origin = row.origin();
        let mut others = [0; N];
        for axis in 2..N {
            others[axis] = origin[axis].to_bits();
        }
        let key = Some(Key { others, seed, gradients });
        if self.plan.make(s, K::FADE, row, points) || self.key != key {
            self.move_to(noise, &origin, key);
        }
        if N > 1 {
            let (cell, t) = cell(Scalar, origin[1 % N]);
            self.second = cell.0 as i32;
            self.position.terms[1 % N] = noise.lattice().terms(Scalar, 1, cell);
            self.position.along[1 % N] = Along::new(Scalar, K::FADE, t);
        }
    }

    /// Discards the edges of another position along the axes from the third on.
    ///
    /// A separate function, because inlined code would be started for every row.
    #[inline(never)]
    fn move_to<K: CellNoise<N>>(&mut self, noise: &K, origin: &[f32; N], key: Option<Key<N>>) {
        self.key = key;
        self.edges[0].second = None;
        self.edges[1].second = None;
        self.position = CellPosition::new(Scalar, noise, origin, 2);
    }

    /// Computes the edges below and above the row unless they are present.
    #[inline(always)]
    fn fill_edges<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(&mut self, s: S, noise: &K, seed: u32) {
        for j in 0..ends::<N>() {
            let second = self.second.wrapping_add(j as i32);
            if self.edges[slot(second)].second != Some(second) {
                self.fill::<K, S, GRADIENTS>(s, noise, j, second, seed);
            }
        }
    }

    /// Computes the edges of the planned points at the lower or the upper end j of the second axis.
    ///
    /// Whole vectors are written for every cell. The next cell overwrites entries beyond the end of
    /// the cell.
    #[inline(always)]
    fn fill<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        noise: &K,
        j: usize,
        second: i32,
        seed: u32,
    ) {
        let Self { plan, position, columns, edges, .. } = self;
        let edges = &mut edges[slot(second)];
        edges.second = Some(second);
        let term = s.word(position.terms[1 % N][j].0);
        let position = position.splat(s);
        if plan.sparse {
            for i in (0..plan.points()).step_by(S::LEN) {
                let [first, next] = noise.lattice().terms(s, 0, plan.cells(s, i));
                let low = position.drawn_column(s, noise, [first, term], seed);
                let high = position.drawn_column(s, noise, [next, term], seed);
                let edge = edge::<K, S, N>(s, &low, &high, plan.along_from(s, i));
                edges.store::<K, S, GRADIENTS>(s, &edge, i);
            }
            return;
        }
        let (mut run, mut i) = (plan.run(0), 0);
        loop {
            draw::<K, S, N, GRADIENTS>(s, noise, &position, term, &run, seed, columns);
            for j in 0..run.cells {
                let (below, end) = plan.cell(&run, j);
                let low = columns.splat::<K, S, GRADIENTS>(s, below);
                let high = columns.splat::<K, S, GRADIENTS>(s, below + 1);
                while i < end {
                    let edge = edge::<K, S, N>(s, &low, &high, plan.along_from(s, i));
                    edges.store::<K, S, GRADIENTS>(s, &edge, i);
                    i += S::LEN;
                }
                i = end;
            }
            match plan.next(&run) {
                Some(next) => run = next,
                None => return,
            }
        }
    }

    /// The edges below and above the row.
    #[inline(always)]
    fn edges(&self) -> [&Edges<N>; 2] {
        let [even, odd] = &self.edges;
        if slot(self.second) == 0 { [even, odd] } else { [odd, even] }
    }

    /// The values of the planned points, and the gradients if `GRADIENTS`, from the edges below and
    /// above.
    #[inline(always)]
    fn blend<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(&self, s: S, strip: Strip<'_, N, GRADIENTS>) {
        let Strip { values, mut gradients, .. } = strip;
        let [below, above] = self.edges();
        let along = self.position.along[1 % N].splat(s);
        let rest = self.position.variance(Scalar).splat(s);
        let whole = values.len() / LANES;
        // The points after the last whole block are written through another block.
        let (mut tail, mut slopes) = ([[0.0; LANES]; 1], [[[0.0; LANES]; 1]; N]);
        for part in 0..if values.len().is_multiple_of(LANES) { 1 } else { 2 } {
            let mut blocks: [&mut [[f32; LANES]]; N] = no_slices();
            let (first, values) = if part == 0 {
                for (blocks, g) in blocks.iter_mut().zip(&mut gradients) {
                    *blocks = g.as_chunks_mut().0;
                }
                (0, values.as_chunks_mut().0)
            } else {
                for (blocks, g) in blocks.iter_mut().zip(&mut slopes) {
                    *blocks = g;
                }
                (whole, &mut tail[..])
            };
            let gradients = blocks;
            for (b, block) in (first..=POINTS / LANES).zip(values) {
                for k in (0..LANES).step_by(S::LEN) {
                    let edges =
                        [below.load::<K, S, GRADIENTS>(s, b, k), above.load::<K, S, GRADIENTS>(s, b, k)];
                    let mut sample = blend::<K, S, N, GRADIENTS>(s, &edges, along);
                    if K::NORMALIZED {
                        let variance = rest.at::<GRADIENTS>(axis_variance(s, &self.plan.along(s, b, k)));
                        sample = normalized::<S, N, GRADIENTS>(s, sample, variance);
                    }
                    s.store(sample.0, &mut block[k..]);
                    for axis in 0..if GRADIENTS { N } else { 0 } {
                        if let Some(block) = gradients[axis].get_mut(b - first) {
                            s.store(sample.1[axis], &mut block[k..]);
                        }
                    }
                }
            }
        }
        if whole * LANES < values.len() {
            copy(&tail[0], values, whole * LANES);
            for axis in 0..if GRADIENTS { N } else { 0 } {
                copy(&slopes[axis][0], gradients[axis], whole * LANES);
            }
        }
    }
}

/// Copies numbers from `start` on, up to the end of `to`.
#[inline(always)]
fn copy(from: &[f32; LANES], to: &mut [f32], start: usize) {
    for (to, from) in to.iter_mut().skip(start).zip(from) {
        *to = *from;
    }
}

/// The columns of a run at one end of the second axis, with the term of the end.
#[inline(always)]
fn draw<K: CellNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    position: &CellPosition<S, N>,
    term: S::U,
    run: &Run,
    seed: u32,
    columns: &mut Columns<N>,
) {
    let mut i = 0;
    while i <= run.cells {
        let cells = s.word(run.leftmost.wrapping_add(i as i32) as u32) + s.iota();
        let first = noise.lattice().term(s, 0, cells);
        columns.store::<K, S, GRADIENTS>(s, &position.drawn_column(s, noise, [first, term], seed), i);
        i += S::LEN;
    }
}
