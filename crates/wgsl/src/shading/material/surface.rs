//! Points of surfaces, and parts used by several materials.

use asperity_shading::gpu::{SegmentsUniform, SizedFbmUniform};

use crate::ndf::FRAME;
use crate::noise::FBM_3D;
use crate::noise::INTEGER_HASH;
use crate::part::{Part, part};
use crate::shading::DIRECTION;
use crate::shading::bump::{SLOPE_FACETS, SURFACE_GRADIENT};
use crate::shading::pixel::{FOOTPRINT, PIXEL_ELLIPSE};
use crate::shading::reflectance::{COOK_TORRANCE_BECKMANN, ENERGY_PRESERVING, FACET};

/// Point of a surface with its pixel footprint, [`SurfacePoint`](asperity_shading::SurfacePoint).
pub static SURFACE_POINT: Part =
    part!("shading/material/surface_point", FRAME, SURFACE_GRADIENT, PIXEL_ELLIPSE);

/// Short oriented segments in the cells of a plane, drawn from hashes.
pub(crate) static SEGMENTS: Part =
    part!("shading/material/segments", [SegmentsUniform], INTEGER_HASH, DIRECTION);

/// Keys of lattices whose seeds are drawn in the shader.
pub(crate) static LATTICE_KEY: Part = part!("shading/material/lattice_key");

/// Octaves of simplex noise by position, filtered over a pixel.
///
/// Their sums are in the uniform of 3-D sums of octaves.
pub(crate) static SIZED_FBM: Part =
    part!("shading/material/sized_fbm", [SizedFbmUniform], FBM_3D.simplex, FOOTPRINT);

/// Rough diffuse surface with gloss, filtered over a pixel.
pub(crate) static GLOSSY: Part =
    part!("shading/material/glossy", SLOPE_FACETS, FACET, ENERGY_PRESERVING, COOK_TORRANCE_BECKMANN);
