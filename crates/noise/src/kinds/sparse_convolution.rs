//! Sparse convolution noise: randomly placed impulses, convolved with a radial kernel.

use crate::{
    contract::compiled::on_lattice,
    contract::kernel::{Kernel, Measured},
    contract::noise::{kind, noise, tiles},
    error::NoiseError,
    lanes::{LaneSample, Lanes, splat},
    lattice::integer_hash::{IntegerHash, further},
    lattice::lattice::{Lattice, cell},
    lattice::variates::uniform,
    row::cells::{end_of_cell, has_columns},
    row::row::{Row, Strip},
    statistics::statistics::Statistics,
    statistics::tables,
};

/// A sum of radial kernels around impulses of random weight, K per cell at random positions; C².
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/sparse.md"))]
///
/// ```text
/// n(p) = A Σ_k w_k h(|p − x_k|),   h(r) = (1 − r²)³ for r < 1, else 0,   A = √(3/(K ∫h²))
/// ∫h² = 0.682, π/7, 0.2857, π²/56 in 1 to 4 dimensions
/// ```
///
/// In 1 to 4 dimensions. Positions are uniform in the cell and weights uniform in (−1, 1). Only the
/// number of impulses is aligned to the lattice. The noise has no preferred direction, and no point
/// is always flat or 0. An evaluation visits the 3ⁿ cells around the point.
///
/// - **Moments:** mean 0 and variance 1 at every point, as weights are independent of each other
///   and of positions.
/// - **Range:** |n| ≤ 2ⁿ K A. The bound is the supremum, reached if all impulses around a lattice
///   point coincide there. Values beyond 5 are rare.
/// - **Resolution of positions:** 2⁻¹⁶.
///
/// Lewis 1989, "Algorithms for Solid Noise Synthesis". Unlike there the number of impulses per cell
/// is fixed instead of Poisson-distributed, which avoids empty regions.
///
/// ```
/// use asperity_noise::{Field, SparseConvolution, glam::Vec3};
///
/// let mean_square = (0..4000).map(|seed| SparseConvolution::new(seed).value(Vec3::splat(0.3)).powi(2)).sum::<f32>() / 4000.0;
/// assert!((mean_square - 1.0).abs() < 0.1);
/// assert!(SparseConvolution::new(1).with_impulses(0).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SparseConvolution<L = IntegerHash> {
    seed: u32,
    impulses: u8,
    lattice: L,
}

impl SparseConvolution {
    /// The maximum number of impulses per cell.
    pub const MAX_IMPULSES: u32 = 4;
}

kind!(SparseConvolution { impulses: 1 }, "of one impulse per cell");
noise!(SparseConvolution);
tiles!(SparseConvolution);

impl<L> SparseConvolution<L> {
    /// Sets the number of impulses per cell; more are slower and closer to Gaussian.
    ///
    /// # Errors
    ///
    /// If the number is not in 1..=[`MAX_IMPULSES`](SparseConvolution::MAX_IMPULSES).
    pub fn with_impulses(self, impulses: u32) -> Result<Self, NoiseError> {
        if (1..=SparseConvolution::MAX_IMPULSES).contains(&impulses) {
            Ok(Self { impulses: impulses as u8, ..self })
        } else {
            let (parameter, max) = ("impulses", SparseConvolution::MAX_IMPULSES);
            Err(NoiseError::Count { parameter, value: impulses, min: 1, max })
        }
    }

    /// Returns K, the number of impulses per cell.
    #[must_use]
    pub const fn impulses(&self) -> u32 {
        self.impulses as u32
    }
}

/// √(3/(K ∫h²)) by dimension and number of impulses.
const AMPLITUDE: [[f32; 4]; 4] = [
    [2.097_361_6, 1.483_058_6, 1.210_912_3, 1.048_680_8],
    [2.585_441_5, 1.828_183_2, 1.492_705_3, 1.292_720_8],
    [3.240_626_8, 2.291_469, 1.870_976_7, 1.620_313_4],
    [4.125_767_7, 2.917_358_3, 2.382_013, 2.062_883_8],
];

/// The number of cells in the neighborhood of a cell along all axes but the first.
const SECTION: [usize; 5] = [1, 1, 3, 9, 27];
/// 3^(axis − 1).
const POWERS: [usize; 4] = [1, 1, 3, 9];

/// The neighborhood of a point's cell along all axes but the first.
struct Section<S: Lanes, const N: usize> {
    /// The terms of the previous cell, the cell and the next cell along each axis.
    terms: [[S::U; 3]; N],
    position: [S::F; N],
}

/// The terms of a cell and its neighbors along an axis.
#[inline(always)]
fn terms<S: Lanes, L: Lattice>(s: S, lattice: &L, axis: usize, cell: S::U) -> [S::U; 3] {
    let mut terms = [cell; 3];
    for k in 0..3 {
        terms[k] = lattice.term(s, axis, cell + s.word((k as u32).wrapping_sub(1)));
    }
    terms
}

/// An impulse relative to points.
///
/// Its position along the first axis in its own cell, the offsets to it along the other axes, the
/// sum of their squares, and its weight times A.
struct Impulse<S: Lanes, const N: usize> {
    x: S::F,
    d: [S::F; N],
    rest: S::F,
    weight: S::F,
}

impl<S: Lanes, const N: usize> Section<S, N> {
    #[inline(always)]
    fn new<L: Lattice>(s: S, lattice: &L, p: &[S::F; N]) -> Self {
        let mut section = Self { terms: [[s.word(0); 3]; N], position: [s.float(0.0); N] };
        for axis in 1..N {
            let (cell, t) = cell(s, p[axis]);
            section.terms[axis] = terms(s, lattice, axis, cell);
            section.position[axis] = t;
        }
        section
    }

    /// The word of cell j of the section.
    #[inline(always)]
    fn word<L: Lattice>(&self, s: S, lattice: &L, term: S::U, j: usize, seed: u32) -> S::U {
        let mut words = [term; N];
        for axis in 1..N {
            words[axis] = self.terms[axis][j / POWERS[axis] % 3];
        }
        lattice.words(s, words, seed)
    }

    /// The impulse of a word of cell j.
    #[inline(always)]
    fn impulse(&self, s: S, word: S::U, j: usize, amplitude: f32) -> Impulse<S, N> {
        let low = s.word(0xffff);
        let second = further::<S, 1>(s, word);
        let fields = [s.shr::<16>(word), word & low, s.shr::<16>(second), second & low];
        let mut position = [s.float(0.0); N];
        for axis in 0..N {
            position[axis] = (s.real(fields[axis]) + s.float(0.5)) * s.float(1.0 / 65_536.0);
        }
        let weight = match N {
            1 | 2 => uniform(s, second),
            _ => uniform(s, further::<S, 2>(s, word)),
        };
        let (mut d, mut rest) = (position, s.float(0.0));
        for axis in 1..N {
            let offset = (j / POWERS[axis] % 3) as f32 - 1.0;
            d[axis] = self.position[axis] - (s.float(offset) + position[axis]);
            let square = d[axis] * d[axis];
            rest = if axis == 1 { square } else { rest + square };
        }
        Impulse { x: position[0], d, rest, weight: weight * s.float(amplitude) }
    }
}

/// Adds the contribution of an impulse, given its offset along the first axis.
#[inline(always)]
fn add<S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    (value, gradient): &mut LaneSample<S, N>,
    impulse: &Impulse<S, N>,
    x: S::F,
) {
    let t = s.above(s.float(1.0) - (impulse.rest + x * x), 0.0);
    let pull = impulse.weight * (t * t);
    *value = *value + pull * t;
    if GRADIENTS {
        let pull = s.float(-6.0) * pull;
        gradient[0] = gradient[0] + pull * x;
        for axis in 1..N {
            gradient[axis] = gradient[axis] + pull * impulse.d[axis];
        }
    }
}

impl<L: Lattice> SparseConvolution<L> {
    #[inline(always)]
    fn amplitude<const N: usize>(&self) -> f32 {
        AMPLITUDE[N - 1][usize::from(self.impulses - 1) & 3]
    }
}

/// The step from which on a cell has too few points for columns to pay off.
const LONG_STEP: f32 = 0.95;
/// The number of columns that are computed at once along a row.
const COLUMNS: usize = 16;
/// The maximum number of impulses of a column that rows store; with more, points are computed one
/// by one.
const KEPT: usize = 36;

type Numbers = [[f32; COLUMNS]; KEPT];

/// The impulses of the columns that an interval of a row crosses.
struct Columns<const N: usize> {
    x: Numbers,
    rest: Numbers,
    weight: Numbers,
    d: [Numbers; N],
}

impl<const N: usize> Columns<N> {
    const EMPTY: Self = Self {
        x: [[0.0; COLUMNS]; KEPT],
        rest: [[0.0; COLUMNS]; KEPT],
        weight: [[0.0; COLUMNS]; KEPT],
        d: [[[0.0; COLUMNS]; KEPT]; N],
    };

    /// Computes the impulses of `count` columns from the cell `leftmost` on.
    #[inline(always)]
    fn fill<L: Lattice, S: Lanes>(
        &mut self,
        s: S,
        noise: &SparseConvolution<L>,
        section: &Section<S, N>,
        leftmost: i32,
        count: usize,
        seed: u32,
    ) {
        let mut i = 0;
        while i < count {
            let cells = s.word(leftmost.wrapping_add(i as i32) as u32) + s.iota();
            let term = noise.lattice.term(s, 0, cells);
            let mut kept = 0;
            for j in 0..SECTION[N] {
                let mut word = section.word(s, &noise.lattice, term, j, seed);
                for _ in 0..noise.impulses {
                    let impulse = section.impulse(s, word, j, noise.amplitude::<N>());
                    s.store(impulse.x, &mut self.x[kept % KEPT][i..]);
                    s.store(impulse.rest, &mut self.rest[kept % KEPT][i..]);
                    s.store(impulse.weight, &mut self.weight[kept % KEPT][i..]);
                    for axis in 1..N {
                        s.store(impulse.d[axis], &mut self.d[axis][kept % KEPT][i..]);
                    }
                    word = further::<S, 3>(s, word);
                    kept += 1;
                }
            }
            i += S::LEN;
        }
    }

    /// Collects the impulses that points of cell k can see, in the order of the sum, and returns
    /// their number.
    #[inline(always)]
    fn seen(&self, count: usize, k: usize, seen: &mut [[f32; 6]; 3 * KEPT]) -> usize {
        let mut n = 0;
        for i in 0..3 {
            let column = (k + i) % COLUMNS;
            for j in 0..count.min(KEPT) {
                // Other impulses add only ±0 to the sum.
                if self.rest[j][column] < 1.0 {
                    let impulse = &mut seen[n];
                    impulse[0] = (i as f32 - 1.0) + self.x[j][column];
                    impulse[1] = self.rest[j][column];
                    impulse[2] = self.weight[j][column];
                    for axis in 1..N {
                        impulse[2 + axis] = self.d[axis][j][column];
                    }
                    n += 1;
                }
            }
        }
        n
    }
}

impl<L: Lattice, const N: usize> Kernel<N> for SparseConvolution<L> {
    type RowScratch = ();

    on_lattice!();

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let section = Section::new(s, &self.lattice, &p);
        let (cell, t) = cell(s, p[0]);
        let terms = terms(s, &self.lattice, 0, cell);
        let mut sum = (s.float(0.0), [s.float(0.0); N]);
        for i in 0..3 {
            for j in 0..SECTION[N] {
                let mut word = section.word(s, &self.lattice, terms[i], j, seed);
                for _ in 0..self.impulses {
                    let impulse = section.impulse(s, word, j, self.amplitude::<N>());
                    let x = t - (s.float(i as f32 - 1.0) + impulse.x);
                    add::<S, N, GRADIENTS>(s, &mut sum, &impulse, x);
                    word = further::<S, 3>(s, word);
                }
            }
        }
        sum
    }

    /// In eight lanes rows are 1.6 times as fast as lists; in sixteen lanes they are slower.
    #[inline(always)]
    fn reuses(&self, row: &Row<N>, count: usize, wide: bool) -> bool {
        !wide && SECTION[N] * usize::from(self.impulses) <= KEPT && has_columns(row, count, LONG_STEP)
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        _: &mut (),
        mut strip: Strip<'_, N, GRADIENTS>,
    ) -> usize {
        let (row, seed, count) = (strip.row, strip.seed, strip.values.len());
        let kept = SECTION[N] * usize::from(self.impulses);
        let mut i = 0;
        let section = Section::<S, N>::new(s, &self.lattice, &splat(s, row.origin()));
        let (inverse, descending) = (1.0 / row.stride(), row.stride() < 0.0);
        let mut columns = Columns::<N>::EMPTY;
        let mut seen = [[0.0; 6]; 3 * KEPT];
        while i < count {
            let first = s.lane_word(s.integer(s.floor(row.xs(s, i))), 0) as i32;
            let crossed = (row.stride() * (count - i) as f32).abs() as usize + 2;
            let cells = crossed.min(COLUMNS - 2);
            let leftmost = if descending { first.wrapping_sub(cells as i32 - 1) } else { first };
            columns.fill(s, self, &section, leftmost.wrapping_sub(1), cells + 2, seed);
            for j in 0..cells {
                let k = if descending { cells - 1 - j } else { j };
                let floor = leftmost.wrapping_add(k as i32) as f32;
                let end = end_of_cell(&row, floor, inverse, i, count);
                if i == end {
                    continue;
                }
                let n = columns.seen(kept, k, &mut seen);
                while i < end {
                    let t = row.xs(s, i) - s.float(floor);
                    let mut sum = (s.float(0.0), [s.float(0.0); N]);
                    for seen in &seen[..n] {
                        let mut d = [t; N];
                        for axis in 1..N {
                            d[axis] = s.float(seen[2 + axis]);
                        }
                        let impulse = Impulse { x: t, d, rest: s.float(seen[1]), weight: s.float(seen[2]) };
                        add::<S, N, GRADIENTS>(s, &mut sum, &impulse, t - s.float(seen[0]));
                    }
                    strip.put(s, sum, i);
                    i += S::LEN;
                }
                i = end;
            }
        }
        count
    }
}

impl<L, const N: usize> Measured<N> for SparseConvolution<L> {
    fn seed(&self) -> u32 {
        self.seed
    }

    fn statistics(&self) -> &'static Statistics {
        let tables = [&tables::SPARSE_1, &tables::SPARSE_2, &tables::SPARSE_3, &tables::SPARSE_4];
        &tables[usize::from(self.impulses - 1) & 3][N - 1]
    }
}
