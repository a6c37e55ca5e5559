//! Glass.

use asperity_shading::gpu::TemperedGlassUniform;

use super::surface::{SIZED_FBM, SURFACE_POINT};
use crate::part::{Binding, Part, part};
use crate::shading::reflectance::{COAT, ROUGH_DIELECTRIC};

/// Tempered glass, a pane or a body, smooth or frosted, with sine or noise waves:
/// [`TemperedGlass`](asperity_shading::TemperedGlass).
pub static TEMPERED_GLASS: Part = part!(
    "shading/material/tempered_glass",
    [TemperedGlassUniform],
    SURFACE_POINT,
    SIZED_FBM,
    COAT,
    ROUGH_DIELECTRIC
)
.with_bindings(&[Binding::Uniform { name: "tempered_glass_uniform", of: "TemperedGlass" }]);
