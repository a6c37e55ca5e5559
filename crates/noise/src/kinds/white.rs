//! White noise: one random number per cell.

use crate::{
    contract::compiled::on_lattice,
    contract::kernel::Kernel,
    contract::noise::{kind, measured, noise, tiles},
    lanes::{LaneSample, Lanes},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::{Lattice, cell},
    lattice::variates::uniform,
    statistics::tables,
};

/// One random number per cell, uniform in (−1, 1) and independent; discontinuous at cell borders.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/white.md"))]
///
/// ```text
/// n(p) = 2 word(⌊p⌋)/2³² − 1
/// ```
///
/// In 1 to 4 dimensions. The gradient is 0 everywhere, as it is inside every cell.
///
/// - **Range:** (−1, 1). Values are multiples of 2⁻²³ plus half a step. The variance is 1/3 at
///   every point.
///
/// Ebert (ed.) 1994, "Texturing and Modeling".
///
/// ```
/// use asperity_noise::{Field, WhiteNoise, glam::Vec2};
///
/// let noise = WhiteNoise::new(3);
/// assert_eq!(noise.sample(Vec2::new(0.1, -0.1)), noise.sample(Vec2::new(0.9, -0.9)));
/// assert_ne!(noise.value(Vec2::new(0.1, 0.1)), noise.value(Vec2::new(0.1, -0.1)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WhiteNoise<L = IntegerHash> {
    seed: u32,
    lattice: L,
}

kind!(WhiteNoise);
measured!(WhiteNoise, |self| &tables::WHITE);
noise!(WhiteNoise);
tiles!(WhiteNoise);

impl<L: Lattice, const N: usize> Kernel<N> for WhiteNoise<L> {
    type RowScratch = ();

    on_lattice!();

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let mut terms = [s.word(0); N];
        for axis in 0..N {
            let (cell, _) = cell(s, p[axis]);
            terms[axis] = self.lattice.term(s, axis, cell);
        }
        (uniform(s, self.lattice.words(s, terms, seed)), [s.float(0.0); N])
    }
}
