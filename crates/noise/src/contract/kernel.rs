//! A kind of noise as lanes see it: what each kind implements once, and single points and batches share.

use crate::{
    kinds::cell::rows::Stretch,
    lattice::lattice::{REACH, is_within, wrapped},
    simd::lanes::{LANES, Lanes, Scalar},
    statistics::statistics::Statistics,
};

/// A value in lanes, and its gradient.
pub type LaneSample<S, const N: usize> = (<S as Lanes>::F, [<S as Lanes>::F; N]);

/// A kind of noise in N dimensions, written over [`Lanes`].
///
/// Points have finite coordinates of at most 2³¹ in magnitude. Every method gives a point the same bits.
pub trait Kernel<const N: usize> {
    /// Where Σ |xᵢ| reaches this the noise is 0. By default coordinates go on to ∞ with their cells modulo 2³².
    #[doc(hidden)]
    const REACH: f32 = REACH;

    /// The values at points.
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> S::F;

    /// Values and gradients at points.
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N>;

    /// The values along a row, and the gradients if `GRADIENTS`. What does not change along it may be computed once.
    ///
    /// `gradients` are there if `GRADIENTS`, and as long as `values` or longer.
    #[inline(always)]
    fn rows<S: Lanes, const SCALED: bool, const GRADIENTS: bool>(
        &self,
        s: S,
        row: &Row<N, SCALED>,
        seed: u32,
        _stretch: &mut Stretch<N>,
        values: &mut [f32],
        gradients: Option<&mut [&mut [f32]; N]>,
    ) {
        by_lanes::<Self, S, N, SCALED, GRADIENTS>(s, self, row, seed, values, gradients);
    }

    /// The measured statistics of the kind in this dimension.
    fn statistics(&self) -> &'static Statistics;

    /// σ₁, the standard deviation of this very noise; other than the table's where a kind has parameters.
    fn standard_deviation(&self) -> f32 {
        self.statistics().standard_deviation
    }

    /// E|n|, E|n|², E|n|³ and E|n|⁴ of one octave over all points and seeds, what a [`Shape`](crate::Shape)'s mean follows from.
    ///
    /// Measured for the kinds of this crate. The default is that of N(0, σ²), σ being the standard deviation: √(2/π) σ, σ²,
    /// 2√(2/π) σ³ and 3σ⁴.
    fn absolute_moments(&self) -> [f32; 4] {
        gaussian_moments(self.standard_deviation())
    }
}

/// Points at equal steps along the first axis: xᵢ = x₀ + step·i; if `SCALED`, frequency·(x₀ + step·i) + offset.
///
/// Every operation is rounded, as where the points are computed one by one.
#[derive(Clone, Copy, Debug)]
pub struct Row<const N: usize, const SCALED: bool> {
    /// x₀ and the other coordinates, which are those of all points.
    origin: [f32; N],
    step: f32,
    /// The index of the first point.
    start: usize,
    frequency: f32,
    offset: f32,
}

impl<const N: usize> Row<N, false> {
    #[inline(always)]
    pub(crate) fn new(origin: [f32; N], step: f32, start: usize) -> Self {
        // −0 + 0 = 0, so that no point's first coordinate is −0.
        Self { origin: origin.map(|x| x + 0.0), step, start, frequency: 1.0, offset: 0.0 }
    }

    /// The row in the coordinates of an octave; the offset must not be −0.
    #[inline(always)]
    pub(crate) fn scaled(&self, frequency: [f32; N], offset: [f32; N]) -> Row<N, true> {
        let mut origin = self.origin;
        for axis in 1..N {
            origin[axis] = frequency[axis] * self.origin[axis] + offset[axis];
        }
        Row { origin, step: self.step, start: self.start, frequency: frequency[0], offset: offset[0] }
    }
}

impl<const N: usize, const SCALED: bool> Row<N, SCALED> {
    /// The row from point `start` on.
    #[inline(always)]
    pub(crate) fn after(&self, start: usize) -> Self {
        Self { start: self.start + start, ..*self }
    }

    /// What the first coordinates depend on.
    #[inline(always)]
    pub(crate) fn key(&self) -> RowKey {
        let x = [self.origin[0], self.step, self.frequency, self.offset];
        RowKey { x: x.map(f32::to_bits), start: self.start, scaled: SCALED }
    }

    /// The index of point i in the whole row.
    #[inline(always)]
    pub(crate) fn index(&self, i: usize) -> usize {
        self.start + i
    }

    /// The coordinates of point i.
    #[inline(always)]
    pub(crate) fn point(&self, i: usize) -> [f32; N] {
        let mut p = self.origin;
        p[0] = self.x(i);
        p
    }

    /// The first coordinate of point i.
    #[inline(always)]
    pub(crate) fn x(&self, i: usize) -> f32 {
        let x = self.origin[0] + self.step * ((self.start + i) as i32 as f32);
        if SCALED { self.frequency * x + self.offset } else { x }
    }

    /// The first coordinates of as many points as there are lanes, from point i on.
    #[inline(always)]
    pub(crate) fn xs<S: Lanes>(&self, s: S, i: usize) -> S::F {
        let index = s.word((self.start + i) as u32) + s.iota();
        let x = s.float(self.origin[0]) + s.float(self.step) * s.real(index);
        if SCALED { s.float(self.frequency) * x + s.float(self.offset) } else { x }
    }

    /// As many points as there are lanes, from point i on.
    #[inline(always)]
    pub(crate) fn points<S: Lanes>(&self, s: S, i: usize) -> [S::F; N] {
        let mut p = [self.xs(s, i); N];
        for axis in 1..N {
            p[axis] = s.float(self.origin[axis]);
        }
        p
    }

    /// The coordinates of the first point; the first one is of no meaning in a scaled row.
    #[inline(always)]
    pub(crate) fn origin(&self) -> [f32; N] {
        self.origin
    }

    /// How far apart points are, but for rounding.
    #[inline(always)]
    pub(crate) fn stride(&self) -> f32 {
        if SCALED { self.frequency * self.step } else { self.step }
    }

    /// Whether all of `count` points are within reach.
    #[inline(always)]
    pub(crate) fn is_within(&self, reach: f32, count: usize) -> bool {
        [0, count].into_iter().all(|i| is_within(Scalar, &self.point(i), reach))
    }
}

/// What the first coordinates of a row depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RowKey {
    x: [u32; 4],
    start: usize,
    scaled: bool,
}

/// E|n|ᵏ of N(0, σ²), k = 1 … 4.
pub(crate) fn gaussian_moments(sigma: f32) -> [f32; 4] {
    const FIRST: f32 = 0.797_884_6;
    let square = sigma * sigma;
    [FIRST * sigma, square, 2.0 * FIRST * (square * sigma), 3.0 * (square * square)]
}

/// The values at any points.
#[inline(always)]
pub(crate) fn values<K: Kernel<N>, S: Lanes, const N: usize>(
    kernel: &K,
    s: S,
    p: [S::F; N],
    seed: u32,
) -> S::F {
    if is_within(s, &p, K::REACH) {
        kernel.lane_values(s, p, seed)
    } else {
        s.floats(|lane| far_value(kernel, p.map(|x| s.lane(x, lane)), seed))
    }
}

/// Values and gradients at any points.
#[inline(always)]
pub(crate) fn samples<K: Kernel<N>, S: Lanes, const N: usize>(
    kernel: &K,
    s: S,
    p: [S::F; N],
    seed: u32,
) -> LaneSample<S, N> {
    if is_within(s, &p, K::REACH) {
        return kernel.lane_samples(s, p, seed);
    }
    let mut far = [(0.0, [0.0; N]); LANES];
    for lane in 0..S::LEN {
        far[lane % LANES] = far_sample(kernel, p.map(|x| s.lane(x, lane)), seed);
    }
    let mut gradient = p;
    for axis in 0..N {
        gradient[axis] = s.floats(|lane| far[lane % LANES].1[axis]);
    }
    (s.floats(|lane| far[lane % LANES].0), gradient)
}

/// Values along a row, and gradients if `GRADIENTS`, from as many single points at once as there are lanes.
#[inline(always)]
pub(crate) fn by_lanes<K, S: Lanes, const N: usize, const SCALED: bool, const GRADIENTS: bool>(
    s: S,
    kernel: &K,
    row: &Row<N, SCALED>,
    seed: u32,
    values: &mut [f32],
    mut gradients: Option<&mut [&mut [f32]; N]>,
) where
    K: Kernel<N> + ?Sized,
{
    for i in (0..values.len()).step_by(S::LEN) {
        let p = row.points(s, i);
        match &mut gradients {
            Some(gradients) if GRADIENTS => {
                put_sample(s, kernel.lane_samples(s, p, seed), values, gradients, i);
            }
            _ => put(s, kernel.lane_values(s, p, seed), values, i, values.len()),
        }
    }
}

/// Writes the lanes for the points from `i` to `count`.
#[inline(always)]
pub(crate) fn put<S: Lanes>(s: S, x: S::F, out: &mut [f32], i: usize, count: usize) {
    if let Some(out) = out.get_mut(i..i + S::LEN) {
        s.store(x, out);
    } else if let Some(out) = out.get_mut(i..count) {
        s.store(x, out);
    }
}

/// Writes values and gradients in lanes for the points from `i` to the end of `values`.
#[inline(always)]
pub(crate) fn put_sample<S: Lanes, const N: usize>(
    s: S,
    (value, gradient): LaneSample<S, N>,
    values: &mut [f32],
    gradients: &mut [&mut [f32]; N],
    i: usize,
) {
    let count = values.len();
    put(s, value, values, i, count);
    for axis in 0..N {
        put(s, gradient[axis], gradients[axis], i, count);
    }
}

/// The point itself if it is within reach; beyond, a point with the same cells, if the kind has cells there.
#[inline]
pub(crate) fn evaluated<K: Kernel<N> + ?Sized, const N: usize>(p: [f32; N]) -> Option<[f32; N]> {
    if is_within(Scalar, &p, K::REACH) {
        Some(p)
    } else if K::REACH < REACH {
        None
    } else {
        wrapped(p)
    }
}

#[cold]
#[inline(never)]
fn far_value<K: Kernel<N>, const N: usize>(kernel: &K, p: [f32; N], seed: u32) -> f32 {
    evaluated::<K, N>(p).map_or(0.0, |p| kernel.lane_values(Scalar, p, seed))
}

#[cold]
#[inline(never)]
fn far_sample<K: Kernel<N>, const N: usize>(kernel: &K, p: [f32; N], seed: u32) -> (f32, [f32; N]) {
    evaluated::<K, N>(p).map_or((0.0, [0.0; N]), |p| kernel.lane_samples(Scalar, p, seed))
}
