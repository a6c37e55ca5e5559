//! One point of simplex noise by lanes, a corner in each; the bits of the lone lane's.

use crate::{
    contract::hessian::{Jet, mirror},
    kinds::cell::blend::splat,
    kinds::simplex::geometry::{SKEW, Term, UNSKEW, beyond_gap, kernel, pull},
    kinds::simplex::simplex::Simplex,
    lanes::{Arithmetic, Floats, LANES, LaneSample, Lanes, Scalar},
    lattice::lattice::{Lattice, OnLattice},
};

/// The terms of the corners around a point.
pub(crate) struct Around<S: Lanes, const N: usize> {
    /// A corner in each lane. In the plane they are those of the skewed square, of which one adds 0.
    four: Term<S, N>,
    /// In 4-D the last corner.
    fifth: Option<Fifth<S>>,
}

/// The term of a corner whose axes have a lane each.
struct Fifth<S: Lanes> {
    t: f32,
    slope: f32,
    d: S::F,
    g: S::F,
}

/// The terms of the corners around a point, of which each has a lane.
#[inline(always)]
pub(crate) fn around<S: Lanes, L: Lattice, const N: usize>(
    s: S,
    noise: &Simplex<L>,
    p: [f32; N],
    seed: u32,
) -> Around<S, N> {
    let mut axes = [0.0; LANES];
    axes[..N].copy_from_slice(&p);
    // The first coordinate comes last, as in `first_corner`.
    let shift = (0..N - 1).rev().fold(p[N - 1], |sum, axis| sum + p[axis]) * SKEW[N - 1];
    let place = s.load(&axes);
    let (cells, _) = s.cell(place + s.float(shift));
    if N == 2 {
        return Around { four: square(s, noise, p, cells, seed), fifth: None };
    }
    let (first, ends) = (s.real(cells), noise.lattice().terms_of_axes::<S, N>(s, cells));
    let points = splat(s, p);
    let ranks = negative_ranks::<S, N>(s, place - first);
    // The axes of corner k are those of ranks from N − k on.
    let limit = s.iota() - s.word(N as u32 - 1);
    let (mut words, mut skewed, mut corner) = ([s.word(0); N], points, [0.0; N]);
    for axis in 0..N {
        let ahead = s.signed_less(s.word(s.lane_word(ranks, axis)), limit);
        let [low, high] = ends[axis];
        corner[axis] = s.lane(first, axis);
        words[axis] = s.select_word(ahead, s.word(high), s.word(low));
        skewed[axis] = s.float(corner[axis]) + s.keep(ahead, s.float(1.0));
    }
    let least = corner[1..].iter().fold(corner[0], |sum, &x| sum + x);
    let word = noise.lattice().upper_words(s, words, seed);
    let four = noise.term::<_, N, true>(s, &points, skewed, s.float(least) + s.real(s.iota()), word);
    if N < 4 {
        return Around { four, fifth: None };
    }
    let word = noise.lattice().upper_words(Scalar, ends.map(|[_, high]| Scalar.word(high)), seed);
    let back = (least + 4.0) * UNSKEW[N - 1];
    let d = place - (first + s.float(1.0) - s.float(back));
    let g = noise.direction_by_axes(s, word.0);
    let (squares, parts) = (d * d, g * d);
    let (mut t, mut slope) = (noise.radius_squared() - s.lane(squares, 1), s.lane(parts, 1));
    for axis in 2..N {
        t -= s.lane(squares, axis);
        slope += s.lane(parts, axis);
    }
    let t = beyond_gap(Scalar, t - s.lane(squares, 0));
    Around { four, fifth: Some(Fifth { t, slope: slope + s.lane(parts, 0), d, g }) }
}

/// The terms of the corners of a skewed square, those of the lower end of the first axis first; t is 0 at the one that lies beyond the
/// diagonal.
#[inline(always)]
fn square<S: Lanes, L: Lattice, const N: usize>(
    s: S,
    noise: &Simplex<L>,
    p: [f32; N],
    cells: S::U,
    seed: u32,
) -> Term<S, N> {
    let (first, word) = (s.real(cells), noise.lattice().upper_words_of_cell::<S, N>(s, cells, seed)[0]);
    let [x, y] = [s.lane(first, 0), s.lane(first, 1)];
    let mut skewed = [s.float(x) + s.floats(|lane| (lane >> 1 & 1) as f32); N];
    skewed[1 % N] = s.float(y) + s.floats(|lane| (lane & 1) as f32);
    let sum = s.float(x + y) + s.floats(|lane| ((lane >> 1 & 1) + (lane & 1)) as f32);
    let term = noise.term::<_, N, true>(s, &splat(s, p), skewed, sum, word);
    // Negative where the step along the first axis comes first.
    let ahead = (p[1 % N] - y) - (p[0] - x);
    let sign = |on: [u32; 4]| s.words(|lane| on[lane & 3] << 31);
    let beyond = (s.bits(s.float(ahead)) ^ sign([0, 0, 1, 0])) & sign([0, 1, 1, 0]);
    Term { t: s.drop(s.signed_less(beyond, s.word(0)), term.t), ..term }
}

/// Than how many axes the point is farther along each axis in the skewed cell, times −1; one axis in each lane.
#[inline(always)]
fn negative_ranks<S: Lanes, const N: usize>(s: S, low: S::F) -> S::U {
    let of = |axes: [usize; 4]| s.floats(|lane| s.lane(low, axes[lane & 3]));
    let not = |lanes: [u32; 4]| s.words(|lane| 0_u32.wrapping_sub(lanes[lane & 3]));
    let less = |a, b| s.select_word(s.less(of(a), of(b)), s.word(u32::MAX), s.word(0));
    let turned = |x, by: [usize; 4]| s.words(|lane| s.lane_word(x, by[lane & 3]));
    if N == 3 {
        let ahead = less([1, 2, 2, 2], [0, 1, 0, 0]);
        return (ahead ^ not([0, 0, 1, 1])) + (turned(ahead, [2, 0, 1, 1]) ^ not([0, 1, 1, 1]));
    }
    let (next, third) = (less([1, 2, 3, 3], [0, 1, 2, 0]), less([2, 3, 2, 3], [0, 1, 0, 1]));
    let last = turned(next, [3, 0, 1, 2]) ^ not([0, 1, 1, 1]);
    (next ^ not([0, 0, 0, 1])) + (third ^ not([0, 0, 1, 1])) + last
}

/// Lane k of four registers side by side.
#[inline(always)]
fn lanes_of<S: Lanes>(s: S, parts: &[S::F; 4], k: usize) -> S::F {
    s.floats(|lane| s.lane(parts[lane & 3], k))
}

impl<S: Lanes, const N: usize> Around<S, N> {
    /// The value, and the gradient if `GRADIENTS`.
    #[inline(always)]
    pub(crate) fn sum<const GRADIENTS: bool>(&self, s: S) -> LaneSample<Scalar, N> {
        let Term { t, d, g, slope } = &self.four;
        let t4 = kernel(*t);
        let parts = t4 * *slope;
        let total = || (0..4).fold(0.0, |value, k| value + s.lane(parts, k));
        let (mut value, mut gradient) = (0.0, [0.0; N]);
        if GRADIENTS {
            let pull = pull(s, *t, *slope);
            let mut slopes = [parts; 4];
            for axis in 0..N {
                slopes[axis] = g[axis] * t4 - d[axis] * pull;
            }
            // A sum in each lane, in the last one that of values where there is room.
            let sums = (0..4).fold(s.float(0.0), |sums, k| sums + lanes_of(s, &slopes, k));
            for axis in 0..N {
                gradient[axis] = s.lane(sums, axis);
            }
            value = s.lane(sums, 3);
        }
        if !GRADIENTS || N == 4 {
            value = total();
        }
        if let Some(Fifth { t, slope, d, g }) = &self.fifth {
            let t4 = kernel(*t);
            value += t4 * *slope;
            if GRADIENTS {
                let parts = *g * s.float(t4) - *d * s.float(pull(Scalar, *t, *slope));
                for axis in 0..N {
                    gradient[axis] += s.lane(parts, axis);
                }
            }
        }
        (Scalar.within_one(value), gradient)
    }

    /// Value, gradient and Hessian.
    #[inline(always)]
    pub(crate) fn jet(&self, s: S) -> Jet<N> {
        let (value, gradient) = self.sum::<true>(s);
        // Four entries of the upper half side by side, row after row, and what is taken from those on the diagonal.
        let (mut entries, mut pulls) = ([[s.float(0.0); 4]; 3], [[s.float(0.0); 4]; 3]);
        let Term { t, d, g, slope } = &self.four;
        let bends = Bends::new(s, *t, *slope);
        let mut e = 0;
        for i in 0..N {
            for j in i..N {
                entries[e / 4][e % 4] = bends.entry([d[i], d[j]], [g[i], g[j]]);
                if i == j {
                    pulls[e / 4][e % 4] = bends.pull;
                }
                e += 1;
            }
        }
        let sums = [0, 1, 2].map(|q| {
            let zero = s.float(0.0);
            (0..4).fold(zero, |sums, k| sums + lanes_of(s, &entries[q], k) - lanes_of(s, &pulls[q], k))
        });
        let (mut hessian, mut e) = ([[0.0; N]; N], 0);
        let fifth = self.fifth.as_ref().map(|fifth| (fifth, Bends::new(Scalar, fifth.t, fifth.slope)));
        for i in 0..N {
            for j in i..N {
                hessian[i][j] = s.lane(sums[e / 4], e % 4);
                if let Some((Fifth { d, g, .. }, bends)) = &fifth {
                    let both = |x| [s.lane(x, i), s.lane(x, j)];
                    hessian[i][j] += bends.entry(both(*d), both(*g));
                    if i == j {
                        hessian[i][j] -= bends.pull;
                    }
                }
                e += 1;
            }
        }
        mirror(&mut hessian);
        Jet { value, gradient, hessian }
    }
}

/// The factors of a corner's second derivatives.
struct Bends<F> {
    /// 48 t² (g·d).
    bend: F,
    /// 8 t³.
    twist: F,
    /// 8 t³ (g·d).
    pull: F,
}

impl<F: Floats> Bends<F> {
    #[inline(always)]
    fn new<S: Lanes<F = F>>(s: S, t: F, slope: F) -> Self {
        let t2 = t * t;
        let twist = s.float(8.0) * (t2 * t);
        Self { bend: s.float(48.0) * t2 * slope, twist, pull: twist * slope }
    }

    /// An entry but for what is taken from the diagonal.
    #[inline(always)]
    fn entry(&self, [di, dj]: [F; 2], [gi, gj]: [F; 2]) -> F {
        self.bend * (di * dj) - self.twist * (di * gj + dj * gi)
    }
}
