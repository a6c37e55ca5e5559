//! A strip for every parameter of the thesis's materials: one varied, all others kept.

mod fields;
mod parameters;
mod strip;

use asperity_shading::material::SeamPattern;
use asperity_shading::{Carpet, CarpetParameters, MetallicPaint, Scratches, TemperedGlass, Variations};
use glam::Vec3;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn};
use crate::gallery::figures::nilsson::sliders::strip::draw;

pub(crate) fn carpet(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::carpet(), Carpet::new)
}

pub(crate) fn paint(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::paint(), MetallicPaint::new)
}

pub(crate) fn glass(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::glass(), TemperedGlass::new)
}

pub(crate) fn variations(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::variations(), Variations::new)
}

pub(crate) fn scratches(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::scratches(), Scratches::new)
}

pub(crate) fn fibres(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::fibres(), |fibres| {
        Carpet::new(CarpetParameters {
            diffuse: Vec3::new(0.3, 0.27, 0.23),
            diffuse_thread_strength: 0.0,
            diffuse_thread_bump_strength: 0.0,
            specular_thread_strength: 0.0,
            dark_area_strength: 0.0,
            seams_pattern: SeamPattern::None,
            fibre_strength: 1.0,
            fibre_bump_strength: 0.5,
            fibres,
            ..Default::default()
        })
    })
}
