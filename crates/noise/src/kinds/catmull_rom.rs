//! Noises that interpolate random numbers at lattice points by products of Catmull–Rom splines.
//!
//! The 4ⁿ numbers around a point are first blended along all axes but the first. The resulting four
//! columns are constant along a row of a grid. A cubic interpolates between them.

use crate::{
    contract::kernel::Kernel,
    lanes::{LaneSample, Lanes, Scalar},
    lattice::lattice::{Lattice, OnLattice, cell},
    row::cells::end_of_cell,
    row::row::Strip,
};

/// A noise defined by its numbers at lattice points.
pub(crate) trait SplineNoise<const N: usize>: OnLattice {
    fn number<S: Lanes>(&self, s: S, word: S::U) -> S::F;
}

/// The weights of the four points around t.
#[inline(always)]
fn weights<S: Lanes>(s: S, t: S::F) -> [S::F; 4] {
    let half = s.float(0.5);
    let three_halves = s.float(1.5);
    [
        t * (t * (s.float(1.0) - half * t) - half),
        s.float(1.0) + t * t * (three_halves * t - s.float(2.5)),
        t * (t * (s.float(2.0) - three_halves * t) + half),
        t * t * (half * t - half),
    ]
}

/// The derivatives of the weights.
#[inline(always)]
fn slopes<S: Lanes>(s: S, t: S::F) -> [S::F; 4] {
    let half = s.float(0.5);
    let three_halves = s.float(1.5);
    let nine_halves = s.float(4.5);
    [
        t * (s.float(2.0) - three_halves * t) - half,
        t * (nine_halves * t - s.float(5.0)),
        t * (s.float(4.0) - nine_halves * t) + half,
        t * (three_halves * t - s.float(1.0)),
    ]
}

/// The cubic c₀ + c₁ t + c₂ t² + c₃ t³ through the inner two of four columns.
#[derive(Clone, Copy)]
struct Cubic<S: Lanes>([S::F; 4]);

impl<S: Lanes> Cubic<S> {
    #[inline(always)]
    fn new(s: S, [a, b, c, d]: [S::F; 4]) -> Self {
        let half = s.float(0.5);
        let (outer, inner) = (d - a, c - b);
        let c1 = half * (c - a);
        let c3 = half * outer - s.float(1.5) * inner;
        Self([b, c1, (inner - c1) - c3, c3])
    }

    #[inline(always)]
    fn value(&self, t: S::F) -> S::F {
        let [c0, c1, c2, c3] = self.0;
        c0 + t * (c1 + t * (c2 + t * c3))
    }

    #[inline(always)]
    fn derivative(&self, s: S, t: S::F) -> S::F {
        let [_, c1, c2, c3] = self.0;
        c1 + t * (s.float(2.0) * c2 + t * (s.float(3.0) * c3))
    }
}

/// The neighborhood of a point's cell along all axes but the first.
struct Section<S: Lanes, const N: usize> {
    terms: [[S::U; 4]; N],
    weight: [[S::F; 4]; N],
    slope: [[S::F; 4]; N],
}

/// The terms of a cell's four points along an axis, from the previous point on.
#[inline(always)]
fn terms<S: Lanes, L: Lattice>(s: S, lattice: &L, axis: usize, cell: S::U) -> [S::U; 4] {
    let mut terms = [cell; 4];
    for k in 0..4 {
        terms[k] = lattice.term(s, axis, cell + s.word((k as u32).wrapping_sub(1)));
    }
    terms
}

impl<S: Lanes, const N: usize> Section<S, N> {
    #[inline(always)]
    fn new<K: SplineNoise<N>>(s: S, noise: &K, p: &[S::F; N]) -> Self {
        let zero = [[s.float(0.0); 4]; N];
        let mut section = Self { terms: [[s.word(0); 4]; N], weight: zero, slope: zero };
        for axis in 1..N {
            let (cell, t) = cell(s, p[axis]);
            section.terms[axis] = terms(s, noise.lattice(), axis, cell);
            section.weight[axis] = weights(s, t);
            section.slope[axis] = slopes(s, t);
        }
        section
    }

    /// The blend of a column, and if `GRADIENTS` its derivative along axis i at index i > 0.
    #[inline(always)]
    fn column<K: SplineNoise<N>, const GRADIENTS: bool>(
        &self,
        s: S,
        noise: &K,
        term: S::U,
        seed: u32,
    ) -> [S::F; N] {
        let mut sums = [[s.float(0.0); N]; N];
        for k in 0..1_usize << (2 * (N - 1)) {
            let mut words = [term; N];
            for axis in 1..N {
                words[axis] = self.terms[axis][k >> (2 * (axis - 1)) & 3];
            }
            // The fourth addend completes a sum along an axis, which then is an addend of the sum
            // along the next axis.
            let mut part = [s.float(0.0); N];
            part[0] = noise.number(s, noise.lattice().words(s, words, seed));
            sums[0] = part;
            for axis in 1..N {
                let digit = k >> (2 * (axis - 1)) & 3;
                let (w, slope) = (self.weight[axis][digit], self.slope[axis][digit]);
                let mut sum = part;
                for i in 0..if GRADIENTS { axis } else { 1 } {
                    sum[i] = part[i] * w;
                }
                if GRADIENTS {
                    sum[axis] = part[0] * slope;
                }
                if digit > 0 {
                    for i in 0..if GRADIENTS { axis + 1 } else { 1 } {
                        sum[i] = sums[axis][i] + sum[i];
                    }
                }
                sums[axis] = sum;
                if digit < 3 {
                    break;
                }
                part = sum;
            }
        }
        sums[N - 1]
    }
}

/// The value of the noise at points, and its gradient if `GRADIENTS`.
#[inline(always)]
pub(crate) fn spline<K: SplineNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    p: [S::F; N],
    seed: u32,
) -> LaneSample<S, N> {
    let section = Section::new(s, noise, &p);
    let (cell, t) = cell(s, p[0]);
    let terms = terms(s, noise.lattice(), 0, cell);
    let mut columns = [[s.float(0.0); N]; 4];
    for k in 0..4 {
        columns[k] = section.column::<K, GRADIENTS>(s, noise, terms[k], seed);
    }
    let mut cubics = [Cubic([t; 4]); N];
    for axis in 0..if GRADIENTS { N } else { 1 } {
        let ends = [columns[0][axis], columns[1][axis], columns[2][axis], columns[3][axis]];
        cubics[axis] = Cubic::new(s, ends);
    }
    at::<S, N, GRADIENTS>(s, &cubics, t)
}

/// The value of the first cubic, and if `GRADIENTS` its slope and the values of the others.
#[inline(always)]
fn at<S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    cubics: &[Cubic<S>; N],
    t: S::F,
) -> LaneSample<S, N> {
    let mut gradient = [t; N];
    if GRADIENTS {
        gradient[0] = cubics[0].derivative(s, t);
        for axis in 1..N {
            gradient[axis] = cubics[axis].value(t);
        }
    }
    (cubics[0].value(t), gradient)
}

/// The step from which on a cell has too few points for columns to pay off.
pub(crate) const LONG_STEP: f32 = 0.95;
/// The number of columns that are computed at once along a row.
const COLUMNS: usize = 64;
/// Space behind the columns for a vector that begins at one of them.
const SPARE: usize = 20;

type Numbers = [f32; COLUMNS + SPARE];

/// The values along a row, and the gradients if `GRADIENTS`.
#[inline(always)]
pub(crate) fn spline_rows<K: SplineNoise<N> + Kernel<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    mut strip: Strip<'_, N, GRADIENTS>,
) -> usize {
    let (row, seed, count) = (strip.row, strip.seed, strip.values.len());
    let mut i = 0;
    let section = Section::<Scalar, N>::new(Scalar, noise, &row.origin());
    let (inverse, descending) = (1.0 / row.stride(), row.stride() < 0.0);
    let mut cubics = [[[0.0; COLUMNS + SPARE]; 4]; N];
    while i < count {
        let first = Scalar.floor(row.x(i)) as i32;
        let crossed = (row.stride() * (count - i) as f32).abs() as usize + 2;
        let cells = crossed.min(COLUMNS - 3);
        let leftmost = if descending { first.wrapping_sub(cells as i32 - 1) } else { first };
        fill::<K, S, N, GRADIENTS>(s, noise, &section, leftmost, cells, seed, &mut cubics);
        for j in 0..cells {
            let k = if descending { cells - 1 - j } else { j };
            let floor = leftmost.wrapping_add(k as i32) as f32;
            let end = end_of_cell(&row, floor, inverse, i, count);
            let mut here = [Cubic([s.float(0.0); 4]); N];
            for axis in 0..if GRADIENTS { N } else { 1 } {
                for c in 0..4 {
                    here[axis].0[c] = s.float(cubics[axis][c][k]);
                }
            }
            while i < end {
                let t = row.xs(s, i) - s.float(floor);
                strip.put(s, at::<S, N, GRADIENTS>(s, &here, t), i);
                i += S::LEN;
            }
            i = end;
        }
    }
    count
}

/// Computes the cubics of consecutive cells of a row, from `leftmost` on.
#[inline(always)]
fn fill<K: SplineNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    section: &Section<Scalar, N>,
    leftmost: i32,
    cells: usize,
    seed: u32,
    cubics: &mut [[Numbers; 4]; N],
) {
    let zero = [[s.float(0.0); 4]; N];
    let mut wide = Section { terms: [[s.word(0); 4]; N], weight: zero, slope: zero };
    for axis in 1..N {
        for k in 0..4 {
            wide.terms[axis][k] = s.word(section.terms[axis][k].0);
            wide.weight[axis][k] = s.float(section.weight[axis][k]);
            wide.slope[axis][k] = s.float(section.slope[axis][k]);
        }
    }
    let mut columns = [[0.0; COLUMNS + SPARE]; N];
    let mut i = 0;
    while i < cells + 3 {
        let cell = s.word(leftmost.wrapping_add(i as i32 - 1) as u32) + s.iota();
        let column = wide.column::<K, GRADIENTS>(s, noise, noise.lattice().term(s, 0, cell), seed);
        for axis in 0..if GRADIENTS { N } else { 1 } {
            s.store(column[axis], &mut columns[axis][i..]);
        }
        i += S::LEN;
    }
    for axis in 0..if GRADIENTS { N } else { 1 } {
        let columns = &columns[axis];
        let mut i = 0;
        while i < cells {
            let ends = [
                s.load(&columns[i..]),
                s.load(&columns[i + 1..]),
                s.load(&columns[i + 2..]),
                s.load(&columns[i + 3..]),
            ];
            let Cubic(coefficients) = Cubic::new(s, ends);
            for c in 0..4 {
                s.store(coefficients[c], &mut cubics[axis][c][i..]);
            }
            i += S::LEN;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    /// Catmull and Rom's matrix, by rows of the powers of t.
    const MATRIX: [[f32; 4]; 4] =
        [[0.0, 1.0, 0.0, 0.0], [-0.5, 0.0, 0.5, 0.0], [1.0, -2.5, 2.0, -0.5], [-0.5, 1.5, -1.5, 0.5]];

    #[test]
    fn catmull_rom_weights_and_cubics_match_matrix() {
        for i in 0..=16_u8 {
            let t = f32::from(i) / 16.0;
            let (w, slope) = (weights(Scalar, t), slopes(Scalar, t));
            for k in 0..4 {
                let [c0, c1, c2, c3] = MATRIX.map(|row| row[k]);
                let mut column = [0.0; 4];
                column[k] = 1.0;
                let cubic = Cubic::new(Scalar, column);
                // Two roundings of numbers below 3, the largest sum of a derivative's terms.
                let (value, derivative) =
                    (c0 + t * (c1 + t * (c2 + t * c3)), c1 + t * (2.0 * c2 + t * 3.0 * c3));
                for got in [w[k], cubic.value(t)] {
                    assert_abs_diff_eq!(got, value, epsilon = 4e-7);
                }
                for got in [slope[k], cubic.derivative(Scalar, t)] {
                    assert_abs_diff_eq!(got, derivative, epsilon = 4e-7);
                }
            }
        }
    }
}
