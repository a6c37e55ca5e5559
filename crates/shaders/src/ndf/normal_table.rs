//! Tables of normals: the parts, the uniform.

use asperity_ndf_sampling::NormalTableRef;
use asperity_ndf_sampling::normal_table::{Chart, Spacing, TableLayout};

use crate::ndf::density::{ELEMENTARY, NORMAL_DISTRIBUTION};
use crate::part::{Binding, Element, Part, part};

/// Places of Gaussian coordinates and normals of a chart's points, for tables of normals in textures that hardware interpolates;
/// [`TableLayout`].
///
/// Spacings and charts are numbered in the order of [`Spacing`] and [`Chart`].
pub static NORMAL_TABLE_LAYOUT: Part = part!("ndf/normal_table/layout", ELEMENTARY, NORMAL_DISTRIBUTION);

/// Table L, the nearest entry's normal and the interpolated one: the bits of [`NormalTableRef`].
///
/// Bound to [`NormalTableUniform`] as `normal_table_grid`, and to the entries, two floats each, as the table `normal_table_number`.
pub static NORMAL_TABLE: Part = part!("ndf/normal_table/table", NORMAL_TABLE_LAYOUT).with_bindings(&[
    Binding::Uniform { name: "normal_table_grid", of: "NormalTableGrid" },
    Binding::Table { name: "normal_table_number", element: Element::Float, width: NormalTableUniform::WIDTH },
]);

/// Table L in a texture that hardware filters, [`NormalTableRef::bilinear_normal`] with the filter's precision.
///
/// Bound to the texture `normal_table_texture`, whose two channels are an entry's, and to a sampler that is linear and does not repeat.
pub static NORMAL_TABLE_FILTERED: Part = part!("ndf/normal_table/filtered", NORMAL_TABLE_LAYOUT)
    .with_bindings(&[
        Binding::Texture { name: "normal_table_texture" },
        Binding::Sampler { name: "normal_table_sampler" },
    ]);

/// Uniform of a table of normals: its size and layout.
///
/// ```
/// use asperity_ndf_sampling::{NormalTableRef, normal_table::TableLayout};
/// use asperity_shaders::ndf::NormalTableUniform;
///
/// static ENTRIES: [[f32; 2]; 4] = [[-0.5, 0.0], [0.5, 0.0], [-0.5, 0.1], [0.5, 0.1]];
/// let table = NormalTableRef::new(2, TableLayout::default(), &ENTRIES)?;
/// // Two entries along a side, even in the coordinates, stereographic.
/// assert_eq!(NormalTableUniform::new(&table).words(), [2, 0, 2, 0]);
/// assert_eq!(table.entries().as_flattened().len(), 8);
/// # Ok::<(), asperity_ndf_sampling::NormalTableError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NormalTableUniform([u32; 4]);

impl NormalTableUniform {
    /// Texels in a row of the table.
    pub const WIDTH: u32 = 1024;

    /// The uniform of a table.
    #[must_use]
    pub fn new<E: Copy>(table: &NormalTableRef<'_, E>) -> Self {
        let TableLayout { spacing, chart } = table.layout();
        Self([table.size() as u32, Self::spacing(spacing), Self::chart(chart), 0])
    }

    /// The number of a spacing, as `normal_table_place` takes it.
    #[must_use]
    pub const fn spacing(spacing: Spacing) -> u32 {
        spacing as u32
    }

    /// The number of a chart, as `normal_table_normal` takes it.
    #[must_use]
    pub const fn chart(chart: Chart) -> u32 {
        chart as u32
    }

    /// The 16 bytes of the structure `NormalTableGrid` in words: entries along a side, spacing, chart, nothing.
    #[must_use]
    pub const fn words(&self) -> [u32; 4] {
        self.0
    }
}
