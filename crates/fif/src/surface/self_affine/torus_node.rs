//! Where the nodes of a torus surface live: an array, a vector under `alloc`, or a borrowed slice.

use crate::surface::hermite_patch::Corner;
use crate::surface::self_affine::torus::TorusSurface;

/// A node of a [`TorusSurface`]: its data and those of the patches' corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorusNode {
    /// `p` and its slopes per width of a cell.
    pub(crate) corner: Corner,
    /// `z` and `d` as given.
    pub(crate) data: Corner,
}

impl TorusNode {
    /// A node at height 0; what arrays are filled with before a constructor runs.
    pub const EMPTY: Self = Self { corner: [0.0; 3], data: [0.0; 3] };
}

/// Owned storage that the constructor can fill with nodes: an array, or a vector under `alloc`.
pub trait TorusStorage: AsRef<[TorusNode]> + AsMut<[TorusNode]> + Sized {
    /// Storage for exactly `len` nodes, or the number that the type holds when that is another.
    ///
    /// # Errors
    /// The number of nodes that fit.
    fn with_len(len: usize) -> Result<Self, usize>;
}

impl<const N: usize> TorusStorage for [TorusNode; N] {
    fn with_len(len: usize) -> Result<Self, usize> {
        if len == N { Ok([TorusNode::EMPTY; N]) } else { Err(N) }
    }
}

#[cfg(feature = "alloc")]
impl TorusStorage for alloc::vec::Vec<TorusNode> {
    fn with_len(len: usize) -> Result<Self, usize> {
        Ok(alloc::vec![TorusNode::EMPTY; len])
    }
}

/// A torus surface of `N` nodes, the square of the side, in an array; needs no allocator.
pub type FixedTorus<const N: usize> = TorusSurface<[TorusNode; N]>;

/// A torus surface of any number of nodes in a vector.
#[cfg(feature = "alloc")]
pub type TorusBuf = TorusSurface<alloc::vec::Vec<TorusNode>>;

/// A torus surface over borrowed nodes, from [`TorusSurface::view`]; copyable.
pub type TorusView<'a> = TorusSurface<&'a [TorusNode]>;
