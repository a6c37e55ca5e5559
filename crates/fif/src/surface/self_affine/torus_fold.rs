//! The torus folded by an integer matrix, with its nodes.

use alloc::vec::Vec;

use crate::surface::hermite_patch::{Corner, Patch};

/// The unit torus under an integer matrix, with nodes on a square grid.
#[derive(Clone, Debug)]
pub struct TorusFold {
    pub(crate) nodes: Vec<Node>,
    pub(crate) bits: u32,
    pub(crate) matrix: [[i32; 2]; 2],
    /// `s M`.
    pub(crate) scaled: [[f64; 2]; 2],
}

/// A node: its data and those of the patches' corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// `p` and its slopes per width of a cell.
    pub(crate) corner: Corner,
    /// `z` and `d` as given.
    pub(crate) data: Corner,
}

impl TorusFold {
    /// The number of nodes along a side.
    #[inline]
    #[must_use]
    pub const fn side(&self) -> usize {
        1 << self.bits
    }

    /// The node of an index pair, modulo the side.
    #[inline]
    pub(crate) fn node(&self, [i, j]: [usize; 2]) -> Node {
        const NONE: Node = Node { corner: [0.0; 3], data: [0.0; 3] };
        let mask = (1 << self.bits) - 1;
        self.nodes.get((i & mask) << self.bits | j & mask).copied().unwrap_or(NONE)
    }

    /// The patch of p over a cell.
    #[inline]
    pub(crate) fn patch(&self, [i, j]: [usize; 2]) -> Patch {
        let corner = |i, j| self.node([i, j]).corner;
        let [next_i, next_j] = [i.wrapping_add(1), j.wrapping_add(1)];
        Patch([[corner(i, j), corner(i, next_j)], [corner(next_i, j), corner(next_i, next_j)]])
    }
}
