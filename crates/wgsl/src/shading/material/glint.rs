//! Counted flakes.

use asperity_shading::gpu::{CountedFlakesUniform, GlintFieldUniform};

use super::paint::COATED_FLAKES;
use crate::ndf::{ELEMENTARY, NORMAL_DISTRIBUTION};
use crate::noise::INTEGER_HASH;
use crate::part::{Binding, Part, part};
use crate::shading::pixel::PIXEL_ELLIPSE;
use crate::shading::{DIRECTION, MATH};

/// Flakes counted within pixels, with any normal distribution as their mean,
/// [`GlintField`](asperity_shading::material::GlintField).
pub static GLINT_FIELD: Part = part!(
    "shading/material/paint/glint_field",
    [GlintFieldUniform],
    INTEGER_HASH,
    NORMAL_DISTRIBUTION,
    ELEMENTARY,
    DIRECTION,
    MATH,
    PIXEL_ELLIPSE,
);

/// Metallic paint with counted flakes,
/// [`PaintFlakes::Counted`](asperity_shading::material::PaintFlakes::Counted).
pub static COUNTED_FLAKES: Part =
    part!("shading/material/paint/counted_flakes", [CountedFlakesUniform], COATED_FLAKES, GLINT_FIELD)
        .with_bindings(&[Binding::Uniform { name: "counted_flakes_uniform", of: "CountedFlakes" }]);
