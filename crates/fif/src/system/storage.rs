//! Where the maps of a system live: an array, or a vector under `alloc`.

use crate::surface::height_field::axis::Smooth;
use crate::system::fif::Fif;
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

/// A system of `N` maps in an array; needs no allocator.
pub type FixedFif<const N: usize, const C: usize> = Fif<[Piece<C>; N], C>;

/// A system of any number of maps in a vector.
#[cfg(feature = "alloc")]
pub type FifBuf<const C: usize> = Fif<alloc::vec::Vec<Piece<C>>, C>;

/// A system over borrowed pieces, from [`Fif::view`]; copyable.
pub type FifView<'a, const C: usize> = Fif<&'a [Piece<C>], C>;

/// A smooth function of `N` maps in arrays: `C` coefficients for it, `D = C − 1` for its derivative.
pub type FixedSmooth<const N: usize, const C: usize, const D: usize> =
    Smooth<[Piece<C>; N], C, [Piece<D>; N], D>;

/// A smooth function of any number of maps in vectors: `C` coefficients for it, `D = C − 1` for its derivative.
#[cfg(feature = "alloc")]
pub type SmoothBuf<const C: usize, const D: usize> =
    Smooth<alloc::vec::Vec<Piece<C>>, C, alloc::vec::Vec<Piece<D>>, D>;
