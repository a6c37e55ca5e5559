//! Noises on cells as kinds: at points and along rows.

use crate::{
    contract::kernel::{Kernel, on_lattice},
    kinds::cell::corner::{CellNoise, normalised},
    kinds::cell::corners::Place,
    kinds::cell::rows::Stretch,
    lanes::lanes::{LaneSample, Lanes},
    row::row::Strip,
};

/// n, and v where the noise is normalised, with their gradients if `GRADIENTS`.
#[inline(always)]
pub(crate) fn parts<K: CellNoise<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    p: [S::F; N],
    seed: u32,
) -> (LaneSample<S, N>, LaneSample<S, N>) {
    let place = Place::new(s, noise, &p, 0);
    place.parts::<K, GRADIENTS>(s, &place.drawn_edges(s, noise, seed))
}

impl<K: CellNoise<N>, const N: usize> Kernel<N> for K {
    type RowScratch = Stretch<N>;

    on_lattice!();

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let (sample, variance) = parts::<K, S, N, GRADIENTS>(s, self, p, seed);
        if K::NORMALISED { normalised::<S, N, GRADIENTS>(s, sample, variance) } else { sample }
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        stretch: &mut Stretch<N>,
        strip: Strip<'_, N, GRADIENTS>,
    ) {
        stretch.rows(s, self, strip);
    }
}
