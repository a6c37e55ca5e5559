//! Packed maps as uniforms of shaders.

use asperity_core::gpu_struct;

use crate::map::packed::grid::Grid;
use crate::map::packed::layout::HEADER;
use crate::map::packed::packed_map::PackedMapRef;

gpu_struct! {
    /// The grid of a packed map, and the offsets of the parts of its array.
    pub struct PackedMapUniform as "PackedMapGrid" {
        /// Columns and rows per unit of a normal's coordinate.
        density: [f32; 2],
        /// Reciprocals of the density.
        size: [f32; 2],
        /// Columns before n_x = 0, rows before n_y = 0.
        origin: [f32; 2],
        /// Middles of the last column and row.
        last: [f32; 2],
        /// Margin between a sample and the lines between rows, in rows.
        margin: f32,
        /// Entries of a guide.
        guide: f32,
        /// Entries of the quantiles of a column, minus 1.
        quantiles: f32,
        /// Index of the last row.
        last_row: u32,
        /// Columns of values around a cell: 1 for a map that is constant on texels, 2 for a
        /// bilinear map.
        sides: u32,
        /// Words of a column of the quantiles.
        ranks: u32,
        /// Words of a column of the nodes.
        stride: u32,
        /// Words of a column of the texels.
        texel_stride: u32,
        /// Offset of the guide by weight.
        by_weight_at: u32,
        /// Offset of the guide by place.
        by_place_at: u32,
        /// Offset of the leaves.
        leaves_at: u32,
        /// Offset of the heads.
        heads_at: u32,
        /// Offset of the nodes.
        nodes_at: u32,
        /// Offset of the texels.
        texels_at: u32,
        /// Offset of the quantiles.
        quantiles_at: u32,
        /// Number of leaves.
        leaves: u32,
    }
}

impl PackedMapRef<'_> {
    /// Returns the uniform `packed_map_grid` of a shader, whose table `packed_map_word` is the bits
    /// of the array.
    ///
    /// The example needs the feature `alloc`.
    ///
    #[cfg_attr(feature = "alloc", doc = "```")]
    #[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
    /// use asperity_ndf_sampling::{Ggx, NdfMap, Reconstruction};
    ///
    /// let map = NdfMap::from_ndf(64, 32, Reconstruction::Bilinear, &Ggx::new(0.3, 0.5)?)?;
    /// // 64 columns over the disk's diameter of 2, 32 rows.
    /// assert_eq!(map.view().gpu().density, [32.0, 16.0]);
    /// let table: Vec<u32> = map.array().iter().map(|x| x.to_bits()).collect();
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> PackedMapUniform {
        let Grid { density, size, origin, last, margin, guide, quantiles, .. } = self.grid;
        let Grid { ranks, stride, texel_stride, last_row, .. } = self.grid;
        let mut at = HEADER as u32;
        let [by_weight_at, by_place_at, leaves_at, heads_at, nodes_at, texels_at, quantiles_at] =
            self.layout.parts().map(|length| {
                let begin = at;
                at = at.saturating_add(length.unwrap_or(0) as u32);
                begin
            });
        PackedMapUniform {
            density,
            size,
            origin,
            last,
            margin,
            guide,
            quantiles,
            last_row,
            sides: self.layout.kind.sides() as u32,
            ranks,
            stride,
            texel_stride,
            by_weight_at,
            by_place_at,
            leaves_at,
            heads_at,
            nodes_at,
            texels_at,
            quantiles_at,
            leaves: self.layout.leaves as u32,
        }
    }
}
