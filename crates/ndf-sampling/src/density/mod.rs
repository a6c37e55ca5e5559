//! Normal density functions: closed forms, tables over the cosine, and compositions of them.

pub(crate) mod ashikhmin_shirley;
pub(crate) mod beckmann;
pub(crate) mod blend;
pub(crate) mod blinn_phong;
pub(crate) mod closed_form;
pub(crate) mod delegate;
pub(crate) mod gaussian_lanes;
pub(crate) mod ggx;
pub(crate) mod isotropic;
pub(crate) mod isotropic_cell;
pub(crate) mod mixture;
pub(crate) mod rotated;
pub(crate) mod roughness;
pub(crate) mod student_distribution;
pub(crate) mod student_t;
pub(crate) mod visible_slopes;
pub(crate) mod ward;
