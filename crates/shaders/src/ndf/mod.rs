//! Densities of normals: closed forms, maps, tables of normals, exact level of detail.
//!
//! Roughnesses are valid ones, as the crate's constructors make them; `roughness_clamped` repairs those of a texture. Where the
//! crate gives ∞, as Λ at the horizon, shaders give the largest float.

mod conditional_table;
mod density;
mod normal_table;
mod packed_map;

pub use conditional_table::{CONDITIONAL_TABLE, ConditionalTableUniform};
pub use density::{
    ASHIKHMIN_SHIRLEY, BECKMANN, BLINN_PHONG, ELEMENTARY, FRAME, GAUSSIAN_SPLIT, GGX, MICROFACET,
    NORMAL_DISTRIBUTION, OFFSET_BECKMANN, ROUGHNESS, STUDENT_DISTRIBUTION, STUDENT_T, VISIBLE_SLOPES, WARD,
};
pub use normal_table::{NORMAL_TABLE, NORMAL_TABLE_FILTERED, NORMAL_TABLE_LAYOUT, NormalTableUniform};
pub use packed_map::{PACKED_MAP, PackedMapUniform};
