//! Textures of half vectors: the part and its uniform.

use asperity_ndf_sampling::ConditionalTable;

use crate::ndf::density::{ELEMENTARY, GAUSSIAN_SPLIT};
use crate::part::{Binding, Element, Part, part};

/// Exact level of detail of any normal distribution by one lookup; [`ConditionalTable`].
///
/// Bound to [`ConditionalTableUniform`] as `conditional_table_grid`, and to the entries, three
/// floats each, as the table `conditional_table_number`. With hardware interpolation, call
/// `conditional_table_coordinates` before and `conditional_table_weigh` after the texture lookup.
pub static CONDITIONAL_TABLE: Part =
    part!("ndf/level_of_detail/conditional_table", ELEMENTARY, GAUSSIAN_SPLIT).with_bindings(&[
        Binding::Uniform { name: "conditional_table_grid", of: "ConditionalTableGrid" },
        Binding::Table {
            name: "conditional_table_number",
            element: Element::Float,
            width: ConditionalTableUniform::WIDTH,
        },
    ]);

/// Uniform of a texture of half vectors: its stretch and size.
///
/// ```
/// use asperity_ndf_sampling::{ConditionalTable, glam::Vec2};
/// use asperity_wgsl::ndf::ConditionalTableUniform;
///
/// static ENTRIES: [[f32; 3]; 1] = [[0.0, 0.0, 2.0]];
/// let table = ConditionalTable::from_entries(1, Vec2::new(0.5, 2.0), &ENTRIES)?;
/// let words = ConditionalTableUniform::new(&table).words();
/// assert_eq!([words[0], words[1]].map(f32::from_bits), [0.5, 2.0]);
/// assert_eq!(words[2..], [1, 0]);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConditionalTableUniform([u32; 4]);

impl ConditionalTableUniform {
    /// Texels per row of the table.
    pub const WIDTH: u32 = 1024;

    /// Packs the uniform of a table.
    #[must_use]
    pub fn new(table: &ConditionalTable<&[[f32; 3]]>) -> Self {
        let stretch = table.stretch();
        Self([stretch.x.to_bits(), stretch.y.to_bits(), table.size() as u32, 0])
    }

    /// Returns the 16 bytes of the structure `ConditionalTableGrid` as words: stretch along x and
    /// y, entries along a side, padding.
    #[must_use]
    pub const fn words(&self) -> [u32; 4] {
        self.0
    }
}
