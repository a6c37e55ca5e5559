//! The carpet's parameters.

use asperity_render::{image::tone::hex, materials};
use asperity_shading::{CarpetParameters, FibresParameters, SeamPattern};
use glam::{Vec2, Vec3};

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure},
        figures::nilsson::sliders::{Strip, View, boxed, draw, strip},
    },
};

pub(crate) const CARPET: Figure = Figure {
    name: "nilsson-carpet-sliders",
    title: "Every parameter of the carpet",
    source: "Nilsson 2008, section 4.2 and Appendix B",
    caption: "Each row varies one parameter and keeps the others at their defaults, but for those named behind it; \
              lengths are in metres. Lamps shine from the upper left and, weaker, from the right. Bump strengths far \
              above the defaults look like rock and not like threads, as the thesis found. Fibres are not in the \
              thesis; their own parameters have a figure of their own.",
    draw: |context: &Context<'_>| -> Result<Drawn, Failure> {
        draw(context, &strips(), |parameters| boxed(materials::carpet(parameters, 1.0, hex(0xd8_dce6) * 0.5)))
    },
};

pub(super) fn strips() -> Vec<Strip<CarpetParameters>> {
    let base = CarpetParameters::default();
    let plain = CarpetParameters { seams_pattern: SeamPattern::None, ..base };
    let shining = CarpetParameters { specular_thread_strength: 0.6, ..plain };
    let crossing = CarpetParameters { seams_amplitude: 0.9, ..base };
    let soft = CarpetParameters { fake_rim_light: 0.6, ..plain };
    let near = View::patch(0.01).exposed(3.0);
    let seamed = View::patch(0.14).exposed(2.2);
    let wide = View::patch(1.2).exposed(2.2);
    let ball = View::ball(0.3, 0.32).exposed(2.2);
    let even = CarpetParameters {
        diffuse_thread_bump_strength: 0.0,
        diffuse_thread_strength: 0.0,
        specular_thread_strength: 0.0,
        ..plain
    };
    let matte = CarpetParameters {
        fake_rim_light: 0.0,
        diffuse_thread_bump_strength: 0.0,
        dark_area_strength: 0.0,
        ..plain
    };
    let moon = ball.clone().lit_from_the_eye();
    let grey = Vec3::splat;
    let fibres = |fibre_length| FibresParameters { fibre_length, ..Default::default() };
    vec![
        strip!(
            seamed,
            base,
            diffuse,
            [
                Vec3::new(0.02, 0.02, 0.03),
                base.diffuse,
                Vec3::new(0.25, 0.2, 0.13),
                Vec3::new(0.2, 0.05, 0.04),
                Vec3::new(0.04, 0.08, 0.2)
            ]
        ),
        strip!(seamed, plain, specular, [0.0, 0.05, 0.1, 0.2, 0.4].map(grey)),
        strip!(seamed, plain, diffuse_thread_size, [0.002, 0.004, 0.006, 0.012, 0.03]),
        strip!(seamed, plain, diffuse_thread_strength, [0.0, 0.06, 0.12, 0.25, 0.5]),
        strip!(seamed, plain, diffuse_thread_bump_strength, [0.0, 0.06, 0.12, 0.3, 0.7]),
        strip!(seamed, shining, specular_thread_size, [0.004, 0.008, 0.016, 0.03, 0.06]),
        strip!(seamed, plain, specular_thread_strength, [0.0, 0.12, 0.3, 0.6, 1.0]),
        strip!(wide, plain, dark_area_size, [0.05, 0.1, 0.15, 0.3, 0.6]),
        strip!(wide, plain, dark_area_strength, [0.0, 0.25, 0.5, 0.75, 1.0]),
        strip!(
            seamed,
            base,
            seams_propagation,
            [Vec2::X, Vec2::new(2.0, 1.0), Vec2::ONE, Vec2::new(1.0, 2.0), Vec2::Y]
        ),
        strip!(seamed, base, seams_pattern, [SeamPattern::None, SeamPattern::Lines, SeamPattern::Grid]),
        strip!(seamed, base, seam_distance, [0.007, 0.012, 0.02, 0.035, 0.07]),
        strip!(seamed, base, seams_amplitude, [0.0, 0.15, 0.3, 0.6, 1.0]),
        strip!(seamed, base, seams_bump_strength, [0.0, 0.2, 0.4, 0.7, 1.0]),
        strip!(seamed, crossing, seam_crossover_size, [0.005, 0.012, 0.025, 0.05, 0.1]),
        strip!(seamed, crossing, seam_crossover_strength, [0.0, 0.25, 0.5, 0.75, 1.0]),
        strip!(near, even, fibre_strength, [0.0, 0.25, 0.5, 0.8, 1.0]),
        strip!(near, even, fibre_bump_strength, [0.0, 0.15, 0.3, 0.6, 1.0]),
        strip!(near, even, fibres, [0.002, 0.003, 0.004, 0.006, 0.01].map(fibres)),
        strip!(moon, matte, roughness, [0.0, 0.25, 0.5, 0.8, 1.0]),
        strip!(ball, plain, fake_rim_light, [0.0, 0.15, 0.4, 0.7, 1.0]),
        strip!(ball, soft, fake_rim_light_width, [0.0, 0.2, 0.4, 0.7, 1.0]),
        strip!(seamed, base, seed, [1, 2, 3, 4, 5]),
    ]
}
