//! The parameters of scratches and of fibres: hashed segments in the cells of a texture.

use asperity_render::{image::tone::hex, light::lamps::Light, materials};
use asperity_shading::{CarpetParameters, FibresParameters, ScratchesParameters, SeamPattern};
use glam::{Vec2, Vec3};

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure},
        figures::nilsson::sliders::{Strip, View, boxed, draw, strip},
    },
};

pub(crate) const SCRATCHES: Figure = Figure {
    name: "nilsson-scratch-sliders",
    title: "Every parameter of the scratches",
    source: "Asperity, for the open problem of Nilsson 2008, section 6.2",
    caption: "Metal beside the highlight of two lamps: grooves catch light that the surface mirrors past the eye on \
              one side, and lose it on the other. Cover is the mean number of scratches in a cell, whose side is the \
              scratch size; at a spread of 0 all are parallel. The narrowest are finer than a pixel, which sees them \
              wider and shallower.",
    draw: |context: &Context<'_>| -> Result<Drawn, Failure> {
        draw(context, &scratch_strips(), |parameters| {
            boxed(materials::scratched(parameters, 1.0, hex(0xc8_ccd2), 0.2))
        })
    },
};

pub(crate) const FIBRES: Figure = Figure {
    name: "nilsson-fibre-sliders",
    title: "Every parameter of the fibres",
    source: "Asperity, for the open problem of Nilsson 2008, section 6.1",
    caption: "A carpet of fibres alone, without the noise of its threads, seams and dark areas, 12 mm high. Fibres cover one \
              another, so that of each the tip shows; contrast is how much they vary and how dark their roots and the gaps \
              between them are, and leaves the mean brightness as it is.",
    draw: |context: &Context<'_>| -> Result<Drawn, Failure> {
        draw(context, &fibre_strips(), |fibres| {
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
    },
};

pub(super) fn scratch_strips() -> Vec<Strip<ScratchesParameters>> {
    let base = ScratchesParameters { scratch_width: 0.02, scratch_cover: 4.0, ..Default::default() };
    // Half vectors a little beside the normal.
    let lamp = |x, y, colour| {
        let h = Vec3::new(x, y, 1.0).normalize();
        Light { direction: 2.0 * h.z * h - Vec3::Z, colour }
    };
    let view = |height| View {
        lamps: vec![lamp(0.22, 0.26, hex(0xff_f2e2) * 0.5), lamp(-0.3, 0.1, hex(0xb9_d0ff) * 0.25)],
        ..View::patch(height)
    };
    let (view, near) = (view(0.11), view(0.05));
    let combed = ScratchesParameters { scratch_spread: 0.15, ..base };
    vec![
        strip!(view, base, scratch_size, [0.02, 0.035, 0.05, 0.1, 0.2]),
        strip!(view, base, scratch_length, [0.1, 0.25, 0.5, 0.75, 1.0]),
        strip!(view, base, scratch_width, [0.004, 0.01, 0.02, 0.05, 0.1]),
        strip!(near, base, scratch_strength, [0.0, 0.1, 0.25, 0.5, 1.0]),
        strip!(view, base, scratch_cover, [0.0, 0.5, 1.0, 2.0, 4.0]),
        strip!(
            view,
            combed,
            scratch_direction,
            [Vec2::X, Vec2::new(2.0, 1.0), Vec2::ONE, Vec2::Y, Vec2::new(-1.0, 1.0)]
        ),
        strip!(view, base, scratch_spread, [0.0, 0.1, 0.25, 0.5, 1.0]),
        strip!(view, base, seed, [1, 2, 3, 4, 5]),
    ]
}

pub(super) fn fibre_strips() -> Vec<Strip<FibresParameters>> {
    let base = FibresParameters::default();
    let view = View::patch(0.012).exposed(1.3);
    vec![
        strip!(view, base, fibre_length, [0.002, 0.003, 0.004, 0.006, 0.01]),
        strip!(view, base, fibre_width, [0.07, 0.09, 0.12, 0.2, 0.3]),
        strip!(view, base, fibre_bend, [0.0, 0.08, 0.15, 0.22, 0.3]),
        strip!(view, base, fibre_direction, [Vec2::X, Vec2::ONE, Vec2::Y, Vec2::new(-1.0, 1.0), Vec2::NEG_X]),
        strip!(view, base, fibre_spread, [0.0, 0.15, 0.3, 0.6, 1.0]),
        strip!(view, base, fibre_contrast, [0.0, 0.3, 0.6, 0.8, 1.0]),
        strip!(view, base, seed, [1, 2, 3, 4, 5]),
    ]
}
