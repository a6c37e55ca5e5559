//! Carpet.

use asperity_shading::gpu::{CarpetUniform, FibersUniform};

use super::surface::{GLOSSY, SEGMENTS, SIZED_FBM, SURFACE_POINT};
use crate::ndf::ELEMENTARY;
use crate::part::{Binding, Part, part};
use crate::shading::DIRECTION;
use crate::shading::pixel::FOOTPRINT;

/// Seams, lines or a grid, filtered over a pixel: [`Seams`](asperity_shading::material::Seams).
pub(crate) static SEAMS: Part = part!("shading/material/carpet/seams", DIRECTION, ELEMENTARY);

/// Short bent fibers that cover each other, [`Fibers`](asperity_shading::material::Fibers).
pub(crate) static FIBERS: Part =
    part!("shading/material/carpet/fibers", [FibersUniform], SEGMENTS, FOOTPRINT);

/// Carpet of threads, fibers, seams and dark areas, with rim light:
/// [`Carpet`](asperity_shading::Carpet).
pub static CARPET: Part =
    part!("shading/material/carpet/carpet", [CarpetUniform], SURFACE_POINT, SIZED_FBM, SEAMS, FIBERS, GLOSSY)
        .with_bindings(&[Binding::Uniform { name: "carpet_uniform", of: "Carpet" }]);
