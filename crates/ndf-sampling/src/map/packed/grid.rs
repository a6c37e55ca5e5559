//! Grid of a packed map: its bins, columns and rows on the disk.

use crate::map::packed::layout::Layout;

/// Places that a layout states, as floats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// Bins, and rows, per unit of a normal's coordinate, and the reverse.
    pub(crate) density: [f32; 2],
    pub(crate) size: [f32; 2],
    /// The bins before `n_x = 0`, and the rows before `n_y = 0`.
    pub(crate) origin: [f32; 2],
    /// The middles of the last bin and of the last row.
    pub(crate) last: [f32; 2],
    /// Margin of a sample from the lines between bins and between rows, from which it might round across.
    pub(crate) margin: [f32; 2],
    /// Bins of a column, and the reverse.
    pub(crate) split: f32,
    pub(crate) per_split: f32,
    /// The weight of a bin as wide as others is this times its mean marginal.
    pub(crate) weight_per_marginal: f32,
    /// Entries of the guide, and of a column's quantiles less one.
    pub(crate) guide: f32,
    pub(crate) quantiles: f32,
    /// Numbers of a column of the quantiles, and of the nodes.
    pub(crate) ranks: u32,
    pub(crate) stride: u32,
    /// The last row.
    pub(crate) last_row: u32,
}

impl Grid {
    pub(crate) fn new(layout: &Layout) -> Self {
        let (split, offset) = (layout.split as f32, layout.kind.offset() as f32);
        let counts = [layout.width as f32 * split, layout.height as f32];
        let rows = layout.kind.cells(layout.height);
        Self {
            density: counts.map(|n| 0.5 * n),
            size: counts.map(|n| 2.0 / n),
            origin: [0.5 * counts[0] + offset * split, 0.5 * counts[1] + offset],
            last: [layout.bins() as f32 - 0.5, rows as f32 - 0.5],
            margin: counts.map(|n| (2.0 * f32::EPSILON * n).min(0.25)),
            split,
            per_split: 1.0 / split,
            weight_per_marginal: 1.0 / (counts[0] * counts[1]),
            guide: layout.guide as f32,
            quantiles: layout.quantiles as f32,
            ranks: layout.quantiles as u32 + 1,
            stride: layout.stride() as u32,
            last_row: rows as u32 - 1,
        }
    }
}
