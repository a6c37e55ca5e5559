//! Blends along the first two axes of a cell: columns into edges, edges into the value.

use crate::{
    kinds::cell::column::{Column, Plane},
    kinds::cell::corner::CellNoise,
    lanes::{LaneSample, Lanes},
    lattice::fade::Along,
};

#[inline(always)]
pub(crate) fn lerp<S: Lanes>(a: S::F, b: S::F, w: S::F) -> S::F {
    a + w * (b - a)
}

/// e + f y.
#[derive(Clone, Copy)]
pub(crate) struct Line<S: Lanes> {
    pub(crate) value: S::F,
    pub(crate) slope: S::F,
}

/// The blend of two columns along the first axis, and its derivatives.
#[derive(Clone, Copy)]
pub(crate) struct Edge<S: Lanes, const N: usize> {
    pub(crate) line: Line<S>,
    /// The entry for the second axis is unused.
    pub(crate) derivatives: [Line<S>; N],
}

impl<S: Lanes, const N: usize> Edge<S, N> {
    #[inline(always)]
    pub(crate) fn empty(s: S) -> Self {
        let line = Line { value: s.float(0.0), slope: s.float(0.0) };
        Self { line, derivatives: [line; N] }
    }
}

/// The number of ends of the second axis: one if the axis does not exist.
pub(crate) const fn ends<const N: usize>() -> usize {
    if N == 1 { 1 } else { 2 }
}

/// The values of the functions of both ends of an edge at t.
#[inline(always)]
fn heights<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    low: &Plane<S>,
    high: &Plane<S>,
    t: S::F,
) -> [S::F; 2] {
    if !K::HAS_GRADIENT {
        return [low.value, high.value];
    }
    let (a, b) = (low.slopes[0] * t, high.slopes[0] * (t - s.float(1.0)));
    if K::HAS_VALUE || N > 2 { [low.value + a, high.value + b] } else { [a, b] }
}

/// The blend of the functions of two columns.
#[inline(always)]
fn line<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    low: &Plane<S>,
    high: &Plane<S>,
    along: Along<S>,
) -> Line<S> {
    let [a, b] = heights::<K, S, N>(s, low, high, along.position);
    let mut line = Line { value: lerp::<S>(a, b, along.weight), slope: s.float(0.0) };
    if K::HAS_GRADIENT && N > 1 {
        line.slope = lerp::<S>(low.slopes[1], high.slopes[1], along.weight);
    }
    line
}

/// The blend of two columns along the first axis.
#[inline(always)]
pub(crate) fn edge<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    low: &Column<S, N>,
    high: &Column<S, N>,
    along: Along<S>,
) -> Edge<S, N> {
    let mut edge = Edge::empty(s);
    edge.line = line::<K, S, N>(s, &low.plane, &high.plane, along);
    for axis in 2..N {
        edge.derivatives[axis] = line::<K, S, N>(s, &low.derivatives[axis], &high.derivatives[axis], along);
    }
    let [a, b] = heights::<K, S, N>(s, &low.plane, &high.plane, along.position);
    let rise = along.slope * (b - a);
    edge.derivatives[0].value = rise;
    if !K::HAS_GRADIENT {
        let unit = s.float(K::UNIT);
        edge.line.value = edge.line.value * unit;
        for axis in 0..N {
            edge.derivatives[axis].value = edge.derivatives[axis].value * unit;
        }
    }
    if K::HAS_GRADIENT {
        let ([a, c], [b, d]) = (low.plane.slopes, high.plane.slopes);
        edge.derivatives[0].value = lerp::<S>(a, b, along.weight) + rise;
        if N > 1 {
            edge.derivatives[0].slope = along.slope * (d - c);
        }
    }
    edge
}

/// The blend of the functions of two edges.
#[inline(always)]
fn across<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    [low, high]: [Line<S>; 2],
    along: Along<S>,
) -> S::F {
    if N == 1 {
        return low.value;
    }
    let [a, b] = offsets::<K, S, N>(s, [low, high], along.position);
    lerp::<S>(a, b, along.weight)
}

/// The functions of two edges at their distances from u.
#[inline(always)]
fn offsets<K: CellNoise<N>, S: Lanes, const N: usize>(s: S, [low, high]: [Line<S>; 2], u: S::F) -> [S::F; 2] {
    if K::HAS_GRADIENT {
        [low.value + u * low.slope, high.value + (u - s.float(1.0)) * high.slope]
    } else {
        [low.value, high.value]
    }
}

/// The value of the blend of two edges along the second axis, and its gradient if `GRADIENTS`.
#[inline(always)]
pub(crate) fn blend<K: CellNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    [low, high]: &[Edge<S, N>; 2],
    along: Along<S>,
) -> LaneSample<S, N> {
    let lines = [low.line, high.line];
    let value = across::<K, S, N>(s, lines, along);
    let mut gradient = [value; N];
    for axis in 0..if GRADIENTS { N } else { 0 } {
        if axis == 1 {
            let [a, b] = offsets::<K, S, N>(s, lines, along.position);
            let rise = along.slope * (b - a);
            gradient[axis] = if K::HAS_GRADIENT {
                lerp::<S>(low.line.slope, high.line.slope, along.weight) + rise
            } else {
                rise
            };
        } else {
            let lines = [low.derivatives[axis], high.derivatives[axis]];
            gradient[axis] = across::<K, S, N>(s, lines, along);
        }
    }
    (if K::CLAMPED { s.within_one(value) } else { value }, gradient)
}
