//! A strip per parameter of the thesis's materials, with only this parameter varied.

mod fields;
mod parameters;
mod strip;

use asperity_render::shaded::fibers_alone;
use asperity_shading::{Carpet, CarpetParameters, MetallicPaint, Scratches, TemperedGlass, Variations};
use glam::Vec3;

use crate::figure::{Figure, figure};
use crate::figures::nilsson::sliders::parameters::{carpet, fibers, glass, paint, scratches, variations};
use crate::figures::nilsson::sliders::strip::draw;

/// One figure per material.
pub(crate) const SLIDERS: &[Figure] = &[
    figure("nilsson-carpet-sliders", |context| draw(context, &carpet(), Carpet::new)),
    figure("nilsson-paint-sliders", |context| draw(context, &paint(), MetallicPaint::new)),
    figure("nilsson-glass-sliders", |context| draw(context, &glass(), TemperedGlass::new)),
    figure("nilsson-variation-sliders", |context| draw(context, &variations(), Variations::new)),
    figure("nilsson-scratch-sliders", |context| draw(context, &scratches(), Scratches::new)),
    figure("nilsson-fiber-sliders", |context| {
        draw(context, &fibers(), |fibers| {
            Carpet::new(CarpetParameters {
                diffuse: Vec3::new(0.3, 0.27, 0.23),
                fiber_bump_strength: 0.5,
                fibers,
                ..fibers_alone()
            })
        })
    }),
];
