//! Maps and tables as uniforms of shaders.
//!
//! The shaders are in the crate `asperity-wgsl`. The feature `bytemuck` implements `Pod` for the
//! structs. Their declarations in WGSL are generated from the same definitions.

use asperity_core::gpu_struct;

use crate::level_of_detail::table::ConditionalTable;
pub use crate::map::packed::uniform::PackedMapUniform;
use crate::normal_table::{layout::TableLayout, table::NormalLut};

gpu_struct! {
    /// The size and the layout of a table of normals.
    pub struct NormalTableUniform as "NormalTableGrid" {
        /// Entries along a side.
        size: u32,
        /// Spacing of the coordinates, in the order of `Spacing`.
        spacing: u32,
        /// Chart of the normals, in the order of `Chart`.
        chart: u32,
        .. padding: u32
    }
}

impl<S> NormalLut<S> {
    /// Returns the uniform `normal_table_grid` of a shader, whose table `normal_table_number` is
    /// the entries.
    ///
    /// ```
    /// use asperity_ndf_sampling::{NormalLut, normal_table::TableLayout};
    ///
    /// static ENTRIES: [[f32; 2]; 4] = [[-0.5, 0.0], [0.5, 0.0], [-0.5, 0.1], [0.5, 0.1]];
    /// let grid = NormalLut::from_entries(2, TableLayout::default(), &ENTRIES)?.gpu();
    /// // Two entries along a side, evenly spaced in the coordinates, stereographic.
    /// assert_eq!((grid.size, grid.spacing, grid.chart), (2, 0, 2));
    /// # Ok::<(), asperity_ndf_sampling::NdfError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self) -> NormalTableUniform {
        let TableLayout { spacing, chart } = self.layout();
        let size = self.size() as u32;
        NormalTableUniform { size, spacing: spacing as u32, chart: chart as u32, padding: 0 }
    }
}

gpu_struct! {
    /// The stretch and the size of a table of half vectors.
    pub struct ConditionalTableUniform as "ConditionalTableGrid" {
        /// Stretch of half vectors along x and y.
        stretch: [f32; 2],
        /// Entries along a side.
        size: u32,
        .. padding: u32
    }
}

impl<S> ConditionalTable<S> {
    /// Returns the uniform `conditional_table_grid` of a shader, whose table
    /// `conditional_table_number` is the entries.
    #[must_use]
    pub fn gpu(&self) -> ConditionalTableUniform {
        let stretch = self.stretch().into();
        ConditionalTableUniform { stretch, size: self.size() as u32, padding: 0 }
    }
}
