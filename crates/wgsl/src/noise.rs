//! Noise: the hash of lattice points, kinds with analytic gradients, sums of octaves.
//!
//! Every kind has a function of a point, such as `value_noise_3d(p, key) -> Sample3d`, and a
//! function of a cell and the position in it, such as `value_in_cell_3d(cell, t, key)`, for
//! anchored points. Both return the bits of the Rust crate if every operation is rounded as
//! written. Seeds are passed as keys, [`gpu_key`](asperity_noise::IntegerHash::gpu_key) of the seed.
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
//! | [`SIMPLEX`] | `simplex_noise_*(p, key)`, `simplex_wide_noise_*(p, key)` | 2, 3, 4 |
//! | [`SPARSE`] | `sparse_noise_*(p, impulses, key)` | 2, 3 |
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

use crate::part::{Binding, Element, Part, part};

pub mod sums;
pub mod transforms;

/// Structures of value and gradient in two, three and four dimensions.
pub static SAMPLE: Part = part!("noise/sample");

/// Hash of lattice points, with the bits of [`IntegerHash`](asperity_noise::IntegerHash).
///
/// Seeds are passed as keys, [`gpu_key`](asperity_noise::IntegerHash::gpu_key) of the seed, whose computation takes
/// 64 bits.
pub static INTEGER_HASH: Part = part!("noise/lattice/integer_hash");

/// Cell of a point and the position in it, for every point as in [`Field`](asperity_noise::Field).
pub static CELL: Part = part!("noise/lattice/cell");

/// Weights along the axes of a cell, and their derivatives.
pub(crate) static FADE: Part = part!("noise/lattice/fade");

/// Directions to the edges of a cube, [`Perlin::gradient`](asperity_noise::Perlin::gradient).
pub static EDGES: Part = part!("noise/lattice/edges");

/// Uniform numbers and directions, [`PerlinClassic::gradient`](asperity_noise::PerlinClassic::gradient).
pub static VARIATES: Part = part!("noise/lattice/variates");

/// Blend of the corners of a cell at the ends of the first two axes.
pub(crate) static COLUMNS: Part = part!("noise/kinds/cell/columns", SAMPLE);

/// Blend of the corners of a cell in 3-D.
pub(crate) static CORNERS: Part = part!("noise/kinds/cell/corners", COLUMNS);

/// White noise, [`WhiteNoise`](asperity_noise::WhiteNoise), in two and three dimensions.
pub static WHITE: Part = part!("noise/kinds/white", SAMPLE, INTEGER_HASH, CELL, VARIATES);

/// Value noise, [`ValueNoise`](asperity_noise::ValueNoise), in two to four dimensions.
pub static VALUE: Part = part!("noise/kinds/value", SAMPLE, INTEGER_HASH, CELL, FADE);

/// Perlin noise of 1985, [`PerlinClassic`](asperity_noise::PerlinClassic), in two and three
/// dimensions.
pub static PERLIN_CLASSIC: Part =
    part!("noise/kinds/perlin_classic", INTEGER_HASH, CELL, FADE, VARIATES, CORNERS);

/// Perlin noise of 2002, [`Perlin`](asperity_noise::Perlin), in two to four dimensions.
pub static PERLIN: Part = part!("noise/kinds/perlin", INTEGER_HASH, CELL, FADE, EDGES, COLUMNS);

/// Value-gradient noise, [`ValueGradient`](asperity_noise::ValueGradient), in two and three
/// dimensions.
pub static VALUE_GRADIENT: Part =
    part!("noise/kinds/value_gradient", INTEGER_HASH, CELL, FADE, VARIATES, CORNERS);

/// Value noise by splines, [`ValueCatmullRom`](asperity_noise::ValueCatmullRom), in two and three
/// dimensions.
pub static VALUE_CATMULL_ROM: Part =
    part!("noise/kinds/value_catmull_rom", SAMPLE, INTEGER_HASH, CELL, VARIATES);

/// Sparse convolution noise, [`SparseConvolution`](asperity_noise::SparseConvolution), in two and
/// three dimensions.
pub static SPARSE: Part = part!("noise/kinds/sparse_convolution", SAMPLE, INTEGER_HASH, CELL, VARIATES);

/// Simplex noise, [`Simplex`](asperity_noise::Simplex) with either radius, in two to four
/// dimensions.
pub static SIMPLEX: Part = part!("noise/kinds/simplex/simplex", SAMPLE, INTEGER_HASH, CELL, EDGES);

/// Cellular noise, [`Cellular`](asperity_noise::Cellular) with all outputs and metrics, in two and
/// three dimensions.
pub static CELLULAR: Part = part!("noise/kinds/cellular/cellular", SAMPLE, INTEGER_HASH, CELL, VARIATES);

/// Gaussian variates of lattice points,
/// [`GaussianNoise::variates`](asperity_noise::GaussianNoise::variates), from the table of
/// [`gpu_levels`](asperity_noise::GaussianNoise::gpu_levels).
pub static GAUSSIAN_VARIATES: Part = part!("noise/lattice/gaussian_variates", INTEGER_HASH, CORNERS)
    .with_bindings(&[Binding::Table { name: "gaussian_level", element: Element::Float, width: 64 }]);

/// Exactly Gaussian noise, [`GaussianNoise`](asperity_noise::GaussianNoise), in two and three
/// dimensions: one channel, or [two](asperity_noise::GaussianNoise::pair).
pub static GAUSSIAN: Part =
    part!("noise/kinds/gaussian", INTEGER_HASH, CELL, FADE, CORNERS, GAUSSIAN_VARIATES);
