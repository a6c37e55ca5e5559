//! Storage for the maps of a system: an array, or a vector under `alloc`.

use crate::system::map::Piece;

/// Owned storage that a constructor can fill with the pieces of a system.
pub trait Storage<const C: usize>: AsRef<[Piece<C>]> + AsMut<[Piece<C>]> + Sized {
    /// Storage for exactly `len` pieces, or `None` when the type cannot hold as many.
    #[must_use]
    fn with_len(len: usize) -> Option<Self>;

    /// The number of pieces that the type holds when that is fixed, else `usize::MAX`.
    #[must_use]
    fn capacity() -> usize;
}

impl<const N: usize, const C: usize> Storage<C> for [Piece<C>; N] {
    fn with_len(len: usize) -> Option<Self> {
        (len == N).then_some([Piece::EMPTY; N])
    }

    fn capacity() -> usize {
        N
    }
}

#[cfg(feature = "alloc")]
impl<const C: usize> Storage<C> for alloc::vec::Vec<Piece<C>> {
    fn with_len(len: usize) -> Option<Self> {
        Some(alloc::vec![Piece::EMPTY; len])
    }

    fn capacity() -> usize {
        usize::MAX
    }
}
