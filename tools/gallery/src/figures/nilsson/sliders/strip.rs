//! A strip: one parameter of a material varied, all others fixed.

use std::{fmt::Debug, sync::Arc};

use asperity_render::light::lamps::{Lamp, Lamps};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::{geometry::ray::Ray, image::tone::hex, integrator::pixels::Sampling};
use asperity_render::{materials::InMetres, scenes::Form};
use asperity_shading::{ShadingError, material::Material};
use glam::Vec3;

use crate::figure::{Context, Drawn};
use crate::figures::nilsson::sliders::fields::{fields, varied};
use crate::panels::side_by_side;
use asperity::failure::Result;

/// A varied parameter.
pub(super) struct Strip<P> {
    pub(super) field: &'static str,
    pub(super) options: Vec<P>,
    pub(super) view: View,
}

/// View and lighting of a material.
#[derive(Clone)]
pub(super) struct View {
    pub(super) form: Form,
    pub(super) lamps: Vec<Lamp>,
    pub(super) mirrored: fn(&Ray) -> Vec3,
    pub(super) exposure: f32,
}

impl View {
    /// A form lit by lamps only.
    fn lamps(form: Form, lamps: &[(f32, f32, Vec3)]) -> Self {
        let lamps = lamps.iter().map(|&(azimuth, elevation, color)| Lamp::at(azimuth, elevation, color));
        Self { form, lamps: lamps.collect(), mirrored: |_| Vec3::ZERO, exposure: 1.0 }
    }

    /// A patch of this height, lit from the upper left to show bumps, and weakly from the right.
    pub(super) fn patch(height: f32) -> Self {
        let lamps = [(128.0, 42.0, hex(0xff_f2e2) * 1.1), (-20.0, 60.0, hex(0xb9_d0ff) * 0.35)];
        Self::lamps(Form::Patch { height, distance: 1e3 }, &lamps)
    }

    /// A close patch of this height, lit from both sides of the viewer to show gloss.
    pub(super) fn glossy(height: f32) -> Self {
        let lamps = [(125.0, 68.0, hex(0xff_f2e2) * 0.9), (-30.0, 40.0, hex(0xb9_d0ff) * 0.3)];
        Self::lamps(Form::Patch { height, distance: 2.2 * height }, &lamps)
    }

    /// A ball of this diameter, visible to this extent, lit from the upper left, from the right and
    /// from behind.
    pub(super) fn ball(diameter: f32, height: f32) -> Self {
        let (cool, rim) = (hex(0xb9_d0ff) * 0.4, hex(0xff_d6a8) * 0.5);
        let lamps = [(-132.0, 46.0, hex(0xff_f2e2)), (-18.0, 22.0, cool), (100.0, 40.0, rim)];
        Self::lamps(Form::Ball { diameter, height }, &lamps)
    }

    pub(super) fn exposed(self, exposure: f32) -> Self {
        Self { exposure, ..self }
    }

    /// Multiplies the brightness of the lamps.
    pub(super) fn lit(mut self, brightness: f32) -> Self {
        for lamp in &mut self.lamps {
            lamp.color *= brightness;
        }
        self
    }

    /// Places one lamp next to the viewer of a ball, almost like a full moon.
    pub(super) fn lit_from_the_eye(self) -> Self {
        Self { lamps: vec![Lamp::at(-104.0, 14.0, hex(0xff_f2e2))], ..self }
    }

    /// Formats the height of the visible part.
    fn words(&self) -> String {
        let (Form::Patch { height, .. } | Form::Ball { height, .. }) = self.form;
        match (height * 1e3).round() {
            t if t < 20.0 => format!("{t} mm high"),
            t if t < 1000.0 => format!("{} cm high", t / 10.0),
            t => format!("{} m high", t / 1e3),
        }
    }
}

/// Renders all strips of a material.
pub(super) fn draw<P: Copy + Debug + Default, M: Material + Sync>(
    context: &Context<'_>,
    strips: &[Strip<P>],
    material: impl Fn(P) -> Result<M, ShadingError>,
) -> Result<Drawn> {
    let samples_per_pixel = context.samples_per_pixel;
    let (across, gap) = (context.size * 3 / 2, (context.size / 96).max(1));
    let words = strips.iter().map(Strip::words);
    let drawn = Drawn::pictures(2, words.zip(strips), |Strip { options, view, .. }| {
        // The height is the width of one of five images.
        let height = (across - 4 * gap) / 5;
        let count = options.len() as u32;
        let width = (across - (count - 1) * gap) / count;
        let sampling = Sampling { width, height, samples_per_pixel, seed: context.seed };
        let shape = Arc::new(view.form.shape());
        let mut pictures = Vec::new();
        for &parameters in options {
            let material = InMetres(material(parameters)?, view.form.metres());
            let objects = vec![Object::new(Arc::clone(&shape), material)];
            let lamps = vec![Lamps::open(view.lamps.clone())];
            let scene = Scene::new(objects, Light::Lamps { lamps, room: &view.mirrored }, Backdrop::Studio);
            let camera = view.form.camera([width, height]);
            pictures.push(context.draw(&scene, sampling, &camera)?.filmic(view.exposure));
        }
        Ok(side_by_side(&pictures, gap, hex(0x1d_1f23)))
    })?;
    Ok(drawn.fact("samples per pixel", samples_per_pixel))
}

impl<P: Copy + Debug + Default> Strip<P> {
    /// Returns stem, label and alternative text. The label has the field's name, its values, other
    /// non-default values, and the visible size.
    fn words(&self) -> [String; 3] {
        let value = |fields: &[(String, String)]| {
            fields
                .iter()
                .find(|(name, _)| name == self.field)
                .map(|field| field.1.clone())
                .unwrap_or_default()
        };
        let (default, all) = (fields(&P::default()), self.options.iter().map(fields).collect::<Vec<_>>());
        let values: Vec<_> = all.iter().map(|fields| value(fields)).collect();
        let short = varied(&values);
        let usual = value(&default);
        let marked = |(words, value): (&String, &String)| {
            if *value == usual { format!("{words} (default)") } else { words.clone() }
        };
        let marked: Vec<_> = short.iter().zip(&values).map(marked).collect();
        let others = all[0].iter().zip(&default).filter(|(a, b)| a != b && a.0 != self.field);
        let others: Vec<_> = others.map(|((name, value), _)| format!("{name} {value}")).collect();
        let with = if others.is_empty() { String::new() } else { format!("; with {}", others.join(", ")) };
        let label = format!("{}: {}{with}; {}", self.field, marked.join(" · "), self.view.words());
        let alt = format!(
            "{} pictures of the same surface: {} is {} on the left and {} on the right",
            all.len(),
            self.field,
            short[0],
            short[short.len() - 1]
        );
        [self.field.replace('_', "-"), label, alt]
    }
}
