//! Bump maps of a normal distribution, and authored normal maps.

use asperity_shading::gpu::{BumpMappedUniform, NormalMappedUniform};

use super::surface::SURFACE_POINT;
use crate::ndf::GAUSSIAN_SPLIT;
use crate::noise::GAUSSIAN_SLOPES_3D;
use crate::part::{Binding, Part, part};
use crate::shading::normal_map::SLOPE_PYRAMID;
use crate::shading::reflectance::{BRDF, FACET};
use crate::shading::{DIRECTION, FREQUENCY_CLAMP, LEVEL_OF_DETAIL};

/// Bump map of a normal distribution, [`BumpMapped`](asperity_shading::BumpMapped).
pub static BUMP_MAPPED: Part = part!(
    "shading/material/bump_mapped",
    [BumpMappedUniform],
    SURFACE_POINT,
    GAUSSIAN_SLOPES_3D,
    FREQUENCY_CLAMP,
    LEVEL_OF_DETAIL,
    FACET,
    DIRECTION,
    BRDF,
)
.with_bindings(&[Binding::Uniform { name: "bump_mapped_uniform", of: "BumpMapped" }]);

/// Glossy surface with an authored normal map,
/// [`NormalMapped`](asperity_shading::material::NormalMapped).
pub static NORMAL_MAPPED: Part = part!(
    "shading/material/normal_mapped",
    [NormalMappedUniform],
    SURFACE_POINT,
    SLOPE_PYRAMID,
    GAUSSIAN_SPLIT,
    FACET,
    DIRECTION,
    BRDF
)
.with_bindings(&[Binding::Uniform { name: "normal_mapped_uniform", of: "NormalMapped" }]);
