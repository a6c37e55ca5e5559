//! Noises on cells as kinds: at points, along rows, with their statistics.

use crate::{
    contract::kernel::{Kernel, Sealed},
    kinds::cell::blend::blend_values,
    kinds::cell::corner::{CellNoise, normalised},
    kinds::cell::corners::Place,
    kinds::cell::rows::{Stretch, rows},
    kinds::cell::variance::axis_variance,
    lanes::lanes::{LaneSample, Lanes},
    row::row::Row,
    statistics::statistics::Statistics,
};

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

impl<K: CellNoise<N>, const N: usize> Sealed<N> for K {}

impl<K: CellNoise<N>, const N: usize> Kernel<N> for K {
    type RowScratch = Stretch<N>;

    #[inline(always)]
    fn seed(&self) -> u32 {
        CellNoise::seed(self)
    }

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
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        row: &Row<N>,
        seed: u32,
        stretch: &mut Stretch<N>,
        values: &mut [f32],
        gradients: Option<&mut [&mut [f32]; N]>,
    ) {
        rows::<K, S, N, GRADIENTS>(s, self, row, seed, stretch, values, gradients);
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
