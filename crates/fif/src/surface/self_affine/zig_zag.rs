//! The rectangle folded by zig-zags along both axes, with its nodes.

use alloc::vec::Vec;

use crate::numeric::interval::Interval;
use crate::surface::hermite_patch::{Corner, Patch};
use crate::surface::self_affine::self_affine::Part;

/// A rectangle under zig-zags, affine from every cell of a grid onto the whole, rising and falling in turn.
#[derive(Clone, Debug)]
pub struct ZigZag {
    pub(crate) nodes: Vec<Node>,
    pub(crate) cells: [usize; 2],
    pub(crate) domain: [Interval; 2],
}

/// A node: its place, its data and those of the repeated part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// In units of the domain.
    pub(crate) at: [f64; 2],
    /// `z` and `d` as given.
    pub(crate) data: Corner,
    /// `H − G` and its slopes per width of the domain.
    pub(crate) own: Corner,
}

/// A cell of one axis, and a place within it.
#[derive(Clone, Copy)]
pub(crate) struct Strip {
    pub(crate) index: usize,
    /// In units of the domain.
    pub(crate) width: f64,
    /// In units of the cell.
    pub(crate) u: f64,
}

impl Strip {
    /// Image of the place under Φ.
    #[inline]
    pub(crate) fn folded(self) -> f64 {
        if self.index.is_multiple_of(2) { self.u } else { 1.0 - self.u }
    }

    /// The slope of Φ, or of the zig-zag along this axis.
    #[inline]
    pub(crate) fn slope(self) -> f64 {
        if self.index.is_multiple_of(2) { 1.0 / self.width } else { -1.0 / self.width }
    }
}

impl ZigZag {
    /// Knot `index` of an axis, in units of the domain.
    #[inline]
    fn knot(&self, axis: usize, index: usize) -> f64 {
        let number = if axis == 0 { index * (self.cells[1] + 1) } else { index };
        self.nodes.get(number).map_or(0.0, |node| if axis == 0 { node.at[0] } else { node.at[1] })
    }

    /// A whole cell of an axis.
    pub(crate) fn strip_of(&self, axis: usize, index: usize) -> Strip {
        Strip { index, width: self.knot(axis, index + 1) - self.knot(axis, index), u: 0.0 }
    }

    /// The cell of an axis in which a place is, in units of the domain.
    #[inline]
    pub(crate) fn strip(&self, axis: usize, place: f64) -> Strip {
        let count = if axis == 0 { self.cells[0] } else { self.cells[1] };
        let mut index = ((place * count as f64) as usize).min(count - 1);
        while index > 0 && place < self.knot(axis, index) {
            index -= 1;
        }
        while index + 1 < count && place >= self.knot(axis, index + 1) {
            index += 1;
        }
        let left = self.knot(axis, index);
        let width = self.knot(axis, index + 1) - left;
        let u = (place - left) / width;
        Strip { index, width, u: if u > 1.0 { 1.0 } else { u } }
    }

    /// The patch of a function over a cell, slopes per width of the cell.
    #[inline]
    pub(crate) fn patch(&self, [x, y]: [Strip; 2], part: Part) -> Patch {
        let corner = |i: usize, j: usize| {
            let node = self.node([i, j]);
            let ([z, z_x, z_y], scale) = match part {
                Part::Data => (node.data, self.domain.map(Interval::width)),
                Part::Own => (node.own, [1.0; 2]),
            };
            [z, z_x * (x.width * scale[0]), z_y * (y.width * scale[1])]
        };
        let ([i, j], [next_i, next_j]) = ([x.index, y.index], [x.index + 1, y.index + 1]);
        Patch([[corner(i, j), corner(i, next_j)], [corner(next_i, j), corner(next_i, next_j)]])
    }

    /// The node of an index pair.
    #[inline]
    pub(crate) fn node(&self, [i, j]: [usize; 2]) -> Node {
        const NONE: Node = Node { at: [0.0; 2], data: [0.0; 3], own: [0.0; 3] };
        self.nodes.get(i * (self.cells[1] + 1) + j).copied().unwrap_or(NONE)
    }
}

/// A place in units of the domain, clamped to it; NaN for NaN.
#[inline]
pub(crate) fn part_of(domain: Interval, x: f64) -> f64 {
    let x = if x < domain.lo { domain.lo } else { x };
    let x = if x > domain.hi { domain.hi } else { x };
    (x - domain.lo) / (domain.hi - domain.lo)
}
