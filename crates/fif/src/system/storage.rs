//! Storage for the maps of a system: an array, or a vector under `alloc`.

use crate::system::map::Piece;

/// Owned storage that a constructor can fill with the pieces of a system.
pub trait Storage<const C: usize>: AsRef<[Piece<C>]> + AsMut<[Piece<C>]> + Sized {
    /// Storage for exactly `len` pieces.
    ///
    /// # Errors
    /// The number that the type holds, where that is another one.
    fn with_len(len: usize) -> Result<Self, usize>;
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
}
