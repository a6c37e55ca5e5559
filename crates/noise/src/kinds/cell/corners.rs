//! The cell of a point: random numbers at its corners, blended into columns and edges.

use core::num::Wrapping;

use crate::{
    kinds::cell::blend::{Edge, blend, edge, ends, lerp},
    kinds::cell::column::Column,
    kinds::cell::corner::{CellNoise, Corner},
    kinds::cell::variance::{Variance, axis_variance},
    lanes::{LaneSample, Lanes, Scalar},
    lattice::fade::Along,
    lattice::lattice::{Lattice, cell},
};

/// The number of corners at one end of the first two axes, by dimension.
pub(crate) const CORNERS: [usize; 5] = [0, 1, 1, 2, 4];

/// The cell of a point, and the point's position in it.
#[derive(Clone, Copy)]
pub(crate) struct CellPosition<S: Lanes, const N: usize> {
    /// The lattice's terms of the lower and the upper ends.
    pub(crate) terms: [[S::U; 2]; N],
    pub(crate) along: [Along<S>; N],
}

impl<const N: usize> CellPosition<Scalar, N> {
    pub(crate) const NOWHERE: Self =
        Self { terms: [[Wrapping(0); 2]; N], along: [Along { position: 0.0, weight: 0.0, slope: 0.0 }; N] };

    /// This position in every lane.
    #[inline(always)]
    pub(crate) fn splat<S: Lanes>(&self, s: S) -> CellPosition<S, N> {
        let mut position = CellPosition { terms: [[s.word(0); 2]; N], along: [self.along[0].splat(s); N] };
        for axis in 0..N {
            let [low, high] = self.terms[axis];
            position.terms[axis] = [s.word(low.0), s.word(high.0)];
            position.along[axis] = self.along[axis].splat(s);
        }
        position
    }
}

/// The corners of a cell, by the ends along the first axis, the second, and the others as bits of
/// an index.
pub(crate) type Corners<T> = [[[T; 4]; 2]; 2];

impl<S: Lanes, const N: usize> CellPosition<S, N> {
    /// The position of a point along the axes from `first` on; earlier axes are unused.
    #[inline(always)]
    pub(crate) fn new<K: CellNoise<N>>(s: S, noise: &K, p: &[S::F; N], first: usize) -> Self {
        let zero = s.float(0.0);
        let nowhere = Along { position: zero, weight: zero, slope: zero };
        let mut position = Self { terms: [[s.word(0); 2]; N], along: [nowhere; N] };
        for axis in first..N {
            let (cell, t) = cell(s, p[axis]);
            position.terms[axis] = noise.lattice().terms(s, axis, cell);
            position.along[axis] = Along::new(s, K::FADE, t);
        }
        position
    }

    /// The word of corner `k` of the column whose terms of the first axes are `first` and `second`.
    ///
    /// Bit i of k selects the end along axis i + 2.
    #[inline(always)]
    pub(crate) fn word<K: CellNoise<N>>(
        &self,
        s: S,
        noise: &K,
        [first, second]: [S::U; 2],
        k: usize,
        seed: u32,
    ) -> S::U {
        let mut terms = [first; N];
        for axis in 1..N {
            terms[axis] = if axis == 1 { second } else { self.terms[axis][k >> (axis - 2) & 1] };
        }
        if K::UPPER_BITS {
            noise.lattice().upper_words(s, terms, seed)
        } else {
            noise.lattice().words(s, terms, seed)
        }
    }

    /// Draws numbers from the words at the corners of the cell.
    #[inline(always)]
    pub(crate) fn corners<K: CellNoise<N>, T: Copy>(
        &self,
        s: S,
        noise: &K,
        seed: u32,
        nothing: T,
        draw: impl Fn(S::U) -> T,
    ) -> Corners<T> {
        let mut corners = [[[nothing; 4]; 2]; 2];
        for i in 0..2 {
            for j in 0..ends::<N>() {
                for k in 0..CORNERS[N] {
                    let terms = [self.terms[0][i], self.terms[1 % N][j]];
                    corners[i][j][k] = draw(self.word(s, noise, terms, k, seed));
                }
            }
        }
        corners
    }

    /// The column with the given terms of the first axes.
    #[inline(always)]
    pub(crate) fn drawn_column<K: CellNoise<N>>(
        &self,
        s: S,
        noise: &K,
        terms: [S::U; 2],
        seed: u32,
    ) -> Column<S, N> {
        let mut words = [s.word(0); 4];
        for k in 0..CORNERS[N] {
            words[k] = self.word(s, noise, terms, k, seed);
        }
        self.column(s, noise, &words)
    }

    /// The blend of the corners at one end of the first two axes, given their words.
    #[inline(always)]
    pub(crate) fn column<K: CellNoise<N>>(&self, s: S, noise: &K, words: &[S::U; 4]) -> Column<S, N> {
        if let Some(column) = noise.column(s, &self.along, words) {
            return column;
        }
        let mut corners = [Corner::nothing(s); 4];
        for k in 0..CORNERS[N] {
            corners[k] = noise.corner(s, words[k]);
        }
        self.column_of::<K>(s, &corners)
    }

    /// The blend of the corners at one end of the first two axes.
    #[inline(always)]
    fn column_of<K: CellNoise<N> + ?Sized>(&self, s: S, corners: &[Corner<S, N>; 4]) -> Column<S, N> {
        let mut columns = [Column::empty(s); 4];
        for k in 0..CORNERS[N] {
            columns[k] = self.leaf::<K>(s, &corners[k], k);
        }
        for axis in 2..N {
            for i in 0..CORNERS[N] >> (axis - 1) {
                columns[i] = self.blend::<K>(columns[2 * i], columns[2 * i + 1], axis);
            }
        }
        columns[0]
    }

    /// The function of corner `k` over the first two axes.
    #[inline(always)]
    fn leaf<K: CellNoise<N> + ?Sized>(&self, s: S, corner: &Corner<S, N>, k: usize) -> Column<S, N> {
        let mut column = Column::empty(s);
        column.plane.value = corner.value;
        if K::HAS_GRADIENT {
            for axis in 0..N {
                let slope = corner.gradient[axis];
                if axis < 2 {
                    column.plane.slopes[axis] = slope;
                    continue;
                }
                let d = match k >> (axis - 2) & 1 {
                    0 => self.along[axis].position,
                    _ => self.along[axis].position - s.float(1.0),
                };
                let value = column.plane.value;
                column.plane.value = if axis == 2 && !K::HAS_VALUE { slope * d } else { value + slope * d };
                column.derivatives[axis].value = slope;
            }
        }
        column
    }

    /// The blend of two ends along `axis`; earlier axes have been blended.
    #[inline(always)]
    fn blend<K: CellNoise<N> + ?Sized>(
        &self,
        low: Column<S, N>,
        high: Column<S, N>,
        axis: usize,
    ) -> Column<S, N> {
        let Along { weight: w, slope, .. } = self.along[axis];
        let mut blend = low;
        let (from, to) = (low.plane, high.plane);
        blend.plane.value = lerp::<S>(from.value, to.value, w);
        for i in 2..N {
            let (from, to) = (low.derivatives[i], high.derivatives[i]);
            if K::HAS_GRADIENT || i < axis {
                blend.derivatives[i].value = lerp::<S>(from.value, to.value, w);
            }
            if K::HAS_GRADIENT && i < axis {
                for k in 0..2 {
                    blend.derivatives[i].slopes[k] = lerp::<S>(from.slopes[k], to.slopes[k], w);
                }
            }
        }
        let rise = slope * (to.value - from.value);
        let derivative = &mut blend.derivatives[axis];
        derivative.value = if K::HAS_GRADIENT { derivative.value + rise } else { rise };
        if K::HAS_GRADIENT {
            for k in 0..2 {
                blend.plane.slopes[k] = lerp::<S>(from.slopes[k], to.slopes[k], w);
                blend.derivatives[axis].slopes[k] = slope * (to.slopes[k] - from.slopes[k]);
            }
        }
        blend
    }

    /// The edge at end j of the second axis.
    #[inline(always)]
    fn drawn_edge<K: CellNoise<N>>(&self, s: S, noise: &K, j: usize, seed: u32) -> Edge<S, N> {
        let ([first, next], second) = (self.terms[0], self.terms[1 % N][j]);
        let low = self.drawn_column(s, noise, [first, second], seed);
        let high = self.drawn_column(s, noise, [next, second], seed);
        edge::<K, S, N>(s, &low, &high, self.along[0])
    }

    /// The edges of the cell; a single edge in 1-D.
    #[inline(always)]
    pub(crate) fn drawn_edges<K: CellNoise<N>>(&self, s: S, noise: &K, seed: u32) -> [Edge<S, N>; 2] {
        let low = self.drawn_edge(s, noise, 0, seed);
        [low, if N == 1 { low } else { self.drawn_edge(s, noise, 1, seed) }]
    }

    /// n and v with their gradients, from the corners.
    #[inline(always)]
    pub(crate) fn parts_of<K: CellNoise<N>>(
        &self,
        s: S,
        corners: &Corners<Corner<S, N>>,
    ) -> (LaneSample<S, N>, LaneSample<S, N>) {
        let mut edges = [Edge::empty(s); 2];
        for j in 0..ends::<N>() {
            let [low, high] =
                [self.column_of::<K>(s, &corners[0][j]), self.column_of::<K>(s, &corners[1][j])];
            edges[j] = edge::<K, S, N>(s, &low, &high, self.along[0]);
        }
        self.parts::<K, true>(s, &edges)
    }

    /// n, and v if the noise is normalized, with their gradients if `GRADIENTS`.
    #[inline(always)]
    pub(crate) fn parts<K: CellNoise<N>, const GRADIENTS: bool>(
        &self,
        s: S,
        edges: &[Edge<S, N>; 2],
    ) -> (LaneSample<S, N>, LaneSample<S, N>) {
        let sample = blend::<K, S, N, GRADIENTS>(s, edges, self.along[1 % N]);
        if !K::NORMALIZED {
            return (sample, sample);
        }
        let axis = axis_variance(s, &self.along[0]);
        (sample, self.variance(s).at::<GRADIENTS>(axis))
    }

    /// The variance from all axes but the first.
    #[inline(always)]
    pub(crate) fn variance(&self, s: S) -> Variance<S, N> {
        Variance::new(s, &self.along)
    }
}
