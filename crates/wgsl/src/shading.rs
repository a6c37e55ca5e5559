//! Shading: pixels, level of detail, bump mapping, normal maps, reflectances, textures, materials.
//!
//! Directions are unit vectors that point away from the surface, in its frame, where z is the
//! normal. Reflectances are in sr⁻¹, without the cosine of the light. Evaluation is total: NaN and
//! directions below the horizon give 0.

use asperity_shading::gpu::FrequencyClampUniform;

use crate::ndf::{BECKMANN, ELEMENTARY, FRAME, GAUSSIAN_SPLIT, GGX};
use crate::part::{Part, part};

mod bump;
pub mod material;
pub mod normal_map;
mod pixel;
pub mod reflectance;
pub mod texture;

/// Clamps that replace NaN, and angles of vectors.
pub(crate) static MATH: Part = part!("shading/math");

/// Unit vectors, [half vectors](fn@asperity_shading::half_vector),
/// [mirrored directions](fn@asperity_shading::reflect).
pub(crate) static DIRECTION: Part = part!("shading/direction", MATH);

/// Exact and fractal rule of level of detail: [`LevelOfDetail`](asperity_shading::LevelOfDetail).
///
/// Complete for GGX and Beckmann, as building blocks for any other normal distribution.
pub static LEVEL_OF_DETAIL: Part =
    part!("shading/level_of_detail/rule", ELEMENTARY, FRAME, GAUSSIAN_SPLIT, GGX, BECKMANN, FREQUENCY_CLAMP);

/// Octaves that a pixel resolves, [`FrequencyClamp`](asperity_shading::pixel::FrequencyClamp).
pub(crate) static FREQUENCY_CLAMP: Part = part!("shading/pixel/frequency_clamp", [FrequencyClampUniform]);

/// Roughness for the normals that a pixel averages,
/// [`SpecularAntialiasing`](asperity_shading::pixel::SpecularAntialiasing).
pub static SPECULAR_ANTIALIASING: Part = part!("shading/pixel/specular_antialiasing", MATH);
