//! Materials: reflectance times cosine at a point, as a pixel sees it.
//!
//! Each has a function `material_scattered(material, point, wo, wi)` of its structure, the point, and the directions to the eye and to the light
//! in the point's frame: what [`Bsdf::scattered`](asperity_shading::Bsdf::scattered) of its [`Material::bsdf`](asperity_shading::Material::bsdf)
//! gives. `material(point, wo, wi)` is that of the material in a uniform.

use asperity_noise::simd::Kernel;
use asperity_shading::material::Fbm;

use crate::ndf::FRAME;
use crate::noise::INTEGER_HASH;
use crate::noise::sums::{OctavesUniform, octaves_3d};
use crate::part::{Part, part};
use crate::shading::DIRECTION;
use crate::shading::bump::{SLOPE_FACETS, SURFACE_GRADIENT};
use crate::shading::pixel::{FOOTPRINT, PIXEL_ELLIPSE};
use crate::shading::reflectance::{COOK_TORRANCE_BECKMANN, ENERGY_PRESERVING, FACET};

mod carpet;
mod glass;
mod paint;
mod wear;

pub use carpet::{CARPET, CarpetUniform, FIBRES, SEAMS};
pub use glass::{TEMPERED_GLASS, TemperedGlassUniform};
pub use paint::{FLAKE_PATCH, METALLIC_PAINT, MetallicPaintUniform};
pub use wear::{BLEMISHES, DENTS, SCRATCHES, ScratchesUniform, VARIATIONS, VariationsUniform};

/// Point of a surface with the pixel about it, [`SurfacePoint`](asperity_shading::SurfacePoint).
pub static SURFACE_POINT: Part =
    part!("shading/material/surface_point", FRAME, SURFACE_GRADIENT, PIXEL_ELLIPSE);

/// Short oriented segments in the cells of a plane, drawn by hashes.
pub static SEGMENTS: Part = part!("shading/material/segments", INTEGER_HASH, DIRECTION);

/// Keys of lattices whose seeds are drawn in the shader.
pub static LATTICE_KEY: Part = part!("shading/material/lattice_key");

/// Octaves of simplex noise by position, as a pixel sees them; their sums are in the uniform of sums of octaves in space.
pub static FBM: Part = part!("shading/material/fbm", octaves_3d::SIMPLEX, FOOTPRINT);

/// Rough diffuse surface with gloss, as a pixel sees it.
pub static GLOSSY: Part =
    part!("shading/material/glossy", SLOPE_FACETS, FACET, ENERGY_PRESERVING, COOK_TORRANCE_BECKMANN);

/// The words of the structure `Fbm`: frequency, highest, octaves, number of the sum.
fn fbm_words<K: Kernel<3>>(fbm: &Fbm<K>, sum: u32) -> [u32; 4] {
    let [frequency, highest] = fbm.frequencies();
    [frequency.to_bits(), highest.to_bits(), fbm.octaves().octaves().to_bits(), sum]
}

/// The words of the octaves of noise by position.
fn octaves_of<K: Kernel<3>>(fbm: &Fbm<K>) -> OctavesUniform<3> {
    OctavesUniform::new(fbm.octaves())
}
