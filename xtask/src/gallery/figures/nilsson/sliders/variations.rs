//! The parameters of the variations for any material.

use asperity_render::{
    image::tone::hex,
    integrator::swatch::Form,
    light::lamps::{Light, direction},
    materials,
};
use asperity_shading::VariationsParameters;
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure},
        figures::nilsson::sliders::{Strip, View, boxed, draw, strip},
    },
};

pub(crate) const VARIATIONS: Figure = Figure {
    name: "nilsson-variation-sliders",
    title: "Every parameter of the general variations",
    source: "Nilsson 2008, section 4.5 and Appendix B",
    caption: "A plastic panel whose gloss is 0.2 rough, near the highlight of a lamp. Blemishes vary the specular colour and, \
              with their bumps, where the highlight is; the diffuse colour stays. Dents are low and wide: cover is the share \
              of the noise's gradients that is kept, and at 0.1 few dents lie on flat ground. Roughness is that of the \
              diffuse facets, flat and chalky at 1.",
    draw: |context: &Context<'_>| -> Result<Drawn, Failure> {
        draw(context, &strips(), |parameters| boxed(materials::panel(parameters, 1.0, 0.2)))
    },
};

pub(super) fn strips() -> Vec<Strip<VariationsParameters>> {
    let base = VariationsParameters::default();
    let glossy = |height: f32| View {
        form: Form::Patch { height, distance: 2.2 * height },
        lamps: vec![
            Light { direction: direction(125.0, 68.0), colour: hex(0xff_f2e2) * 0.9 },
            Light { direction: direction(-30.0, 40.0), colour: hex(0xb9_d0ff) * 0.3 },
        ],
        ..View::patch(height)
    };
    let near = glossy(0.04).lit(0.45);
    let wide = glossy(0.8).lit(0.45);
    let ball = View::ball(0.1, 0.105).lit_from_the_eye().exposed(1.3);
    let dented = VariationsParameters {
        small_blemish_bump_strength: 0.0,
        small_blemish_colour_strength: 0.0,
        dent_strength: 0.1,
        ..base
    };
    let matte = VariationsParameters {
        specular: Vec3::ZERO,
        small_blemish_bump_strength: 0.0,
        small_blemish_colour_strength: 0.0,
        dent_strength: 0.0,
        ..base
    };
    let grey = Vec3::splat;
    vec![
        strip!(
            near,
            base,
            diffuse,
            [
                Vec3::splat(0.02),
                base.diffuse,
                Vec3::new(0.5, 0.06, 0.04),
                Vec3::new(0.05, 0.2, 0.4),
                Vec3::splat(0.8)
            ]
        ),
        strip!(near, base, specular, [0.0, 0.1, 0.2, 0.4, 0.8].map(grey)),
        strip!(ball, matte, roughness, [0.0, 0.15, 0.3, 0.6, 1.0]),
        strip!(near, base, small_blemish_size, [0.001, 0.003, 0.006, 0.012, 0.024]),
        strip!(near, base, small_blemish_bump_strength, [0.0, 0.03, 0.06, 0.12, 0.3]),
        strip!(near, base, small_blemish_colour_strength, [0.0, 0.2, 0.4, 0.7, 1.0]),
        strip!(wide, base, dent_strength, [0.0, 0.05, 0.1, 0.2, 0.4]),
        strip!(wide, dented, dent_size, [0.03, 0.06, 0.1, 0.2, 0.4]),
        strip!(wide, dented, dent_cover, [0.0, 0.1, 0.3, 0.6, 1.0]),
        strip!(wide, dented, dent_detail, [1, 2, 3, 5, 8]),
        strip!(wide, base, seed, [1, 2, 3, 4, 5]),
    ]
}
