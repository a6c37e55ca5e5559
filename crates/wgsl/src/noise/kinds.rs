//! Kinds of noise, and what they share: samples, hash, cells, variates.

use crate::part::{Binding, Element, Part, part};

/// Structures of value and gradient in two, three and four dimensions.
pub(crate) static SAMPLE: Part = part!("noise/sample");

/// Hash of lattice points, with the bits of [`IntegerHash`](asperity_noise::IntegerHash).
///
/// Seeds are passed as keys, [`gpu_key`](asperity_noise::IntegerHash::gpu_key) of the seed,
/// whose computation takes 64 bits.
pub(crate) static INTEGER_HASH: Part = part!("noise/lattice/integer_hash");

/// Cell of a point and the position in it, for every point as in [`Field`](asperity_noise::Field).
pub(crate) static CELL: Part = part!("noise/lattice/cell");

/// Weights along the axes of a cell, and their derivatives.
pub(crate) static FADE: Part = part!("noise/lattice/fade");

/// Directions to the edges of a cube, [`Perlin::gradient`](asperity_noise::Perlin::gradient).
pub(crate) static EDGES: Part = part!("noise/lattice/edges");

/// Uniform numbers and directions,
/// [`PerlinClassic::gradient`](asperity_noise::PerlinClassic::gradient).
pub(crate) static VARIATES: Part = part!("noise/lattice/variates");

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
pub static SPARSE_CONVOLUTION: Part =
    part!("noise/kinds/sparse_convolution", SAMPLE, INTEGER_HASH, CELL, VARIATES);

/// Simplex noise, [`Simplex`](asperity_noise::Simplex) with either radius, in two to four
/// dimensions.
pub static SIMPLEX: Part = part!("noise/kinds/simplex/simplex", SAMPLE, INTEGER_HASH, CELL, EDGES);

/// Cellular noise, [`Cellular`](asperity_noise::Cellular) with all outputs and metrics, in two and
/// three dimensions.
pub static CELLULAR: Part = part!("noise/kinds/cellular/cellular", SAMPLE, INTEGER_HASH, CELL, VARIATES);

/// Gaussian variates of lattice points,
/// [`GaussianNoise::variates`](asperity_noise::GaussianNoise::variates), from the table of
/// [`gpu_levels`](asperity_noise::GaussianNoise::gpu_levels).
pub(crate) static GAUSSIAN_VARIATES: Part = part!("noise/lattice/gaussian_variates", INTEGER_HASH, CORNERS)
    .with_bindings(&[Binding::Table { name: "gaussian_level", element: Element::Float, width: 64 }]);

/// Exactly Gaussian noise, [`GaussianNoise`](asperity_noise::GaussianNoise), in two and three
/// dimensions: one channel, or [two](asperity_noise::GaussianNoise::pair).
pub static GAUSSIAN: Part =
    part!("noise/kinds/gaussian", INTEGER_HASH, CELL, FADE, CORNERS, GAUSSIAN_VARIATES);
