//! Lattices relative to a cell far from the origin.

use crate::{
    lanes::Lanes,
    lattice::lattice::{Lattice, words_of_terms_in},
};

/// A lattice whose cells are relative to another cell, the lattice of an anchored sum of octaves.
///
/// ```text
/// word(c) = L.word(c + cell mod 2³²)
/// ```
///
/// Created by [`Fbm::anchored`](crate::Fbm::anchored), with the cell of each octave's
/// anchor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shifted<L, const N: usize> {
    lattice: L,
    cell: [i32; N],
}

impl<L, const N: usize> Shifted<L, N> {
    /// The lattice itself, before an octave shifts it.
    pub(crate) const fn new(lattice: L) -> Self {
        Self { lattice, cell: [0; N] }
    }
}

impl<L: Lattice + Clone, const M: usize> Lattice for Shifted<L, M> {
    const TILED: bool = L::TILED;
    const SHARED: bool = false;

    #[inline(always)]
    fn of_octave(&self, _: f32, cell: &[i32]) -> Option<Self> {
        let mut shifted = self.clone();
        shifted.cell.copy_from_slice(cell.get(..M)?);
        Some(shifted)
    }

    words_of_terms_in!(lattice);

    #[inline(always)]
    fn term<S: Lanes>(&self, s: S, axis: usize, cell: S::U) -> S::U {
        let shift = self.cell.get(axis).copied().unwrap_or(0);
        self.lattice.term(s, axis, cell + s.word(shift as u32))
    }
}
