//! Fractal interpolation functions from tables: values and slopes, height fields, folded surfaces
//! and ray intersection.
//!
//! The rows of all functions are in one table and the ranges of all axes in another. Uniforms
//! contain the offsets of a function.

use asperity_fif::gpu::{
    FoldedSurfaceUniform, HeightFieldRangesUniform, HeightFieldUniform, RangesUniform, TableUniform,
};

use crate::part::{Binding, Element, Part, part};

/// Whether a coordinate is not NaN: `fif_is_number`.
pub(crate) static NUMBER: Part = part!("fif/number");

/// Rows of a table, and `fif_table_value`.
static TABLE_VALUE: Part = part!("fif/table/uniform", [TableUniform], NUMBER)
    .with_bindings(&[Binding::Table { name: "fif_rows", element: Element::Float, width: 1024 }]);

/// A function from its table: `fif_table_value`, with the bits of
/// [`Table32::value`](asperity_fif::Table32::value), and `fif_table_jet`, the value and slope of a
/// smooth function, as [`Table::jet`](asperity_fif::Table::jet).
///
/// Bound to the table `fif_rows` of [`gpu_rows`](asperity_fif::Table32::gpu_rows). The
/// uniform selects the function.
pub static TABLE: Part = part!("fif/table/jet", TABLE_VALUE);

/// The normal of a gradient, `upward_normal`.
static NORMAL: Part = part!("fif/surface/normal");

/// Height and gradient of `f(x) g(y)`: [`HeightField`](asperity_fif::HeightField).
pub static HEIGHT_FIELD: Part = part!("fif/surface/height_field", [HeightFieldUniform], TABLE, NORMAL);

/// Height and gradient of a surface that is not a product: `folded_surface_height` and
/// `folded_surface_jet`, as [`asperity_fif::FoldedSurface`].
///
/// Bound to the table `fif_nodes` of [`gpu_nodes`](asperity_fif::FoldedSurface::gpu_nodes). The
/// uniform selects the surface.
pub static FOLDED_SURFACE: Part = part!("fif/surface/folded", [FoldedSurfaceUniform], NUMBER, NORMAL)
    .with_bindings(&[Binding::Table { name: "fif_nodes", element: Element::Float, width: 1024 }]);

/// Ray intersection with a height field: `height_field_intersect`, as
/// [`Intersect::intersect_within`](asperity_fif::Intersect::intersect_within).
///
/// Bound to the table `fif_ranges` of [`gpu_ranges`](asperity_fif::surface::Curve::gpu_ranges). The
/// uniform selects the axis.
pub static INTERSECT: Part =
    part!("fif/ray/intersect", [RangesUniform, HeightFieldRangesUniform], HEIGHT_FIELD)
        .with_bindings(&[Binding::Table { name: "fif_ranges", element: Element::Float, width: 1024 }]);
