//! Metallic paint.

use asperity_shading::gpu::MetallicPaintUniform;

use super::surface::{SIZED_FBM, SURFACE_POINT};
use crate::ndf::ELEMENTARY;
use crate::noise::INTEGER_HASH;
use crate::part::{Binding, Part, part};
use crate::shading::DIRECTION;
use crate::shading::reflectance::{COAT, ENERGY_PRESERVING};

/// Patches of space, one per flake of [`MetallicPaint`](asperity_shading::MetallicPaint).
pub(crate) static FLAKE_PATCH: Part =
    part!("shading/material/paint/flake_patch", INTEGER_HASH, DIRECTION, ELEMENTARY);

/// Flakes over pigment under a clearcoat with orange peel, the common part of both kinds of
/// [`MetallicPaint`](asperity_shading::MetallicPaint).
pub(crate) static COATED_FLAKES: Part = part!(
    "shading/material/paint/coated_flakes",
    [MetallicPaintUniform],
    SURFACE_POINT,
    SIZED_FBM,
    ENERGY_PRESERVING,
    COAT
);

/// Metallic paint with passive flakes, sparkles and a clearcoat with orange peel,
/// [`MetallicPaint`](asperity_shading::MetallicPaint).
pub static METALLIC_PAINT: Part = part!("shading/material/paint/metallic_paint", COATED_FLAKES, FLAKE_PATCH)
    .with_bindings(&[Binding::Uniform { name: "metallic_paint_uniform", of: "MetallicPaint" }]);
