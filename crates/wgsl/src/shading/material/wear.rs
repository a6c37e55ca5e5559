//! Wear of surfaces.

use asperity_shading::gpu::{ScratchesUniform, VariationsUniform};

use super::surface::{GLOSSY, LATTICE_KEY, SEGMENTS, SIZED_FBM, SURFACE_POINT};
use crate::noise::SIMPLEX;
use crate::noise::{FBM_3D, sums::FREQUENCY_CLAMP};
use crate::part::{Binding, Part, part};
use crate::shading::bump::SLOPE_FACETS;
use crate::shading::reflectance::{COOK_TORRANCE_BECKMANN, FACET};

/// Scratches on metal, [`Scratches`](asperity_shading::Scratches).
pub static SCRATCHES: Part = part!(
    "shading/material/wear/scratches",
    [ScratchesUniform],
    SEGMENTS,
    SURFACE_POINT,
    FREQUENCY_CLAMP,
    SLOPE_FACETS,
    FACET,
    COOK_TORRANCE_BECKMANN,
)
.with_bindings(&[Binding::Uniform { name: "scratches_uniform", of: "Scratches" }]);

/// Small variations of color, [`Blemishes`](asperity_shading::material::Blemishes).
pub(crate) static BLEMISHES: Part = part!("shading/material/wear/blemishes", SIZED_FBM);

/// Noise with some of its gradients dropped, [`Dents`](asperity_shading::material::Dents).
pub(crate) static DENTS: Part =
    part!("shading/material/wear/dents", SIZED_FBM, LATTICE_KEY, SIMPLEX, FBM_3D.custom);

/// Any material with blemishes and dents, [`Variations`](asperity_shading::Variations).
pub static VARIATIONS: Part =
    part!("shading/material/wear/variations", [VariationsUniform], BLEMISHES, DENTS, GLOSSY, SURFACE_POINT)
        .with_bindings(&[Binding::Uniform { name: "variations_uniform", of: "Variations" }]);
