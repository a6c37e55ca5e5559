//! Textures of half vectors: the part and its uniform.

use asperity_ndf_sampling::gpu::ConditionalTableUniform;

use crate::ndf::density::{ELEMENTARY, GAUSSIAN_SPLIT};
use crate::part::{Binding, Element, Part, part};

/// Exact level of detail of any normal distribution by one lookup;
/// [`ConditionalTable`](asperity_ndf_sampling::ConditionalTable).
///
/// Bound to [`ConditionalTableUniform`] as `conditional_table_grid`, and to the entries, three
/// floats each, as the table `conditional_table_number`. With hardware interpolation, call
/// `conditional_table_coordinates` before and `conditional_table_weigh` after the texture lookup.
pub static CONDITIONAL_TABLE: Part =
    part!("ndf/level_of_detail/conditional_table", [ConditionalTableUniform], ELEMENTARY, GAUSSIAN_SPLIT)
        .with_bindings(&[
            Binding::Uniform { name: "conditional_table_grid", of: "ConditionalTableGrid" },
            Binding::Table { name: "conditional_table_number", element: Element::Float, width: 1024 },
        ]);
