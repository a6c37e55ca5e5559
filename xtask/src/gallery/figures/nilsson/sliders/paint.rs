//! The metallic paint's parameters.

use asperity_render::{image::tone::hex, light::environments::Studio, materials};
use asperity_shading::{Elimination, Environment, MetallicPaintParameters};
use glam::Vec3;

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure},
        figures::nilsson::sliders::{Strip, View, boxed, draw, strip},
    },
};

pub(crate) const PAINT: Figure = Figure {
    name: "nilsson-paint-sliders",
    title: "Every parameter of the metallic paint",
    source: "Nilsson 2008, section 4.3 and Appendix B",
    caption: "Painted balls that mirror soft boxes: orange peel bends what the clear coat mirrors and leaves the layer \
              below it alone. Sparkles are seen on a bead 2 cm wide; each is so many pixels wide, fades where that \
              nears its physical size, and shows where it makes a highlight stronger. Smart flake sparkle leaves fewer \
              out the wider sparkles are over its unit. Octaves of passive flakes have growing strengths: the finest \
              shows most, until it is too fine for the pixels.",
    draw: |context: &Context<'_>| -> Result<Drawn, Failure> {
        draw(context, &strips(), |parameters| boxed(materials::paint(parameters, 1.0, hex(0x06_1226))))
    },
};

pub(super) fn strips() -> Vec<Strip<MetallicPaintParameters>> {
    let base = MetallicPaintParameters::default();
    let studio = |w: Vec3| Studio::new(1.0).radiance(w);
    let ball = View { mirrored: studio, ..View::ball(0.12, 0.126) }.lit(0.7);
    let peel = View { mirrored: studio, ..View::ball(0.16, 0.13) }.lit(0.15).exposed(2.5);
    let bead = View { mirrored: studio, ..View::ball(0.02, 0.013) }.lit(0.5);
    let sparkling =
        MetallicPaintParameters { flake_sparkle_boost: 0.8, flake_sparkle_elimination: 0.0, ..base };
    let sparse = MetallicPaintParameters { flake_sparkle_elimination: 0.9, ..sparkling };
    let smart = |unit| Elimination::Adaptive { unit };
    let quiet = MetallicPaintParameters {
        flake_sparkle_elimination: 1.0,
        smart_flake_sparkle: Elimination::Fixed,
        ..base
    };
    let passive = MetallicPaintParameters { passive_flake_strength: 1.0, ..quiet };
    vec![
        strip!(
            ball,
            base,
            specular,
            [
                Vec3::splat(0.5),
                base.specular,
                Vec3::new(0.6, 0.1, 0.06),
                Vec3::new(0.12, 0.4, 0.2),
                Vec3::new(0.6, 0.4, 0.1)
            ]
        ),
        strip!(peel, base, orange_peel_strength, [0.0, 0.01, 0.02, 0.04, 0.1]),
        strip!(
            peel,
            MetallicPaintParameters { orange_peel_strength: 0.02, ..base },
            orange_peel_size,
            [0.004, 0.006, 0.012, 0.024, 0.048]
        ),
        strip!(bead, sparkling, flake_sparkle_pixel_size, [1.0, 1.5, 2.0, 3.0, 4.0]),
        strip!(bead, sparkling, flake_sparkle_physical_size, [0.0005, 0.0007, 0.001, 0.0015, 0.002]),
        strip!(bead, sparkling, flake_sparkle_variation, [0.1, 0.25, 0.5, 0.75, 1.0]),
        strip!(bead, sparkling, flake_sparkle_boost, [0.0, 0.15, 0.3, 0.6, 1.0]),
        strip!(
            bead,
            sparkling,
            flake_sparkle_boost_target,
            [
                Vec3::ONE,
                Vec3::new(1.0, 0.5, 0.1),
                Vec3::new(1.0, 0.1, 0.05),
                Vec3::new(0.1, 1.0, 0.2),
                Vec3::new(0.05, 0.15, 1.0)
            ]
        ),
        strip!(bead, sparkling, flake_sparkle_elimination, [0.0, 0.4, 0.6, 0.8, 0.95]),
        strip!(
            bead,
            sparse,
            smart_flake_sparkle,
            [Elimination::Fixed, smart(0.002), smart(0.0008), smart(0.0006), smart(0.0004)]
        ),
        strip!(bead, passive, passive_flake_size, [0.004, 0.006, 0.01, 0.016, 0.03]),
        strip!(
            bead,
            MetallicPaintParameters { passive_flake_size: 0.01, ..quiet },
            passive_flake_strength,
            [0.0, 0.3, 0.5, 0.75, 1.0]
        ),
        strip!(bead, passive, passive_flake_detail, [1, 2, 3, 4, 5]),
        strip!(bead, sparkling, seed, [1, 2, 3, 4, 5]),
    ]
}
