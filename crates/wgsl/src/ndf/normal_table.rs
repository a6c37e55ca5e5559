//! Tables of normals: the parts and the uniform.

use asperity_ndf_sampling::NormalLut;
use asperity_ndf_sampling::normal_table::{Chart, Spacing, TableLayout};

use crate::ndf::density::{ELEMENTARY, NORMAL_DISTRIBUTION};
use crate::part::{Binding, Element, Part, part};

/// Texture coordinates of Gaussian coordinates, and normals of points of a chart; [`TableLayout`].
///
/// For tables of normals in textures with hardware interpolation. Spacings and charts are numbered
/// in the order of [`Spacing`] and [`Chart`].
pub static NORMAL_TABLE_LAYOUT: Part = part!("ndf/normal_table/layout", ELEMENTARY, NORMAL_DISTRIBUTION);

/// Table L: nearest and interpolated normal, with the bits of [`NormalLut`].
///
/// Bound to [`NormalTableUniform`] as `normal_table_grid`, and to the entries, two floats each, as
/// the table `normal_table_number`.
pub static NORMAL_TABLE: Part = part!("ndf/normal_table/table", NORMAL_TABLE_LAYOUT).with_bindings(&[
    Binding::Uniform { name: "normal_table_grid", of: "NormalTableGrid" },
    Binding::Table { name: "normal_table_number", element: Element::Float, width: NormalTableUniform::WIDTH },
]);

/// Table L in a texture with hardware filtering, [`NormalLut::bilinear_normal`] with the
/// precision of the filter.
///
/// Bound to the texture `normal_table_texture`, whose two channels are an entry, and to a linear
/// sampler that does not repeat.
pub static NORMAL_TABLE_FILTERED: Part = part!("ndf/normal_table/filtered", NORMAL_TABLE_LAYOUT)
    .with_bindings(&[
        Binding::Texture { name: "normal_table_texture" },
        Binding::Sampler { name: "normal_table_sampler" },
    ]);

/// Uniform of a table of normals: its size and layout.
///
/// ```
/// use asperity_ndf_sampling::{NormalLut, normal_table::TableLayout};
/// use asperity_wgsl::ndf::NormalTableUniform;
///
/// static ENTRIES: [[f32; 2]; 4] = [[-0.5, 0.0], [0.5, 0.0], [-0.5, 0.1], [0.5, 0.1]];
/// let table = NormalLut::from_entries(2, TableLayout::default(), &ENTRIES)?;
/// // Two entries along a side, evenly spaced in the coordinates, stereographic.
/// assert_eq!(NormalTableUniform::new(&table).words(), [2, 0, 2, 0]);
/// assert_eq!(table.entries().as_flattened().len(), 8);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NormalTableUniform([u32; 4]);

impl NormalTableUniform {
    /// Texels per row of the table.
    pub const WIDTH: u32 = 1024;

    /// Packs the uniform of a table.
    #[must_use]
    pub fn new<E: Copy>(table: &NormalLut<&[E]>) -> Self {
        let TableLayout { spacing, chart } = table.layout();
        Self([table.size() as u32, Self::spacing(spacing), Self::chart(chart), 0])
    }

    /// Returns the number of a spacing, an argument of `normal_table_place`.
    #[must_use]
    pub const fn spacing(spacing: Spacing) -> u32 {
        spacing as u32
    }

    /// Returns the number of a chart, an argument of `normal_table_normal`.
    #[must_use]
    pub const fn chart(chart: Chart) -> u32 {
        chart as u32
    }

    /// Returns the 16 bytes of the structure `NormalTableGrid` as words: entries along a side,
    /// spacing, chart, padding.
    #[must_use]
    pub const fn words(&self) -> [u32; 4] {
        self.0
    }
}
