//! Tables of normals: the parts and the uniform.

use asperity_ndf_sampling::gpu::NormalTableUniform;

use crate::ndf::density::{ELEMENTARY, NORMAL_DISTRIBUTION};
use crate::part::{Binding, Element, Part, part};

/// Texture coordinates of Gaussian coordinates, and normals of points of a chart;
/// [`TableLayout`](asperity_ndf_sampling::normal_table::TableLayout).
///
/// For tables of normals in textures with hardware interpolation. Spacings and charts are numbered
/// in the order of [`Spacing`](asperity_ndf_sampling::normal_table::Spacing) and
/// [`Chart`](asperity_ndf_sampling::normal_table::Chart).
static NORMAL_TABLE_LAYOUT: Part = part!("ndf/normal_table/layout", ELEMENTARY, NORMAL_DISTRIBUTION);

/// Table L: nearest and interpolated normal, with the bits of
/// [`NormalLut`](asperity_ndf_sampling::NormalLut).
///
/// Bound to [`NormalTableUniform`] as `normal_table_grid`, and to the entries, two floats each, as
/// the table `normal_table_number`.
pub static NORMAL_TABLE: Part = part!("ndf/normal_table/table", [NormalTableUniform], NORMAL_TABLE_LAYOUT)
    .with_bindings(&[
        Binding::Uniform { name: "normal_table_grid", of: "NormalTableGrid" },
        Binding::Table { name: "normal_table_number", element: Element::Float, width: 1024 },
    ]);

/// Table L in a texture with hardware filtering,
/// [`NormalLut::bilinear_normal`](asperity_ndf_sampling::NormalLut::bilinear_normal) with the
/// precision of the filter.
///
/// Bound to the texture `normal_table_texture`, whose two channels are an entry, and to a linear
/// sampler that does not repeat.
pub static NORMAL_TABLE_FILTERED: Part = part!("ndf/normal_table/filtered", NORMAL_TABLE_LAYOUT)
    .with_bindings(&[
        Binding::Texture { name: "normal_table_texture" },
        Binding::Sampler { name: "normal_table_sampler" },
    ]);
