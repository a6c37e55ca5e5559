//! A strip for every parameter of the thesis's materials: one varied, all others kept.

mod fields;
mod parameters;
mod strip;

use asperity_render::{image::tone::hex, materials};
use asperity_shading::{CarpetParameters, SeamPattern};
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn},
        figures::nilsson::sliders::strip::{boxed, draw},
    },
};

pub(crate) fn carpet(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::carpet(), |p| boxed(materials::carpet(p, 1.0, hex(0xd8_dce6) * 0.5)))
}

pub(crate) fn paint(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::paint(), |p| boxed(materials::paint(p, 1.0, hex(0x06_1226))))
}

pub(crate) fn glass(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::glass(), |p| boxed(materials::pane(p, 1.0, Vec3::ZERO)))
}

pub(crate) fn variations(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::variations(), |p| boxed(materials::panel(p, 1.0, 0.2)))
}

pub(crate) fn scratches(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::scratches(), |p| boxed(materials::scratched(p, 1.0, hex(0xc8_ccd2), 0.2)))
}

pub(crate) fn fibres(context: &Context<'_>) -> Result<Drawn, Failure> {
    draw(context, &parameters::fibres(), |fibres| {
        let carpet = CarpetParameters {
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
        };
        boxed(materials::carpet(carpet, 1.0, Vec3::ZERO))
    })
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;

    use super::{fields::fields, parameters, strip::Strip};

    /// That there is a strip for every field, in order, each of which varies its field alone, and between pictures.
    fn complete<P: Copy + Debug + Default>(strips: &[Strip<P>]) {
        let names: Vec<String> = fields(&P::default()).into_iter().map(|(name, _)| name).collect();
        let strips_of: Vec<&str> = strips.iter().map(|strip| strip.field).collect();
        assert_eq!(strips_of, names);
        for strip in strips {
            let values = strip.values();
            assert!(values.len() >= 2 && (1..values.len()).all(|k| values[k] != values[k - 1]), "{values:?}");
            let others = |parameters| -> Vec<_> {
                fields(parameters).into_iter().filter(|(name, _)| name != strip.field).collect()
            };
            for parameters in &strip.options {
                assert_eq!(others(parameters), others(&strip.options[0]), "{}", strip.field);
            }
            assert!(strip.label().contains("(default)"), "{}", strip.label());
        }
    }

    #[test]
    fn every_parameter_has_a_strip() {
        complete(&parameters::carpet());
        complete(&parameters::paint());
        complete(&parameters::glass());
        complete(&parameters::variations());
        complete(&parameters::scratches());
        complete(&parameters::fibres());
    }
}
