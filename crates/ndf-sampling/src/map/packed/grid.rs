//! Grid of a packed map: its columns and rows on the disk.

use crate::map::packed::layout::Layout;
use crate::map::reconstruction::Reconstruction;

/// Positions that a layout defines, as floats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// Columns, and rows, per unit of a normal coordinate, and the inverse.
    pub(crate) density: [f32; 2],
    pub(crate) size: [f32; 2],
    /// The columns before `n_x = 0`, and the rows before `n_y = 0`.
    pub(crate) origin: [f32; 2],
    /// The centers of the last column and of the last row.
    pub(crate) last: [f32; 2],
    /// Margin between a sample and the lines between rows, which rounding might cross.
    pub(crate) margin: f32,
    /// Entries of a guide, and of the quantiles of a column minus one.
    pub(crate) guide: f32,
    pub(crate) quantiles: f32,
    /// Numbers per column of the quantiles, of the nodes, and of the texels.
    pub(crate) ranks: u32,
    pub(crate) stride: u32,
    pub(crate) texel_stride: u32,
    /// The last row.
    pub(crate) last_row: u32,
}

impl Grid {
    pub(crate) fn new(layout: &Layout) -> Self {
        let (kind, sizes) = (layout.kind, [layout.width, layout.height]);
        let counts = sizes.map(|n| n as f32);
        Self {
            density: counts.map(|n| 0.5 * n),
            size: counts.map(|n| 2.0 / n),
            origin: counts.map(|n| 0.5 * n + kind.offset() as f32),
            last: sizes.map(|n| kind.cells(n) as f32 - 0.5),
            margin: margin(kind, layout.height),
            guide: layout.guide as f32,
            quantiles: layout.quantiles as f32,
            ranks: layout.quantiles as u32 + 1,
            stride: layout.stride() as u32,
            texel_stride: layout.texel_stride() as u32,
            last_row: kind.cells(layout.height) as u32 - 1,
        }
    }
}

/// Margin, in cells of `n`, between a sample and a line across which the density is discontinuous.
pub(crate) fn margin(kind: Reconstruction, n: usize) -> f32 {
    match kind {
        Reconstruction::Constant => (2.0 * f32::EPSILON * n as f32).min(0.25),
        Reconstruction::Bilinear => 0.0,
    }
}
