//! Storage for the maps of a system: an array, or a vector with `alloc`.

use crate::system::cell::Cell;
use crate::system::map::Piece;

/// Owned storage that a constructor can fill with the pieces of a system.
pub trait Storage<const C: usize>: AsRef<[Piece<C>]> + AsMut<[Piece<C>]> + Sized {
    /// Storage for exactly `len` pieces.
    ///
    /// # Errors
    /// The number of pieces that the type holds, if it differs.
    fn with_len(len: usize) -> Result<Self, usize>;

    /// All cells of a level, if there is memory for them.
    #[doc(hidden)]
    #[must_use]
    fn leaves(_: &[Piece<C>], _: u32) -> Option<impl AsRef<[Cell<C>]> + use<Self, C>> {
        None::<[Cell<C>; 0]>
    }
}

impl<const N: usize, const C: usize> Storage<C> for [Piece<C>; N] {
    fn with_len(len: usize) -> Result<Self, usize> {
        if len == N { Ok([Piece::EMPTY; N]) } else { Err(N) }
    }
}

#[cfg(feature = "alloc")]
impl<const C: usize> Storage<C> for alloc::vec::Vec<Piece<C>> {
    fn with_len(len: usize) -> Result<Self, usize> {
        Ok(alloc::vec![Piece::EMPTY; len])
    }

    fn leaves(pieces: &[Piece<C>], depth: u32) -> Option<impl AsRef<[Cell<C>]> + use<C>> {
        let mut cells = alloc::vec![Cell::root()];
        for _ in 0..depth {
            cells = cells.iter().flat_map(|cell| pieces.iter().map(|piece| cell.child(piece))).collect();
        }
        Some(cells)
    }
}
