//! Storage of the columns and edges that rows reuse: one number per column or point.

use crate::{
    kinds::cell::blend::{Edge, Line},
    kinds::cell::column::{Column, Plane},
    kinds::cell::corner::CellNoise,
    lanes::Lanes,
    row::cells::{COLUMNS, Numbers, ZEROS},
};

/// One number per column.
type OfColumns = [f32; COLUMNS];

/// c, a and b of the columns of a run, and of their derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Columns<const N: usize> {
    planes: [OfColumns; 3],
    derivatives: [[OfColumns; 3]; N],
}

/// e and f of the edges over the points of a row, and of their derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Edges<const N: usize> {
    /// The cell coordinate of the edges along the second axis.
    pub(crate) second: Option<i32>,
    pub(crate) lines: [Numbers; 2],
    pub(crate) derivatives: [[Numbers; 2]; N],
}

impl<const N: usize> Edges<N> {
    #[inline(always)]
    pub(crate) fn empty() -> Self {
        Self { second: None, lines: [ZEROS; 2], derivatives: [[ZEROS; 2]; N] }
    }

    /// Writes an edge in lanes for the points from `i` on.
    #[inline(always)]
    pub(crate) fn store<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        edge: &Edge<S, N>,
        i: usize,
    ) {
        put_line::<K, S, N>(s, &edge.line, &mut self.lines, i);
        if GRADIENTS {
            for axis in 0..N {
                if axis != 1 {
                    put_line::<K, S, N>(s, &edge.derivatives[axis], &mut self.derivatives[axis], i);
                }
            }
        }
    }

    /// Returns the edge in lanes for the points from `k` on of block `b`.
    #[inline(always)]
    pub(crate) fn load<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        b: usize,
        k: usize,
    ) -> Edge<S, N> {
        let mut edge = Edge::empty(s);
        edge.line = line::<K, S, N>(s, &self.lines, b, k);
        if GRADIENTS {
            for axis in 0..N {
                if axis != 1 {
                    edge.derivatives[axis] = line::<K, S, N>(s, &self.derivatives[axis], b, k);
                }
            }
        }
        edge
    }
}

#[inline(always)]
fn put_line<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    line: &Line<S>,
    [values, slopes]: &mut [Numbers; 2],
    i: usize,
) {
    s.store(line.value, &mut values.as_flattened_mut()[i..]);
    if K::HAS_GRADIENT && N > 1 {
        s.store(line.slope, &mut slopes.as_flattened_mut()[i..]);
    }
}

#[inline(always)]
fn line<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    [values, slopes]: &[Numbers; 2],
    b: usize,
    k: usize,
) -> Line<S> {
    let mut line = Line { value: s.load(&values[b][k..]), slope: s.float(0.0) };
    if K::HAS_GRADIENT && N > 1 {
        line.slope = s.load(&slopes[b][k..]);
    }
    line
}

impl<const N: usize> Columns<N> {
    #[inline(always)]
    pub(crate) fn empty() -> Self {
        Self { planes: [[0.0; COLUMNS]; 3], derivatives: [[[0.0; COLUMNS]; 3]; N] }
    }

    /// Writes columns in lanes from column `i` on.
    #[inline(always)]
    pub(crate) fn store<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        column: &Column<S, N>,
        i: usize,
    ) {
        put_plane::<K, S, N>(s, &column.plane, &mut self.planes, i);
        if GRADIENTS {
            for axis in 2..N {
                put_plane::<K, S, N>(s, &column.derivatives[axis], &mut self.derivatives[axis], i);
            }
        }
    }

    /// Returns column k in every lane.
    #[inline(always)]
    pub(crate) fn splat<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        k: usize,
    ) -> Column<S, N> {
        let mut column = Column::empty(s);
        column.plane = splat_plane(s, &self.planes, k);
        if GRADIENTS {
            for axis in 2..N {
                column.derivatives[axis] = splat_plane(s, &self.derivatives[axis], k);
            }
        }
        column
    }
}

#[inline(always)]
fn put_plane<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    plane: &Plane<S>,
    [values, first, second]: &mut [OfColumns; 3],
    i: usize,
) {
    s.store(plane.value, &mut values[i..]);
    if K::HAS_GRADIENT {
        s.store(plane.slopes[0], &mut first[i..]);
        s.store(plane.slopes[1], &mut second[i..]);
    }
}

#[inline(always)]
fn splat_plane<S: Lanes>(s: S, [values, first, second]: &[OfColumns; 3], k: usize) -> Plane<S> {
    let k = k % COLUMNS;
    Plane { value: s.float(values[k]), slopes: [s.float(first[k]), s.float(second[k])] }
}
