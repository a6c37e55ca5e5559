//! Noises that blend one linear function per corner of a cell: gradient, value, value-gradient and Gaussian noise.
//!
//! Corners are blended along the third axis and those after it first, which leaves four columns; then along the first axis,
//! which leaves two edges; then along the second. So rows of a grid that cross the same cells share their edges.
//!
//! ```text
//! column   C = c + a x + b y,                       x, y from the column
//! edge     E = e + f y,   e = lerp(c₀ + a₀ t, c₁ + a₁ (t − 1), w(t)),   f = lerp(b₀, b₁, w(t))
//! cell     n = lerp(e₀ + f₀ u, e₁ + f₁ (u − 1), w(u))
//! ```

use crate::{
    contract::kernel::{Kernel, LaneSample, Row, gaussian_moments},
    kinds::cell::blend::blend_values,
    kinds::cell::corners::Place,
    kinds::cell::rows::{Stretch, rows},
    kinds::cell::variance::axis_variance,
    lattice::fade::Fade,
    lattice::lattice::Lattice,
    simd::lanes::Lanes,
    statistics::statistics::Statistics,
};

/// The linear function of a corner: its value there and its gradient.
#[derive(Clone, Copy)]
pub(crate) struct Corner<S: Lanes, const N: usize> {
    pub(crate) value: S::F,
    pub(crate) gradient: [S::F; N],
}

/// What a noise draws at the corners of its cells, and how it blends them.
pub(crate) trait CellNoise<const N: usize> {
    /// Where the words come from.
    type Lattice: Lattice;
    /// Whether corners have values other than 0.
    const HAS_VALUE: bool;
    /// Whether corners have gradients other than 0.
    const HAS_GRADIENT: bool;
    /// The weights.
    const FADE: Fade;
    /// Whether the sum is divided by its standard deviation at the point, see [`Gaussian`](crate::Gaussian).
    const NORMALISED: bool = false;

    fn lattice(&self) -> &Self::Lattice;
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N>;
    fn statistics(&self) -> &'static Statistics;
    fn standard_deviation(&self) -> f32 {
        self.statistics().standard_deviation
    }
    fn absolute_moments(&self) -> [f32; 4] {
        gaussian_moments(self.standard_deviation())
    }
}

/// n and its gradient, and v and its gradient where the noise is normalised.
#[inline(always)]
pub(crate) fn parts<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    noise: &K,
    p: [S::F; N],
    seed: u32,
) -> (LaneSample<S, N>, LaneSample<S, N>) {
    let place = Place::new(s, noise, &p, 0);
    place.parts::<K>(s, &place.drawn_edges(s, noise, seed))
}

/// n/√v and its gradient.
#[inline(always)]
pub(crate) fn normalised<S: Lanes, const N: usize>(
    s: S,
    (value, gradient): LaneSample<S, N>,
    (v, dv): LaneSample<S, N>,
) -> LaneSample<S, N> {
    let inverse = s.float(1.0) / s.sqrt(v);
    let z = value * inverse;
    let factor = z * (s.float(0.5) * inverse * inverse);
    let mut dz = gradient;
    for axis in 0..N {
        dz[axis] = gradient[axis] * inverse - factor * dv[axis];
    }
    (z, dz)
}

impl<K: CellNoise<N>, const N: usize> Kernel<N> for K {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> S::F {
        let place = Place::new(s, self, &p, 0);
        let value = blend_values::<K, S, N>(s, &place.drawn_edges(s, self, seed), place.along[1 % N]);
        if !K::NORMALISED {
            return value;
        }
        let v = place.variance(s).value(axis_variance(s, &place.along[0]));
        value * (s.float(1.0) / s.sqrt(v))
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let (sample, variance) = parts(s, self, p, seed);
        if K::NORMALISED { normalised(s, sample, variance) } else { sample }
    }

    #[inline(always)]
    fn rows<S: Lanes, const SCALED: bool, const GRADIENTS: bool>(
        &self,
        s: S,
        row: &Row<N, SCALED>,
        seed: u32,
        stretch: &mut Stretch<N>,
        values: &mut [f32],
        gradients: Option<&mut [&mut [f32]; N]>,
    ) {
        rows::<K, S, N, SCALED, GRADIENTS>(s, self, row, seed, stretch, values, gradients);
    }

    fn statistics(&self) -> &'static Statistics {
        CellNoise::statistics(self)
    }

    fn standard_deviation(&self) -> f32 {
        CellNoise::standard_deviation(self)
    }

    fn absolute_moments(&self) -> [f32; 4] {
        CellNoise::absolute_moments(self)
    }
}
