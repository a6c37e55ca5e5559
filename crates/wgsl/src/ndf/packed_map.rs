//! Packed maps: the part, its uniform and its table.

use asperity_ndf_sampling::gpu::PackedMapUniform;

use crate::ndf::density::{ELEMENTARY, GAUSSIAN_SPLIT, NORMAL_DISTRIBUTION};
use crate::part::{Binding, Element, Part, part};

/// A painted or computed distribution on the map of normals, from one array,
/// [`PackedMapRef`](asperity_ndf_sampling::PackedMapRef).
///
/// Density, samples, distribution functions, bijection and inverse, conditional density. Bound to
/// [`PackedMapUniform`] as `packed_map_grid`, and to the bits of the array as the table
/// `packed_map_word`.
pub static PACKED_MAP: Part =
    part!("ndf/map/packed_map", [PackedMapUniform], ELEMENTARY, NORMAL_DISTRIBUTION, GAUSSIAN_SPLIT)
        .with_bindings(&[
            Binding::Uniform { name: "packed_map_grid", of: "PackedMapGrid" },
            Binding::Table { name: "packed_map_word", element: Element::Word, width: 1024 },
        ]);
