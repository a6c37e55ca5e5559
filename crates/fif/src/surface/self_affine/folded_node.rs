//! Where the nodes of a folded surface live: an array, a vector under `alloc`, or a borrowed slice.

use crate::surface::hermite_patch::Corner;
use crate::surface::self_affine::folded::FoldedSurface;

/// A node of a [`FoldedSurface`]: where it is, its data and those of the repeated part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoldedNode {
    /// Its place, in units of the domain.
    pub(crate) at: [f64; 2],
    /// `z` and `d` as given.
    pub(crate) data: Corner,
    /// `H − G` and its slopes per width of the domain.
    pub(crate) own: Corner,
}

impl FoldedNode {
    /// A node at height 0; what arrays are filled with before a constructor runs.
    pub const EMPTY: Self = Self { at: [0.0; 2], data: [0.0; 3], own: [0.0; 3] };
}

/// Owned storage that the constructor can fill with nodes: an array, or a vector under `alloc`.
pub trait FoldedStorage: AsRef<[FoldedNode]> + AsMut<[FoldedNode]> + Sized {
    /// Storage for exactly `len` nodes, or the number that the type holds when that is another.
    ///
    /// # Errors
    /// The number of nodes that fit.
    fn with_len(len: usize) -> Result<Self, usize>;
}

impl<const N: usize> FoldedStorage for [FoldedNode; N] {
    fn with_len(len: usize) -> Result<Self, usize> {
        if len == N { Ok([FoldedNode::EMPTY; N]) } else { Err(N) }
    }
}

#[cfg(feature = "alloc")]
impl FoldedStorage for alloc::vec::Vec<FoldedNode> {
    fn with_len(len: usize) -> Result<Self, usize> {
        Ok(alloc::vec![FoldedNode::EMPTY; len])
    }
}

/// A folded surface of `N` nodes in an array; needs no allocator.
pub type FixedFolded<const N: usize> = FoldedSurface<[FoldedNode; N]>;

/// A folded surface of any number of nodes in a vector.
#[cfg(feature = "alloc")]
pub type FoldedBuf = FoldedSurface<alloc::vec::Vec<FoldedNode>>;

/// A folded surface over borrowed nodes, from [`FoldedSurface::view`]; copyable.
pub type FoldedView<'a> = FoldedSurface<&'a [FoldedNode]>;
