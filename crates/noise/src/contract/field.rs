//! What a batch evaluates: a noise with its seed, or a sum of octaves with its number of octaves.

use crate::{
    contract::kernel::{Kernel, LaneSample, Row, put, put_sample, samples, values},
    contract::point::Point,
    contract::sample::Sample,
    kinds::cell::rows::Stretch,
    row::scratch::Scratch,
    simd::lanes::{Lanes, Scalar},
};

/// A function of points in N dimensions that [`Batch`](crate::Batch) can fill grids and lists of points with.
///
/// Sealed in effect: its methods work in lanes, which only this crate can make.
pub trait Field<const N: usize> {
    /// The values at any points.
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N]) -> S::F;

    /// Values and gradients at any points.
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N]) -> LaneSample<S, N>;

    /// Value and gradient at a point.
    #[must_use]
    #[inline]
    fn sample<V: Point<N>>(&self, p: V) -> Sample<V> {
        let (value, gradient) = self.lane_samples(Scalar, p.coordinates());
        Sample { value, gradient: V::from_coordinates(gradient) }
    }

    /// The value at a point, the same bits as [`sample`](Self::sample)'s.
    #[must_use]
    #[inline]
    fn value<V: Point<N>>(&self, p: V) -> f32 {
        self.lane_values(Scalar, p.coordinates())
    }

    /// How many times a grid is gone through; every pass but the first adds to the values.
    #[inline(always)]
    fn passes(&self) -> usize {
        1
    }

    /// The values along a row in one of the passes.
    #[inline(always)]
    fn pass_values<S: Lanes>(
        &self,
        s: S,
        _pass: usize,
        row: &Row<N, false>,
        scratch: &mut Scratch<N>,
        values: &mut [f32],
    ) {
        self.row_values(s, row, scratch, values);
    }

    /// Values and gradients along a row in one of the passes, `gradients` as long as `values` or longer.
    #[inline(always)]
    fn pass_samples<S: Lanes>(
        &self,
        s: S,
        _pass: usize,
        row: &Row<N, false>,
        scratch: &mut Scratch<N>,
        values: &mut [f32],
        gradients: &mut [&mut [f32]; N],
    ) {
        self.row_samples(s, row, scratch, values, gradients);
    }

    /// The values along a row.
    #[inline(always)]
    fn row_values<S: Lanes>(&self, s: S, row: &Row<N, false>, _scratch: &mut Scratch<N>, values: &mut [f32]) {
        for i in (0..values.len()).step_by(S::LEN) {
            put(s, self.lane_values(s, row.points(s, i)), values, i, values.len());
        }
    }

    /// Values and gradients along a row, `gradients` as long as `values` or longer.
    #[inline(always)]
    fn row_samples<S: Lanes>(
        &self,
        s: S,
        row: &Row<N, false>,
        _scratch: &mut Scratch<N>,
        values: &mut [f32],
        gradients: &mut [&mut [f32]; N],
    ) {
        for i in (0..values.len()).step_by(S::LEN) {
            put_sample(s, self.lane_samples(s, row.points(s, i)), values, gradients, i);
        }
    }
}

/// A kind of noise with its seed.
///
/// ```
/// use asperity_noise::{Batch, Grid, Perlin2002, Seeded, glam::Vec2};
///
/// let grid = Grid { origin: Vec2::ZERO, step: Vec2::splat(0.1), size: [8, 4] };
/// let mut values = [0.0; 32];
/// Batch::new().fill_grid(&Seeded(Perlin2002::default(), 7), &grid, &mut values)?;
/// # Ok::<(), asperity_noise::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seeded<K>(
    /// The kind.
    pub K,
    /// The seed.
    pub u32,
);

impl<K: Kernel<N>, const N: usize> Field<N> for Seeded<K> {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N]) -> S::F {
        values(&self.0, s, p, self.1)
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N]) -> LaneSample<S, N> {
        samples(&self.0, s, p, self.1)
    }

    #[inline(always)]
    fn row_values<S: Lanes>(&self, s: S, row: &Row<N, false>, scratch: &mut Scratch<N>, out: &mut [f32]) {
        row_values(&self.0, s, row, self.1, &mut scratch.columns, out);
    }

    #[inline(always)]
    fn row_samples<S: Lanes>(
        &self,
        s: S,
        row: &Row<N, false>,
        scratch: &mut Scratch<N>,
        values: &mut [f32],
        gradients: &mut [&mut [f32]; N],
    ) {
        row_samples(&self.0, s, row, self.1, &mut scratch.columns, values, gradients);
    }
}

/// The values along any row.
#[inline(always)]
pub(crate) fn row_values<K: Kernel<N>, S: Lanes, const N: usize, const SCALED: bool>(
    kernel: &K,
    s: S,
    row: &Row<N, SCALED>,
    seed: u32,
    columns: &mut Stretch<N>,
    out: &mut [f32],
) {
    if row.is_within(K::REACH, out.len()) {
        kernel.rows::<S, SCALED, false>(s, row, seed, columns, out, None);
        return;
    }
    for i in (0..out.len()).step_by(S::LEN) {
        put(s, values(kernel, s, row.points(s, i), seed), out, i, out.len());
    }
}

/// Values and gradients along any row.
#[inline(always)]
pub(crate) fn row_samples<K: Kernel<N>, S: Lanes, const N: usize, const SCALED: bool>(
    kernel: &K,
    s: S,
    row: &Row<N, SCALED>,
    seed: u32,
    columns: &mut Stretch<N>,
    values: &mut [f32],
    gradients: &mut [&mut [f32]; N],
) {
    if row.is_within(K::REACH, values.len()) {
        kernel.rows::<S, SCALED, true>(s, row, seed, columns, values, Some(gradients));
        return;
    }
    for i in (0..values.len()).step_by(S::LEN) {
        put_sample(s, samples(kernel, s, row.points(s, i), seed), values, gradients, i);
    }
}
