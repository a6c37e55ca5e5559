//! Rows of simplex noise: every corner near the row adds its kernel to all points that it reaches, or every point takes the corners of
//! its simplex where a kernel reaches too few registers of points.
//!
//! Corners are taken by the sum of their skewed coordinates. The corners of a simplex have sums that follow one another, in the
//! order in which a single point adds them up, so that a row's sums have the bits of the points'.

use asperity_core::math;

use crate::{
    contract::kernel::{Kernel, by_lanes},
    kinds::simplex::geometry::{GAP, UNSKEW, along, beside, kernel, pull},
    kinds::simplex::simplex::Simplex,
    lanes::{LANES, Lanes},
    lattice::lattice::{Lattice, OnLattice},
    row::cells::{Numbers, POINTS, ZEROS, has_columns},
    row::row::{Row, RowKey, Strip},
};

/// Steps from here on leave too few points in a kernel.
const LONG_STEP: f32 = 0.22;
/// Points whose coordinates add up to more may be moved across the gap of a kernel by rounding: corners are rounded by up to 2⁻²² of it.
const REACH: f32 = 1024.0;
/// √(n + 1), the steps of the sum per unit length.
const SUMS: [f32; 4] = [core::f32::consts::SQRT_2, 1.732_050_8, 2.0, 2.236_068];

/// Whether a corner's kernel reaches so many registers of points that it is taken to them, not they to their corners.
#[inline(always)]
const fn pays<S: Lanes, const N: usize, const GRADIENTS: bool>() -> bool {
    N > 1 && (S::LEN <= 4 || (S::LEN == 8 && N == 2 && !GRADIENTS))
}

/// Whether all corners, and all points by their index, are placed well enough.
#[inline(always)]
fn is_near<const N: usize>(row: &Row<N>, count: usize) -> bool {
    if row.index(count) >= 1 << 22 {
        return false;
    }
    let mut reach = row.x(0).abs().max(row.x(count).abs());
    for axis in 1..N {
        reach += row.origin()[axis].abs();
    }
    reach < REACH
}

#[inline(always)]
fn copy(from: &Numbers, to: &mut [f32]) {
    for (to, from) in to.iter_mut().zip(from.as_flattened()) {
        *to = *from;
    }
}

/// The first coordinates of a row's points, and room for the sums there.
#[derive(Clone)]
pub struct Sums<const N: usize> {
    /// The row that the coordinates are of.
    key: Option<(RowKey, usize)>,
    x: Numbers,
    values: Numbers,
    gradients: [Numbers; N],
    corners: Corners<N>,
}

impl<const N: usize> Default for Sums<N> {
    /// Not a constant, because a constant would be copied, which takes longer than zeros.
    #[inline(always)]
    fn default() -> Self {
        Self { key: None, x: ZEROS, values: ZEROS, gradients: [ZEROS; N], corners: Corners::empty() }
    }
}

impl<const N: usize> Sums<N> {
    /// Values along a row, and gradients if `GRADIENTS`.
    #[inline(always)]
    pub(crate) fn rows<L: Lattice, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        noise: &Simplex<L>,
        mut strip: Strip<'_, N, GRADIENTS>,
    ) {
        let (row, count) = (&strip.row, strip.values.len());
        let splats = pays::<S, N, GRADIENTS>();
        if splats && !(noise.is_continuous() && has_columns(row, count, LONG_STEP) && is_near(row, count)) {
            by_lanes(s, noise, strip);
            return;
        }
        for start in (0..count).step_by(POINTS) {
            let part = strip.part(start..count.min(start + POINTS));
            self.place(s, &part.row, part.values.len());
            if splats {
                splat::<L, S, N, GRADIENTS>(s, noise, &part.row, part.seed, self, part.values.len());
            } else {
                self.by_points::<L, S, GRADIENTS>(s, noise, &part.row, part.seed, part.values.len());
            }
            if splats {
                self.clamp(s, part.values.len());
            }
            copy(&self.values, part.values);
            for axis in 0..if GRADIENTS { N } else { 0 } {
                copy(&self.gradients[axis], part.gradients[axis]);
            }
        }
    }

    /// Every point from the corners of its simplex, as many points at once as there are lanes.
    #[inline(always)]
    fn by_points<L: Lattice, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        noise: &Simplex<L>,
        row: &Row<N>,
        seed: u32,
        count: usize,
    ) {
        let mut p = row.points(s, 0);
        for b in 0..count.div_ceil(LANES).min(POINTS / LANES) {
            for k in (0..LANES).step_by(S::LEN) {
                p[0] = s.load(&self.x[b][k..]);
                let (value, gradient) = noise.evaluate::<S, GRADIENTS>(s, p, seed);
                s.store(value, &mut self.values[b][k..]);
                for axis in 0..if GRADIENTS { N } else { 0 } {
                    s.store(gradient[axis], &mut self.gradients[axis][b][k..]);
                }
            }
        }
    }

    /// Clamps the first `points` sums, as [`Simplex`] does at a point.
    #[inline(always)]
    fn clamp<S: Lanes>(&mut self, s: S, points: usize) {
        for values in self.values.as_flattened_mut().chunks_exact_mut(S::LEN).take(points.div_ceil(S::LEN)) {
            s.store(s.within_one(s.load(values)), values);
        }
    }

    /// The first coordinates of the first `points` points of a row.
    #[inline(always)]
    fn place<S: Lanes>(&mut self, s: S, row: &Row<N>, points: usize) {
        let key = Some((row.key(), points));
        if self.key != key {
            self.key = key;
            for i in (0..points).step_by(S::LEN) {
                s.store(row.xs(s, i), &mut self.x.as_flattened_mut()[i..]);
            }
        }
    }
}

/// One number per corner.
type OfCorners = [[f32; LANES]; 8];

const NONE: OfCorners = [[0.0; LANES]; 8];

/// Corners of as many sums as there are lanes, as the row sees them.
#[derive(Clone)]
struct Corners<const N: usize> {
    x: OfCorners,
    rest: OfCorners,
    side: OfCorners,
    /// The first point that a kernel may reach and the one after the last, as the bits of integers; none if they are the same.
    ends: [OfCorners; 2],
    g: [OfCorners; N],
    d: [OfCorners; N],
}

#[inline(always)]
fn splat<L: Lattice, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &Simplex<L>,
    row: &Row<N>,
    seed: u32,
    sums: &mut Sums<N>,
    count: usize,
) {
    let blocks = count.div_ceil(LANES).min(POINTS / LANES);
    for b in 0..blocks {
        sums.values[b] = [0.0; LANES];
        if GRADIENTS {
            for axis in 0..N {
                sums.gradients[axis][b] = [0.0; LANES];
            }
        }
    }
    let [first, last] = span(row, noise.radius_squared(), count);
    let mut sum = first;
    while sum <= last {
        sums.corners.draw::<L, S, GRADIENTS>(s, noise, row, seed, sum, blocks * LANES);
        for lane in 0..S::LEN {
            for c in 0..1 << (N - 1) {
                sums.add::<S, GRADIENTS>(s, lane % LANES, c % 8);
            }
        }
        sum += S::LEN as i32;
    }
}

/// The sums of the corners that may reach the row.
///
/// Corner c lies at c − u Σc, so Σc = √(n + 1) Σ of its coordinates; those beside the row differ from it by up to r √(n − 1).
#[inline(always)]
fn span<const N: usize>(row: &Row<N>, radius_squared: f32, count: usize) -> [i32; 2] {
    let radius = math::sqrt(radius_squared);
    let (a, b) = (row.x(0), row.x(count));
    let mut others = 0.0;
    for axis in 1..N {
        others += row.origin()[axis];
    }
    // Farthest are corners that all coordinates lead away: |Σ| ≤ r √n.
    let reach = radius * SUMS[N - 1];
    let (low, high) = (a.min(b) + others - reach, a.max(b) + others + reach);
    [(low * SUMS[N - 1]) as i32 - 1, (high * SUMS[N - 1]) as i32 + 1]
}

impl<const N: usize> Corners<N> {
    #[inline(always)]
    fn empty() -> Self {
        Self { x: NONE, rest: NONE, side: NONE, ends: [NONE; 2], g: [NONE; N], d: [NONE; N] }
    }

    /// The corners of the sums from `sum` on.
    ///
    /// Along every axis but the first, two lattice points at most lie within the radius.
    #[inline(always)]
    fn draw<L: Lattice, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        noise: &Simplex<L>,
        row: &Row<N>,
        seed: u32,
        sum: i32,
        points: usize,
    ) {
        let (one, radius) = (s.float(1.0), s.float(math::sqrt(noise.radius_squared())));
        let (origin, inverse) = (s.float(row.x(0)), s.float(1.0 / row.stride()));
        let total = s.word(sum as u32) + s.iota();
        let back = s.real(total) * s.float(UNSKEW[N - 1]);
        let (mut lows, mut terms) = ([back; N], [[total; 2]; N]);
        for axis in 1..N {
            lows[axis] = s.floor(s.float(row.origin()[axis]) + back - radius) + one;
            terms[axis] = noise.lattice().terms(s, axis, s.integer(lows[axis]));
        }
        for c in 0..1 << (N - 1) {
            let (mut first, mut words, mut d) = (s.real(total), [total; N], [back; N]);
            for axis in 1..N {
                let up = c >> (axis - 1) & 1;
                let skewed = if up == 0 { lows[axis] } else { lows[axis] + one };
                first = first - skewed;
                words[axis] = terms[axis][up];
                d[axis] = s.float(row.origin()[axis]) - (skewed - back);
            }
            words[0] = noise.lattice().term(s, 0, s.integer(first));
            let g: [S::F; N] = noise.direction(s, noise.lattice().upper_words(s, words, seed));
            let [rest, side] = beside(s, noise.radius_squared(), &d, &g);
            let x = first - back;
            // A little farther than to the gap, by more than what t is rounded by.
            let half = s.sqrt(s.above(rest - s.float(GAP - 1.0 / 1_048_576.0), 0.0));
            let (from, to) = ((x - half - origin) * inverse, (x + half - origin) * inverse);
            let ahead = s.less(from, to);
            let (from, to) = (s.select(ahead, from, to), s.select(ahead, to, from));
            // Places are rounded by less than one.
            let reached = s.less(s.float(GAP), rest);
            let ends = [from - one, s.select(reached, to + one + one, s.float(0.0))];
            let c = c % 8;
            for (end, ends) in [0, 1].into_iter().zip(ends) {
                let positive = s.above(ends, 0.0);
                let last = s.float(points as f32);
                let inside = s.select(s.less(positive, last), positive, last);
                s.store(s.float_of_bits(s.integer(s.floor(inside))), &mut self.ends[end][c]);
            }
            s.store(x, &mut self.x[c]);
            s.store(rest, &mut self.rest[c]);
            s.store(side, &mut self.side[c]);
            s.store(g[0], &mut self.g[0][c]);
            if GRADIENTS {
                for axis in 1..N {
                    s.store(g[axis], &mut self.g[axis][c]);
                    s.store(d[axis], &mut self.d[axis][c]);
                }
            }
        }
    }
}

impl<const N: usize> Sums<N> {
    /// Adds a corner's kernel to the points that it reaches.
    #[inline(always)]
    fn add<S: Lanes, const GRADIENTS: bool>(&mut self, s: S, lane: usize, c: usize) {
        let corners = &self.corners;
        let to = corners.ends[1][c][lane].to_bits() as usize;
        if to == 0 {
            return;
        }
        let from = corners.ends[0][c][lane].to_bits() as usize;
        let (from, to) = (from / S::LEN * S::LEN, to.next_multiple_of(S::LEN));
        let (x, rest, side) =
            (s.float(corners.x[c][lane]), s.float(corners.rest[c][lane]), s.float(corners.side[c][lane]));
        let mut g = [s.float(corners.g[0][c][lane]); N];
        let mut d = [s.float(0.0); N];
        for axis in 1..N {
            g[axis] = s.float(corners.g[axis][c][lane]);
            d[axis] = s.float(corners.d[axis][c][lane]);
        }
        let xs = self.x.as_flattened().get(from..to).unwrap_or_default().chunks_exact(S::LEN);
        let values = self.values.as_flattened_mut().get_mut(from..to).unwrap_or_default();
        for (i, (xs, values)) in xs.zip(values.chunks_exact_mut(S::LEN)).enumerate() {
            d[0] = s.load(xs) - x;
            let [t, slope] = along::<S, N>(s, [rest, side], d[0], g[0]);
            let t4 = kernel(t);
            s.store(s.load(values) + t4 * slope, values);
            if GRADIENTS {
                let pull = pull(s, t, slope);
                let i = from + i * S::LEN;
                for axis in 0..N {
                    let sums = &mut self.gradients[axis].as_flattened_mut()[i..];
                    s.store(s.load(sums) + (g[axis] * t4 - d[axis] * pull), sums);
                }
            }
        }
    }
}
