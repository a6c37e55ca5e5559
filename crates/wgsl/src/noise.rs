//! Noise: the hash of lattice points, kinds with analytic gradients, sums of octaves.
//!
//! Every kind has a function of a point, such as `value_noise_3d(p, key) -> Sample3d`, and a
//! function of a cell and the position in it, such as `value_in_cell_3d(cell, t, key)`, for
//! anchored points. Both return the bits of the Rust crate if every operation is rounded as
//! written. Seeds are passed as keys, [`gpu_key`](asperity_noise::IntegerHash::gpu_key) of the
//! seed.
//!
//! | part | functions at points p | dimensions |
//! |---|---|---|
//! | [`WHITE`] | `white_noise_*(p, key)` | 2, 3 |
//! | [`VALUE`] | `value_noise_*(p, key)` | 2, 3, 4 |
//! | [`VALUE_CATMULL_ROM`] | `value_catmull_rom_noise_*(p, key)` | 2, 3 |
//! | [`PERLIN_CLASSIC`] | `perlin_classic_noise_*(p, key)` | 2, 3 |
//! | [`PERLIN`] | `perlin_noise_*(p, key)` | 2, 3, 4 |
//! | [`VALUE_GRADIENT`] | `value_gradient_noise_*(p, weight, key)` | 2, 3 |
//! | [`GAUSSIAN`] | `gaussian_noise_*(p, key)`, `gaussian_pair_*(p, key)` | 2, 3 |
//! | [`SIMPLEX`] | `simplex_noise_*(p, key)`, `simplex_classic_noise_*(p, key)` | 2, 3, 4 |
//! | [`SPARSE_CONVOLUTION`] | `sparse_convolution_noise_*(p, impulses, key)` | 2, 3 |
//! | [`CELLULAR`] | `cellular_noise_*(p, basis, metric, jitter, key)` | 2, 3 |
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use asperity_wgsl::{Bindings, compose, noise};
//!
//! let wgsl = compose(&[&noise::PERLIN], Bindings::Textures { group: 0 });
//! assert!(wgsl.contains("fn perlin_noise_3d(p: vec3<f32>, key: u32) -> Sample3d"));
//! # }
//! ```

mod kinds;
pub(crate) mod sums;
mod transforms;

pub(crate) use kinds::INTEGER_HASH;
pub use kinds::{
    CELLULAR, GAUSSIAN, PERLIN, PERLIN_CLASSIC, SIMPLEX, SPARSE_CONVOLUTION, VALUE, VALUE_CATMULL_ROM,
    VALUE_GRADIENT, WHITE,
};
pub use sums::{FBM_2D, FBM_3D, FBM_4D, FbmParts, FbmParts4d, GAUSSIAN_SLOPES_3D, MIP_MAPPED, MipMapped};
pub use transforms::{CURL, WARP};
