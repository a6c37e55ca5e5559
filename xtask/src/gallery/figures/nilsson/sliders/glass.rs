//! The tempered glass's parameters.

use asperity_render::{
    image::tone::hex,
    integrator::swatch::Form,
    materials::{self, pattern::line},
};
use asperity_shading::{GlassWaves, TemperedGlassParameters};
use glam::{Vec2, Vec3};

use crate::{
    failure::Failure,
    gallery::{
        figure::{Context, Drawn, Figure},
        figures::nilsson::sliders::{Strip, View, boxed, draw, strip},
    },
};

pub(crate) const GLASS: Figure = Figure {
    name: "nilsson-glass-sliders",
    title: "Every parameter of the tempered glass",
    source: "Nilsson 2008, section 4.4 and Appendix B",
    caption: "A dark pane a metre high, seen from 4 metres, mirrors a lattice far away, whose bars a flat pane would \
              show straight. By default waves every 31 cm tilt it by up to 0.002, and bars just waver. What bends them \
              is the curvature, the amplitude times the square of the frequency; a propagation vector that leans out \
              of the pane has longer and lower waves. The last two strips are the thesis's other try, noise.",
    draw: |context: &Context<'_>| -> Result<Drawn, Failure> {
        draw(context, &strips(), |parameters| boxed(materials::pane(parameters, 1.0, Vec3::ZERO)))
    },
};

/// Bright sky between bars that are 0.06 apart on a plane at distance 1, askew.
fn lattice(w: Vec3) -> Vec3 {
    let place = w.truncate() / w.z.max(1e-3) / 0.06;
    let place = Vec2::from_angle(0.45).rotate(place).to_array();
    let [x, y] = place.map(|x| line(f64::from(x) + 0.5, 0.16, 0.03));
    // As bright as lets four percent of it fill the range.
    10.0 * hex(0xb9_d0ec).lerp(hex(0x24_2830), x.max(y))
}

pub(super) fn strips() -> Vec<Strip<TemperedGlassParameters>> {
    let base = TemperedGlassParameters::default();
    let strong = TemperedGlassParameters { wave_amplitude: 2e-4, ..base };
    let noise = TemperedGlassParameters {
        waves: GlassWaves::Noise,
        wave_frequency: 6.0,
        wave_amplitude: 2e-4,
        ..base
    };
    let view = View {
        form: Form::Patch { height: 1.0, distance: 4.0 },
        lamps: Vec::new(),
        mirrored: lattice,
        exposure: 1.0,
    };
    let directions =
        [Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y, Vec3::new(-1.0, 2.0, 0.0), Vec3::new(0.0, 1.0, 1.0)];
    vec![
        strip!(view, base, wave_frequency, [5.0, 10.0, 20.0, 30.0, 45.0]),
        strip!(view, base, wave_amplitude, [0.0, 5e-5, 1e-4, 2e-4, 4e-4]),
        strip!(view, strong, wave_propagation_vector, directions),
        strip!(
            view,
            TemperedGlassParameters { waves: GlassWaves::Sine, ..noise },
            waves,
            [GlassWaves::Sine, GlassWaves::Noise]
        ),
        strip!(view, noise, seed, [1, 2, 3, 4, 5]),
    ]
}
