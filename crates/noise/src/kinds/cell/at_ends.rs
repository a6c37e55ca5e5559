//! Evaluation of one point in lanes, one lane per end of the first two axes of its cell.

use crate::{
    kinds::cell::blend::lerp,
    kinds::cell::column::Plane,
    kinds::cell::corner::{CellNoise, normalized},
    kinds::cell::corners::{CORNERS, CellPosition},
    kinds::cell::variance::axis_variance,
    lanes::{Arithmetic, LANES, LaneSample, Lanes, Scalar},
    lattice::fade::Along,
    lattice::lattice::{Lattice, at_ends, cell},
};

/// e + f y in two of every four lanes, one per end of the second axis.
struct Line<S: Lanes> {
    value: S::F,
    slope: S::F,
}

/// Height of a plane at a distance along the first axis.
#[inline(always)]
fn height<K: CellNoise<N>, S: Lanes, const N: usize>(plane: &Plane<S>, delta: S::F) -> S::F {
    if !K::HAS_GRADIENT {
        return plane.value;
    }
    let rise = plane.slopes[0] * delta;
    if K::HAS_VALUE || N > 2 { plane.value + rise } else { rise }
}

/// The blend of a number at the lower and the upper end of the first axis.
#[inline(always)]
fn along_first<S: Lanes>(s: S, x: S::F, along: &Along<S>) -> S::F {
    lerp::<S>(x, s.turned::<2>(x), along.weight)
}

/// A line's function along the second axis, and the blend of its lower and upper end.
#[inline(always)]
fn along_second<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    line: &Line<S>,
    delta: S::F,
    along: &Along<S>,
) -> [S::F; 2] {
    let offset = if K::HAS_GRADIENT { line.value + delta * line.slope } else { line.value };
    [offset, lerp::<S>(offset, s.turned::<1>(offset), along.weight)]
}

/// The cell of a point, the words of its corners, and n and v with their gradients.
///
/// Every four lanes hold the words, one lane per end of the first two axes, and the first of them
/// holds n, and v if the noise is normalized.
pub(crate) struct Ends<S: Lanes, const N: usize> {
    #[cfg(feature = "simd")]
    pub(crate) position: CellPosition<S, N>,
    #[cfg(feature = "simd")]
    pub(crate) words: [S::U; 4],
    pub(crate) parts: (LaneSample<S, N>, LaneSample<S, N>),
}

/// The value of one point, and the gradient if `GRADIENTS`, by four lanes.
///
/// Each lane has one end of the first two axes. The first of every four lanes has the bits of
/// [`Kernel::evaluate`](crate::contract::kernel::Kernel).
#[inline(always)]
pub(crate) fn by_corners<K: CellNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    p: [f32; N],
    seed: u32,
) -> LaneSample<S, N> {
    let (sample, variance) = at_ends_of::<K, S, N, GRADIENTS>(s, noise, p, seed).parts;
    if K::NORMALIZED { normalized::<S, N, GRADIENTS>(s, sample, variance) } else { sample }
}

/// The ends of the first and of the second axis by lane.
static FIRST_ENDS: [f32; LANES] =
    [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0];
static SECOND_ENDS: [f32; LANES] =
    [0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0];

/// The corners and parts of a point, with gradients if `GRADIENTS`. Axes are packed into one
/// register.
#[inline(always)]
pub(crate) fn at_ends_of<K: CellNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    p: [f32; N],
    seed: u32,
) -> Ends<S, N> {
    let mut axes = [0.0; LANES];
    axes[..N].copy_from_slice(&p);
    let (cells, positions) = cell(s, s.load(&axes));
    let all = Along::new(s, K::FADE, positions);
    let mut position = CellPosition { terms: [[s.word(0); 2]; N], along: [all; N] };
    for axis in 0..N {
        position.along[axis] = all.lane(s, axis).splat(s);
    }
    let (mut ends, mut words) = ([[0; 2]; N], [s.word(0); 4]);
    for axis in 0..N {
        let cell = Scalar.word(s.lane_word(cells, axis));
        let [low, high] = noise.lattice().terms(Scalar, axis, cell);
        ends[axis] = [low.0, high.0];
    }
    for k in 0..CORNERS[N] {
        let terms = at_ends(s, &ends, k);
        words[k] = if K::UPPER_BITS {
            noise.lattice().upper_words(s, terms, seed)
        } else {
            noise.lattice().words(s, terms, seed)
        };
    }
    let parts = parts_at_ends::<K, S, N, GRADIENTS>(s, noise, &position, &words);
    Ends {
        #[cfg(feature = "simd")]
        position,
        #[cfg(feature = "simd")]
        words,
        parts,
    }
}

/// n and v of the points of groups of four lanes, with their gradients; the first lane of each
/// group has the bits of [`Kernel::evaluate`](crate::contract::kernel::Kernel).
///
/// All lanes of a group have the same point and key.
#[inline(always)]
pub(crate) fn parts_of_groups<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    noise: &K,
    p: [S::F; N],
    seed: u32,
) -> (LaneSample<S, N>, LaneSample<S, N>) {
    let mut position = CellPosition::new(s, noise, &p, 0);
    for (axis, ends) in [&FIRST_ENDS, &SECOND_ENDS].into_iter().enumerate().take(N) {
        let is_low = s.less(s.load(ends), s.float(0.5));
        let [low, high] = position.terms[axis];
        position.terms[axis] = [s.select_word(is_low, low, high); 2];
    }
    let mut words = [s.word(0); 4];
    for k in 0..CORNERS[N] {
        words[k] = position.word(s, noise, [position.terms[0][0], position.terms[1 % N][0]], k, seed);
    }
    parts_at_ends::<K, S, N, true>(s, noise, &position, &words)
}

/// n, and v if the noise is normalized, from the words at the ends of the first two axes, with
/// gradients if `GRADIENTS`.
#[inline(always)]
fn parts_at_ends<K: CellNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    position: &CellPosition<S, N>,
    words: &[S::U; 4],
) -> (LaneSample<S, N>, LaneSample<S, N>) {
    let column = position.column(s, noise, words);

    let [first, second] = [&position.along[0], &position.along[1 % N]];
    let deltas = [first.position - s.load(&FIRST_ENDS), second.position - s.load(&SECOND_ENDS)];
    let unit = |x| if K::HAS_GRADIENT { x } else { x * s.float(K::UNIT) };
    let slope = |plane: &Plane<S>| {
        if K::HAS_GRADIENT { along_first(s, plane.slopes[1], first) } else { s.float(0.0) }
    };
    let line = |plane: &Plane<S>| Line {
        value: unit(along_first(s, height::<K, S, N>(plane, deltas[0]), first)),
        slope: slope(plane),
    };
    let edge = line(&column.plane);
    let [offset, value] = along_second::<K, S, N>(s, &edge, deltas[1], second);
    let mut gradient = [value; N];
    if GRADIENTS {
        let risen = |along: &Along<S>, low: S::F, high: S::F| along.slope * (high - low);
        let low = height::<K, S, N>(&column.plane, deltas[0]);
        let rise = risen(first, low, s.turned::<2>(low));
        let [a, c] = column.plane.slopes;
        let derivative = if K::HAS_GRADIENT {
            Line { value: along_first(s, a, first) + rise, slope: risen(first, c, s.turned::<2>(c)) }
        } else {
            Line { value: unit(rise), slope: s.float(0.0) }
        };
        let [ends, derived] = along_second::<K, S, N>(s, &derivative, deltas[1], second);
        let rise = risen(second, offset, s.turned::<1>(offset));
        (gradient[0], gradient[1 % N]) = (derived, rise);
        if K::HAS_GRADIENT {
            // Both in one register.
            let pairs = s.floats(|lane| {
                s.lane(if lane & 1 == 0 { ends } else { edge.slope }, lane & !3 | lane >> 1 & 1)
            });
            let both = lerp::<S>(pairs, s.turned::<2>(pairs), second.weight);
            (gradient[0], gradient[1 % N]) = (both, s.turned::<1>(both) + rise);
        }
        for axis in 2..N {
            let derivative = line(&column.derivatives[axis]);
            [_, gradient[axis]] = along_second::<K, S, N>(s, &derivative, deltas[1], second);
        }
    }
    let sample = (if K::CLAMPED { s.within_one(value) } else { value }, gradient);
    let variance =
        if K::NORMALIZED { position.variance(s).at::<GRADIENTS>(axis_variance(s, first)) } else { sample };
    (sample, variance)
}
