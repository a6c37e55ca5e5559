//! Normal distributions: closed forms, maps, tables of normals, exact level of detail.
//!
//! Roughnesses must be valid, as returned by the Rust constructors. `roughness_clamped` repairs
//! roughnesses from a texture. Shaders return the largest float instead of ∞, for instance for Λ at
//! the horizon.

mod conditional_table;
mod density;
mod normal_table;
mod packed_map;

pub use conditional_table::CONDITIONAL_TABLE;
pub use density::{ASHIKHMIN_SHIRLEY, BECKMANN, BLINN_PHONG, GGX, STUDENT_T, WARD};
pub(crate) use density::{ELEMENTARY, FRAME, GAUSSIAN_SPLIT, NORMAL_DISTRIBUTION, OFFSET_BECKMANN};
pub use normal_table::{NORMAL_TABLE, NORMAL_TABLE_FILTERED};
pub use packed_map::PACKED_MAP;
